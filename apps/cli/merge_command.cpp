#include <memory>
#include <string>
#include <vector>

#include "apps/cli/commands.hpp"
#include "apps/cli/mesh_edit.hpp"
#include "apps/usage/merge_usage.hpp"

namespace coastmesh {

namespace {

struct MergeCommand {
  MergeUsage merge;
  std::vector<std::string> inserted;
  EditOutputs outputs;
};

int runMerge(const MergeCommand& usage, Run& run) {
  requireNumbers(usage.outputs, usage.merge.job.finish);
  const MeshFile& mesh = usage.merge.mesh;
  const MergeJob& job = usage.merge.job;
  const Warn warn = [&run](const std::string& text) { run.warn(text); };
  std::vector<MeshToInsert> inserted;
  for (const std::string& path : usage.inserted)
    inserted.push_back({path, [file = MeshFile{path, mesh.crs}, &warn] { return readMeshFile(file, warn); }});
  const auto merge = [&](Grid& grid, const JobControl& control) {
    return runMergeJob(grid, mesh.path, inserted, job, warn, control);
  };
  return runMeshEdit(mesh, usage.outputs, merge, run);
}

}  // namespace

Command declareMerge(CLI::App& root) {
  auto usage = std::make_shared<MergeCommand>();
  OptionTable table = commandOptions("merge", "Put meshes into another one, with a graded transition");
  table.argument("MESH", usage->merge.mesh.path, "mesh to put the others into");
  table.arguments("INSERT", usage->inserted,
                  "meshes to put in, in this order, in place of the triangles that they cover; each joins MESH along "
                  "its open boundaries, or all around if it has none");
  declareMergeOptions(table, usage->merge);
  declareEditOutputs(table, usage->outputs, "Numbers in the meshes before",
                     "write a table (CSV) with the mesh that each node and triangle comes from, 1 for MESH, 2 for the "
                     "first INSERT, and its number there; nothing for new ones");
  table.example("coastmesh merge fort.14 bay.14 -o both.14 --assume-crs EPSG:4326", "a fine grid in a coarse one");
  table.example("coastmesh merge hgrid.gr3 bay.gr3 -o both.gr3 --target schism", "the same, repaired for a model");
  return {{root, std::move(table)}, [usage](Run& run) { return runMerge(*usage, run); }};
}

}  // namespace coastmesh
