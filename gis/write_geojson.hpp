#pragma once

#include <string>

#include "gis/grid.hpp"

namespace coastmesh {

// The grid's layers as three GeoJSON files: `path` with the triangles, and beside it nodes and boundaries. Written here
// rather than by OGR, whose numbers do not all come back bit for bit and which takes what it cannot name for WGS 84.
// WGS 84 as RFC 7946 has it; other CRS in their own coordinates with the `crs` member of GeoJSON 2008, null for a
// plane. Throws OutputError, also for a CRS without a code, since GeoJSON can only name codes.
void writeGeoJson(const Grid& grid, const std::string& path);

}  // namespace coastmesh
