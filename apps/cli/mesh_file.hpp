#pragma once

#include <string>

#include "apps/cli/commands.hpp"
#include "apps/edit/mesh_file.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Declares the argument `name` and the option --assume-crs.
void declareMeshFile(OptionTable& table, const std::string& name, const std::string& help, MeshFile& file);

// `readMeshFile` with the warnings of a run.
Grid readMeshFile(const MeshFile& file, Run& run, FileNotes notes = FileNotes::Warnings);

// Warns that --assume-crs has no effect, if it was given.
void warnOfCrs(const MeshFile& file, const std::string& why, Run& run);

}  // namespace coastmesh
