#pragma once

#include <functional>
#include <string>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// A mesh file, and what its user says of it.
struct MeshFile {
  std::string path;
  std::string crs;  // used if the file has none; empty: a plane
};

// What becomes of a grid's `notes` on a file that models read; other files get warnings.
enum class FileNotes { Warnings, Defects };

// Receives warnings, each a sentence, as soon as there are any: an error may follow.
using Warn = std::function<void(const std::string& text)>;

// Warns of what had to be chosen and, unless notes become defects later, of inconsistencies and omissions. Throws
// InputError, also for a mesh without triangles, and OptionError for a CRS that is none.
Grid readMeshFile(const MeshFile& file, const Warn& warn, FileNotes notes = FileNotes::Warnings);

// The same CRS for a mesh at hand, `file.path` being its name in messages. Warns if it has its own.
void assumeCrs(Grid& grid, const MeshFile& file, const Warn& warn);

// True if coordinates in a plane may be degrees. Longitudes are those of any turn that files have: 0 to 360, or on past
// 180. Flumes and other small planes begin at the origin or lie around it, where there is nothing but ocean: no land is
// nearer to 0°, 0° than 4.5°.
bool mayBeDegrees(const Grid& grid);

// A warning of triangles that are not counter-clockwise, as grids and most models have them; empty if all are.
std::string windingWarning(const Grid& grid, const ItemLoop& loop);

}  // namespace coastmesh
