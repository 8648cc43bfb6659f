#pragma once

#include <string>

#include "gis/grid.hpp"

namespace coastmesh {

// Triangle's .node and .ele, numbered from 1, with the boundaries as segments in a .poly and the CRS in a .prj; `path`
// is any of them. z is the attribute of a node, the feature's fid that of a triangle. Segments are marked with
// `boundaryMarker`, nodes with that of the first boundary they lie on. Islands have a hole point. Throws OutputError.
void writeTriangle(const Grid& grid, const std::string& path);

}  // namespace coastmesh
