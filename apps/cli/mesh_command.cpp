#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "apps/cli/cleaned_output.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/exit_codes.hpp"
#include "apps/cli/progress.hpp"
#include "apps/cli/run_outputs.hpp"
#include "apps/job/mesh_job.hpp"
#include "apps/report/mesh_report.hpp"
#include "apps/report/mesh_warnings.hpp"
#include "apps/usage/grid_usage.hpp"
#include "apps/usage/mesh_usage.hpp"
#include "core/run_control.hpp"
#include "gis/error.hpp"
#include "gis/format/grid_io.hpp"
#include "parallel/recorder.hpp"
#include "parallel/workers.hpp"

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
std::vector<std::string> writeGrids(RunOutputs& outputs, const Grid& grid, ProgressDisplay& display, Run& run,
                                    const ItemLoop& loop) {
  std::vector<std::string> warnings = outputs.lossWarnings(grid, LossesOf::Input);
  if (const std::string warning = outputs.depthWarning(grid); !warning.empty()) warnings.push_back(warning);
  if (!warnings.empty()) display.clear();
  for (const std::string& warning : warnings) run.warn(warning);
  for (std::size_t i = 0; i < outputs.grids(); ++i) {
    display.show("write", static_cast<double>(i) / static_cast<double>(outputs.grids()));
    outputs.writeGrid(i, grid, loop);
    run.interrupt.check();
    if (display.abandoned()) throw Cancelled();
  }
  display.show("write", 1.0);
  return warnings;
}

// What the program is given for it besides the job.
struct MeshCommandUsage {
  MeshUsage mesh;
  std::vector<std::string> outputs;
  std::string format;
  std::string report;
  std::string edits;
  std::string progress = "auto";
  bool overwrite = false;
  bool quiet = false;
};

OptionTable declareOptions(MeshCommandUsage& usage) {
  OptionTable table = commandOptions("mesh", "Mesh the polygons and closed lines of vector files, or a .poly");
  table.arguments("INPUT", usage.mesh.job.input.files,
                  "vector files that GDAL reads ('-': standard input), or one .poly");
  declareGridOutputs(table, usage.outputs, usage.format);
  declareMeshOptions(table, usage.mesh);
  table.option("--mark-pieces")
      .needs(
          [&usage] {
            return std::ranges::any_of(usage.outputs, [&usage](const std::string& path) {
              return gridFormatFor(path, usage.format).name == "ugrid";
            });
          },
          "without an output that is UGRID (.nc)");
  table.output("--report", usage.report, {.standard_output = true},
               "write a report as JSON; - prints it in place of the summary");
  table.output("--edits", usage.edits, {},
               "write what cleaning and --coast follow changed, as points with its kind and the feature: a .gpkg, "
               ".geojson or .fgb");
  table.choice(
      "--progress", usage.progress, {"auto", "bar", "log", "json", "none"},
      "how to show progress on stderr: a bar, or a line every ten seconds (auto: a bar on a terminal, else lines); "
      "or JSON lines on stdout");
  table.flag("--overwrite", usage.overwrite, "replace files that exist");
  table.flag("--quiet", usage.quiet, "print no summary");
  table.example("coastmesh mesh lake.geojson -o lake.gpkg -o lake.nc", "a lake as GIS layers and as a UGRID grid");
  table.example("coastmesh mesh sea.shp -o fort.14 --min-angle 35 --size-max 5000",
                "a sea for ADCIRC: angles of 35 degrees and more, no edge longer than 5 km");
  table.example("coastmesh mesh lakes.gpkg -o lakes.msh --min-island-area 10000 --report lakes.json",
                "many lakes for Gmsh's readers, islands below a hectare filled, with a report for scripts");
  return table;
}

int runMesh(const MeshCommandUsage& usage, Run& run) {
  MeshJob job = usage.mesh.job;
  job.keep_edits = !usage.edits.empty();
  const Interrupt& interrupt = run.interrupt;
  if (usage.report == "-" && usage.progress == "json")
    throw OptionError("--report - and --progress json both write to standard output: give the report a file");
  const auto start = std::chrono::steady_clock::now();
  const auto secondsSince = [](std::chrono::steady_clock::time_point since) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
  };
  RunOutputs outputs(usage.overwrite, run.inputs, run.interrupt);
  outputs.addGrids(usage.outputs, usage.format);
  if (job.keep_edits) requireVectorFormat(usage.edits, 1);
  StagedFiles* const edits = job.keep_edits ? &outputs.addFile(usage.edits) : nullptr;
  outputs.addReport(usage.report);
  ProgressDisplay display(ProgressDisplay::styleFor(usage.progress, usage.quiet));
  const JobControl control{[&interrupt, &display] { return interrupt.requested() || display.abandoned(); },
                           [&display](std::string_view phase, double share) { display.show(phase, share); }};
  MeshJobResult result = runMeshJob(job, control);
  display.clear();
  for (const std::string& warning : warningsOf(result)) run.warn(warning);

  const auto write_start = std::chrono::steady_clock::now();
  const bool any = result.regions > 0;
  if (any) {
    withThreads(job.parallel, [&] {
      Recorder recorder;
      result.output_warnings =
          writeGrids(outputs, result.grid, display, run, recorder.loop("write", {control.cancelled, {}}));
      result.log.append(recorder.finish("write"));
    });
  }
  if (edits != nullptr && any)
    edits->make([&](const std::string& path) {
      writeVectorLayers(path, result.crs, {editLayer(result.edit_places, result.read)});
    });
  result.seconds.write = secondsSince(write_start);
  result.seconds.total = secondsSince(start);
  outputs.writeReport(meshReport(job, result, threadsAsked(job.parallel), run.warnings));
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
    std::string text = meshSummary(job, result);
    for (const std::string& note : result.read.notes) text += note + "\n";
    for (const std::string& path : usage.outputs) text += "wrote " + path + "\n";
    if (!usage.edits.empty()) text += "wrote " + usage.edits + "\n";
    if (!usage.report.empty()) text += "wrote " + usage.report + "\n";
    std::fputs(text.c_str(), stdout);
  }
  return result.complete() ? kExitDone : kExitShort;
}

}  // namespace

Command declareMesh(CLI::App& root) {
  auto usage = std::make_shared<MeshCommandUsage>();
  return {{root, declareOptions(*usage)}, [usage](Run& run) {
            settle(usage->mesh);
            return runMesh(*usage, run);
          }};
}

}  // namespace coastmesh
