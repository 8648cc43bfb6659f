#pragma once

#include <string>

#include "apps/cli/commands.hpp"
#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// A mesh file named on the command line.
struct MeshFile {
  std::string path;
  std::string crs;  // used if the file has none; empty: a plane
};

// Declares the argument `name` and the option --assume-crs.
void declareMeshFile(OptionTable& table, const std::string& name, const std::string& help, MeshFile& file);

// What becomes of a grid's `notes`.
enum class FileNotes { Warnings, Defects };

// Warns of what had to be chosen and, unless notes become defects later, of inconsistencies and omissions. Throws
// InputError, also for a mesh without triangles.
Grid readMeshFile(const MeshFile& file, Run& run, FileNotes notes = FileNotes::Warnings);

// Warns that --assume-crs has no effect, if it was given.
void warnOfCrs(const MeshFile& file, const std::string& why, Run& run);

// A warning of triangles that are not counter-clockwise, as grids and most models have them; empty if all are.
std::string windingWarning(const Grid& grid, const ItemLoop& loop);

}  // namespace coastmesh
