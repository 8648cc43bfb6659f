#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "apps/cli/commands.hpp"
#include "apps/cli/exit_codes.hpp"
#include "apps/cli/progress.hpp"
#include "apps/cli/run_outputs.hpp"
#include "apps/job/mesh_job.hpp"
#include "apps/report/mesh_report.hpp"
#include "apps/report/mesh_warnings.hpp"
#include "apps/usage/mesh_usage.hpp"
#include "core/run_control.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

int threadsAsked(const ParallelOptions& options) {
  return options.threads > 0 ? options.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

// Why there is no mesh at all.
std::string reasonOf(const std::vector<Refusal>& refusals) {
  if (refusals.size() == 1) return refusals.front().reason;
  return "none of the " + std::to_string(refusals.size()) + " parts of the input can be meshed";
}

// Gives what files cannot hold of the mesh, or hold and the mesh has not, having warned of it.
std::vector<std::string> writeGrids(RunOutputs& outputs, const Grid& grid, ProgressDisplay& display, Run& run) {
  std::vector<std::string> warnings = outputs.lossWarnings(grid, LossesOf::Input);
  if (const std::string warning = outputs.depthWarning(grid); !warning.empty()) warnings.push_back(warning);
  if (!warnings.empty()) display.clear();
  for (const std::string& warning : warnings) run.warn(warning);
  for (std::size_t i = 0; i < outputs.grids(); ++i) {
    display.show("write", static_cast<double>(i) / static_cast<double>(outputs.grids()));
    outputs.writeGrid(i, grid);
    run.interrupt.check();
    if (display.abandoned()) throw Cancelled();
  }
  display.show("write", 1.0);
  return warnings;
}

int runMesh(const MeshUsage& usage, Run& run) {
  const Interrupt& interrupt = run.interrupt;
  if (usage.report == "-" && usage.progress == "json")
    throw OptionError("--report - and --progress json both write to standard output: give the report a file");
  const auto start = std::chrono::steady_clock::now();
  const auto secondsSince = [](std::chrono::steady_clock::time_point since) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
  };
  RunOutputs outputs(usage.overwrite, run.inputs, run.interrupt);
  outputs.addGrids(usage.outputs, usage.format);
  outputs.addReport(usage.report);
  ProgressDisplay display(ProgressDisplay::styleFor(usage.progress, usage.quiet));
  const JobControl control{[&interrupt, &display] { return interrupt.requested() || display.abandoned(); },
                           [&display](std::string_view phase, double share) { display.show(phase, share); }};
  MeshJobResult result = runMeshJob(usage.job, control);
  display.clear();
  for (const std::string& warning : warningsOf(result)) run.warn(warning);

  const auto write_start = std::chrono::steady_clock::now();
  const bool any = result.regions > 0;
  if (any) result.output_warnings = writeGrids(outputs, result.grid, display, run);
  result.seconds.write = secondsSince(write_start);
  result.log.addAlone("write", result.seconds.write);
  result.seconds.total = secondsSince(start);
  outputs.writeReport(meshReport(usage.job, result, threadsAsked(usage.job.parallel), run.warnings));
  outputs.commit();
  if (!any && !result.refusals.empty() && std::ranges::all_of(result.refusals, &Refusal::over_budget)) {
    std::fprintf(stderr, "coastmesh: error: %s\n", reasonOf(result.refusals).c_str());
    return kExitShort;
  }
  if (!any && result.refusals.empty()) throw InputError(result.last_unwanted);
  if (!any) throw InputError(reasonOf(result.refusals));

  display.show("done", 1.0);
  display.clear();
  if (!usage.quiet && usage.progress != "json" && usage.report != "-") {
    std::string text = meshSummary(usage.job, result);
    for (const std::string& note : result.read.notes) text += note + "\n";
    for (const std::string& path : usage.outputs) text += "wrote " + path + "\n";
    if (!usage.report.empty()) text += "wrote " + usage.report + "\n";
    std::fputs(text.c_str(), stdout);
  }
  return result.complete() ? kExitDone : kExitShort;
}

}  // namespace

Command declareMesh(CLI::App& root) {
  auto usage = std::make_shared<MeshUsage>();
  Command command{declareMeshUsage(root, *usage), {}};
  command.run = [usage](Run& run) {
    settle(*usage);
    return runMesh(*usage, run);
  };
  return command;
}

}  // namespace coastmesh
