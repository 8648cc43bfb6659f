#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/cli/commands.hpp"
#include "apps/cli/mesh_file.hpp"
#include "apps/usage/part_usage.hpp"
#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// What a command says of its change of a mesh.
struct MeshEdit {
  std::vector<std::string> warnings;                                                // empty ones are left out
  std::function<std::string(const Grid& grid)> text;                                // the summary, of the repaired mesh
  std::function<void(const std::string& path, const ItemLoop& loop)> writeNumbers;  // the table of --numbers
};

// The course of commands that change a mesh: reads it, changes it by `edit`, repairs it for the targets, warns, and
// writes the outputs. `name`: of the command. Returns an exit code.
int runMeshEdit(const std::string& name, const MeshFile& mesh, const PartUsage& part,
                const std::function<MeshEdit(Grid& grid, const RunControl& control, const ItemLoop& loop)>& edit,
                Run& run);

}  // namespace coastmesh
