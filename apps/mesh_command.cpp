#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "apps/commands.hpp"
#include "apps/exit_codes.hpp"
#include "apps/grid_outputs.hpp"
#include "apps/mesh_job.hpp"
#include "apps/mesh_report.hpp"
#include "apps/mesh_usage.hpp"
#include "apps/progress.hpp"
#include "apps/staged_file.hpp"
#include "core/run_control.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

constexpr std::size_t kWarningsShown = 20;

int threadsAsked(const ParallelOptions& options) {
  return options.threads > 0 ? options.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

void showWarnings(const MeshJobResult& result) {
  for (const std::string& warning : result.read.warnings) {
    std::fprintf(stderr, "coastmesh: warning: %s\n", warning.c_str());
  }
  for (const std::string& warning : result.finish.warnings()) {
    std::fprintf(stderr, "coastmesh: warning: %s\n", warning.c_str());
  }
  if (result.regions == 0 && result.refusals.size() == 1) return;  // the error to come says it
  const std::size_t shown = std::min(kWarningsShown, result.refusals.size());
  for (std::size_t i = 0; i < shown; ++i) {
    std::fprintf(stderr, "coastmesh: warning: left out: %s\n", result.refusals[i].reason.c_str());
  }
  if (result.refusals.size() > shown) {
    std::fprintf(stderr, "coastmesh: warning: left out: %zu more, which --report lists\n",
                 result.refusals.size() - shown);
  }
}

// Why there is no mesh at all.
std::string reasonOf(const std::vector<Refusal>& refusals) {
  if (refusals.size() == 1) return refusals.front().reason;
  return "none of the " + std::to_string(refusals.size()) + " parts of the input can be meshed";
}

// The outputs that a run leaves behind when it ends well.
class MeshOutputs {
 public:
  MeshOutputs(const MeshUsage& usage, Interrupt& interrupt)
      : grids_(usage.outputs, usage.format, usage.overwrite, usage.job.input.files, interrupt), interrupt_(interrupt) {
    if (!usage.report.empty()) report_.emplace(usage.report, usage.overwrite, interrupt);
  }

  void writeGrids(const Grid& grid, ProgressDisplay& display) {
    std::vector<std::string> warnings = grids_.lossWarnings(grid, LossesOf::Input);
    if (const std::string warning = grids_.depthWarning(grid); !warning.empty()) warnings.push_back(warning);
    if (!warnings.empty()) display.clear();
    for (const std::string& warning : warnings) std::fprintf(stderr, "coastmesh: warning: %s\n", warning.c_str());
    warnings_ = std::move(warnings);
    for (std::size_t i = 0; i < grids_.size(); ++i) {
      display.show("write", static_cast<double>(i) / static_cast<double>(grids_.size()));
      grids_.write(i, grid);
      interrupt_.check();
      if (display.abandoned()) throw Cancelled();
    }
    display.show("write", 1.0);
    grids_written_ = true;
  }

  // What outputs cannot hold of the mesh, or hold and the mesh has not.
  const std::vector<std::string>& warnings() const { return warnings_; }

  void writeReport(const std::string& text) {
    if (report_) report_->write(text);
  }

  void commit() {
    interrupt_.close();
    if (grids_written_) grids_.commit();
    if (report_) report_->commit();
  }

 private:
  GridOutputs grids_;
  std::optional<StagedFile> report_;
  Interrupt& interrupt_;
  bool grids_written_ = false;
  std::vector<std::string> warnings_;
};

int runMesh(const MeshUsage& usage, Interrupt& interrupt) {
  const auto start = std::chrono::steady_clock::now();
  const auto secondsSince = [](std::chrono::steady_clock::time_point since) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
  };
  MeshOutputs outputs(usage, interrupt);
  ProgressDisplay display(ProgressDisplay::styleFor(usage.progress, usage.quiet));
  const JobControl control{[&interrupt, &display] { return interrupt.requested() || display.abandoned(); },
                           [&display](std::string_view phase, double share) { display.show(phase, share); }};
  MeshJobResult result = runMeshJob(usage.job, control);
  display.clear();
  showWarnings(result);

  const auto write_start = std::chrono::steady_clock::now();
  const bool any = result.regions > 0;
  if (any) outputs.writeGrids(result.grid, display);
  result.output_warnings = outputs.warnings();
  result.seconds.write = secondsSince(write_start);
  result.log.addAlone("write", result.seconds.write);
  result.seconds.total = secondsSince(start);
  if (!usage.report.empty()) outputs.writeReport(meshReport(usage.job, result, threadsAsked(usage.job.parallel)));
  outputs.commit();
  if (!any && !result.refusals.empty() && std::ranges::all_of(result.refusals, &Refusal::over_budget)) {
    std::fprintf(stderr, "coastmesh: error: %s\n", reasonOf(result.refusals).c_str());
    return kExitShort;
  }
  if (!any && result.refusals.empty()) throw InputError(result.last_unwanted);
  if (!any) throw InputError(reasonOf(result.refusals));

  display.show("done", 1.0);
  display.clear();
  if (!usage.quiet && usage.progress != "json") {
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
  command.run = [usage](Interrupt& interrupt) {
    settle(*usage);
    return runMesh(*usage, interrupt);
  };
  return command;
}

}  // namespace coastmesh
