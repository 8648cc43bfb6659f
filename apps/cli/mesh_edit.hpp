#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/cli/commands.hpp"
#include "apps/edit/mesh_edit.hpp"
#include "apps/edit/mesh_file.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// What a command that changes a mesh writes.
struct EditOutputs {
  std::vector<std::string> meshes;
  std::string format;
  std::string numbers;  // the table with numbers in the mesh before; empty: none
  bool overwrite = false;
  bool quiet = false;
};

// Declares -o, --format, --numbers, --overwrite and --quiet. `label` and `help`: of --numbers.
void declareEditOutputs(OptionTable& table, EditOutputs& outputs, const std::string& label, const std::string& help);

// To be called once all is set. Throws OptionError for --numbers together with repairs.
void requireNumbers(const EditOutputs& outputs, const FinishOptions& finish);

// The course of such a command: reads the mesh, changes it by `edit`, warns, and writes the outputs. Returns an exit
// code.
int runMeshEdit(const MeshFile& mesh, const EditOutputs& outputs,
                const std::function<EditedMesh(Grid& grid, const JobControl& control)>& edit, Run& run);

}  // namespace coastmesh
