#include <memory>

#include "apps/cli/commands.hpp"
#include "apps/cli/mesh_edit.hpp"
#include "apps/usage/cut_usage.hpp"

namespace coastmesh {

namespace {

struct CutCommand {
  CutUsage cut;
  EditOutputs outputs;
};

int runCut(CutCommand& usage, Run& run) {
  settle(usage.cut);
  requireNumbers(usage.outputs, usage.cut.job.finish);
  const MeshFile& mesh = usage.cut.mesh;
  const CutJob& job = usage.cut.job;
  const auto cut = [&](Grid& grid, const JobControl& control) { return runCutJob(grid, mesh.path, job, control); };
  return runMeshEdit(mesh, usage.outputs, cut, run);
}

}  // namespace

Command declareCut(CLI::App& root) {
  auto usage = std::make_shared<CutCommand>();
  OptionTable table = commandOptions("cut", "Cut out a part of a mesh");
  table.argument("MESH", usage->cut.mesh.path, "mesh to read");
  declareCutOptions(table, usage->cut);
  declareEditOutputs(table, usage->outputs, "Numbers in the whole mesh",
                     "write a table (CSV) with the number that each node and triangle had in MESH, to cut out other "
                     "files of the model");
  table.example("coastmesh cut fort.14 -o bay.14 --bbox=-91,46.5,-90,47 --assume-crs EPSG:4326",
                "the part of a grid in a box");
  table.example("coastmesh cut hgrid.gr3 -o bay.gr3 --within bay.geojson --numbers numbers.csv",
                "the part in polygons, with the numbers that its nodes had");
  return {{root, std::move(table)}, [usage](Run& run) { return runCut(*usage, run); }};
}

}  // namespace coastmesh
