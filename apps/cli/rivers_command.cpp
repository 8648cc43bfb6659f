#include <memory>
#include <string>
#include <vector>

#include "apps/cli/commands.hpp"
#include "apps/cli/mesh_edit.hpp"
#include "apps/usage/rivers_usage.hpp"

namespace coastmesh {

namespace {

struct RiversCommand {
  RiversUsage rivers;
  std::vector<std::string> lines;
  EditOutputs outputs;
};

int runRivers(RiversCommand& usage, Run& run) {
  settle(usage.rivers);
  requireNumbers(usage.outputs, usage.rivers.job.finish);
  const MeshFile& mesh = usage.rivers.mesh;
  const Warn warn = [&run](const std::string& text) { run.warn(text); };
  const auto add = [&](Grid& grid, const JobControl& control) {
    return runRiversJob(grid, mesh.path, usage.lines, usage.rivers.job, warn, control);
  };
  return runMeshEdit(mesh, usage.outputs, add, run);
}

}  // namespace

Command declareRivers(CLI::App& root) {
  auto usage = std::make_shared<RiversCommand>();
  OptionTable table =
      commandOptions("rivers", "Add rivers to a mesh: rows of quadrilaterals along centre lines, joined with it");
  table.argument("MESH", usage->rivers.mesh.path, "mesh to add rivers to");
  table.arguments("LINES", usage->lines,
                  "vector files that GDAL reads, with centre lines and their widths; lines that meet, or end in one "
                  "another, are joined");
  declareRiversOptions(table, usage->rivers);
  declareEditOutputs(
      table, usage->outputs, "Numbers in the mesh before",
      "write a table (CSV) with the number that each node and element had in MESH; nothing for new ones");
  table.example("coastmesh rivers sea.nc rivers.gpkg -o hgrid.gr3 --target schism",
                "rivers that flow into a sea, as wide as their column 'width' says");
  table.example("coastmesh rivers plain.nc rivers.gpkg --extent all --elements 3 --aspect 4 -o both.nc",
                "the same in a flood plain that is part of the mesh");
  return {{root, std::move(table)}, [usage](Run& run) { return runRivers(*usage, run); }};
}

}  // namespace coastmesh
