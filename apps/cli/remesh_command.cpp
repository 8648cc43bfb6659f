#include <memory>
#include <string>

#include "apps/cli/commands.hpp"
#include "apps/cli/mesh_edit.hpp"
#include "apps/usage/remesh_usage.hpp"

namespace coastmesh {

namespace {

struct RemeshCommand {
  RemeshUsage remesh;
  EditOutputs outputs;
};

int runRemesh(RemeshCommand& usage, Run& run) {
  requireNumbers(usage.outputs, usage.remesh.job.finish);
  for (const std::string& warning : settle(usage.remesh)) run.warn(warning);
  const MeshFile& mesh = usage.remesh.mesh;
  const RemeshJob& job = usage.remesh.job;
  const auto remesh = [&](Grid& grid, const JobControl& control) {
    return runRemeshJob(grid, mesh.path, job, control);
  };
  return runMeshEdit(mesh, usage.outputs, remesh, run);
}

}  // namespace

Command declareRemesh(CLI::App& root) {
  auto usage = std::make_shared<RemeshCommand>();
  OptionTable table = commandOptions("remesh", "Mesh a part of a mesh anew, with other sizes");
  table.argument("MESH", usage->remesh.mesh.path, "mesh to read");
  declareRemeshOptions(table, usage->remesh);
  declareEditOutputs(
      table, usage->outputs, "Numbers in the mesh before",
      "write a table (CSV) with the number that each node and triangle had in MESH, nothing for new ones");
  table.example("coastmesh remesh fort.14 -o finer.14 --bbox=-91,46.5,-90,47 --size 500 --assume-crs EPSG:4326",
                "triangles of 500 m in a box");
  table.example("coastmesh remesh hgrid.gr3 -o finer.gr3 --within bay.geojson --size-shore 500 --size-max 5000",
                "a bay with a finer shore");
  return {{root, std::move(table)}, [usage](Run& run) { return runRemesh(*usage, run); }};
}

}  // namespace coastmesh
