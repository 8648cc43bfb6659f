#include <cstdio>
#include <memory>

#include "apps/cli/commands.hpp"
#include "apps/cli/mesh_file.hpp"
#include "apps/cli/run_outputs.hpp"
#include "apps/job/finish_grid.hpp"
#include "apps/process/exit_codes.hpp"
#include "apps/usage/finish_usage.hpp"
#include "apps/usage/grid_usage.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "parallel/recorder.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {

namespace {

struct ConvertUsage {
  MeshFile mesh;
  std::vector<std::string> outputs;
  std::string format;
  FinishOptions finish;
  bool overwrite = false;
  bool quiet = false;
};

int runConvert(const ConvertUsage& usage, Run& run) {
  Interrupt& interrupt = run.interrupt;
  RunOutputs outputs(usage.overwrite, run.inputs, interrupt);
  outputs.addGrids(usage.outputs, usage.format);
  Grid grid = readMeshFile(usage.mesh, run);
  findMissingBoundaries(grid);
  const RunControl control{[&interrupt] { return interrupt.requested(); }, {}};
  FinishReport report;
  std::string winding;
  withThreads({}, [&] {
    Recorder recorder;
    const ItemLoop loop = recorder.loop("finish", control);
    report = finishGrid(grid, usage.finish, control, loop);
    if (usage.finish.targets.empty()) winding = windingWarning(grid, loop);
  });
  if (!winding.empty()) run.warn(winding);
  for (const std::string& warning : report.warnings()) run.warn(warning);
  for (const std::string& warning : outputs.numberWarnings(grid)) run.warn(warning);
  for (const std::string& warning : outputs.lossWarnings(grid, LossesOf::Grid)) run.warn(warning);
  withThreads({}, [&] {
    Recorder recorder;
    outputs.writeGrids(grid, recorder.loop("write", control));
  });
  const std::string summary =
      usage.quiet ? std::string() : finishSummary(usage.finish, report) + outputs.openingsText(grid);
  outputs.commit();
  std::fputs(summary.c_str(), stdout);
  return report.repairs.left.empty() ? kExitDone : kExitShort;
}

}  // namespace

Command declareConvert(CLI::App& root) {
  auto usage = std::make_shared<ConvertUsage>();
  OptionTable table = commandOptions("convert", "Write a mesh in other formats");
  declareMeshFile(table, "MESH", "mesh to read", usage->mesh);
  declareGridOutputs(table, usage->outputs, usage->format);
  declareFinishOptions(table, usage->finish);
  table.option("--boundary-column").needs({"--boundaries"});
  table.section(Section::Output);
  table.flag({"--overwrite", "Replace files"}, usage->overwrite, "replace files that exist");
  table.section(Section::Run);
  table.flag({"--quiet", "No summary"}, usage->quiet, "print no summary");
  table.example("coastmesh convert lake.nc -o lake.2dm -o lake.msh", "a grid in two other formats");
  return {{root, std::move(table)}, [usage](Run& run) { return runConvert(*usage, run); }};
}

}  // namespace coastmesh
