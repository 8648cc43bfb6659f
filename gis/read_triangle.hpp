#pragma once

#include <string>

#include "gis/grid.hpp"

namespace coastmesh {

// Triangle's .node and .ele, numbered from 0 or 1, with the boundaries of a .poly where its markers are ours, and the
// CRS of a .prj beside them; `path` is the .node or the .ele. A single attribute of the nodes is z, a whole number as
// the attribute of the triangles their feature. Throws InputError with file and line.
Grid readTriangle(const std::string& path);

}  // namespace coastmesh
