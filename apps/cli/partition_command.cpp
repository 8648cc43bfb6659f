#include <cstdio>
#include <memory>

#include "apps/cli/commands.hpp"
#include "apps/cli/mesh_file.hpp"
#include "apps/cli/partition_outputs.hpp"
#include "apps/cli/run_outputs.hpp"
#include "apps/process/exit_codes.hpp"
#include "apps/report/partition_report.hpp"
#include "apps/usage/grid_usage.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "parallel/recorder.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {

namespace {

struct PartitionUsage {
  MeshFile mesh;
  PartsUsage parts;
  std::vector<std::string> outputs;
  std::string format;
  std::string report;
  bool overwrite = false;
  bool quiet = false;
};

std::string reportOf(const PartitionReport& report, const Run& run) {
  return textOf(
      {{"coastmesh", COASTMESH_VERSION}, {"warnings", run.warnings}, {"partition", partitionSection(report)}});
}

int runPartition(const PartitionUsage& usage, Run& run) {
  Interrupt& interrupt = run.interrupt;
  const PartitionOptions options = partitionFor(usage.parts, usage.outputs, usage.format);
  if (!options.elements && !options.nodes)
    throw OptionError("no output can hold parts: give .prop, partmesh.txt, rpart.out, .nc or .msh");
  RunOutputs outputs(usage.overwrite, run.inputs, interrupt);
  outputs.addGrids(usage.outputs, usage.format);
  outputs.addReport(usage.report);
  Grid grid = readMeshFile(usage.mesh, run);
  findMissingBoundaries(grid);
  PartitionReport report;
  withThreads({}, [&] {
    const RunControl control{[&interrupt] { return interrupt.requested(); }, {}};
    Recorder recorder;
    report = partitionGrid(grid, options, recorder.loop("partition", control));
    for (const std::string& warning : outputs.lossWarnings(grid, LossesOf::Input)) run.warn(warning);
    outputs.writeGrids(grid, recorder.loop("write", control));
  });
  outputs.writeReport(reportOf(report, run));
  outputs.commit();
  if (!usage.quiet && usage.report != "-") std::fputs(partitionText(report).c_str(), stdout);
  return kExitDone;
}

}  // namespace

Command declarePartition(CLI::App& root) {
  auto usage = std::make_shared<PartitionUsage>();
  OptionTable table = commandOptions("partition", "Assign a mesh to the processes of a solver");
  declareMeshFile(table, "MESH", "mesh to read", usage->mesh);
  table.integerArgument("N", usage->parts.parts, 1, kMostParts, "number of processes");
  declareGridOutputs(table, usage->outputs, usage->format);
  table.section(Section::Output);
  declarePartWeights(table, usage->parts);
  table.output({"--report", "Report"}, usage->report, {.standard_output = true},
               "write a report as JSON; - prints it instead of the summary");
  table.flag({"--overwrite", "Replace files"}, usage->overwrite, "replace files that exist");
  table.section(Section::Run);
  table.flag({"--quiet", "No summary"}, usage->quiet, "print no summary");
  table.example("coastmesh partition hgrid.gr3 480 -o partition.prop", "for SCHISM on 480 processes");
  table.example("coastmesh partition hgrid.gr3 480 --partition-levels vgrid.in -o partition.prop",
                "for a three-dimensional SCHISM, each process with as many layers of water");
  table.example("coastmesh partition fort.14 64 -o partmesh.txt -o parts.nc",
                "for ADCIRC's adcprep, and as a layer to view");
  return {{root, std::move(table)}, [usage](Run& run) { return runPartition(*usage, run); }};
}

}  // namespace coastmesh
