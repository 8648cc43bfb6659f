#pragma once

#include <optional>
#include <string>

#include "gis/read/ogr_geometry.hpp"

namespace coastmesh {

// The geometry of a GeoJSON file that is one bare geometry, no Feature: world maps come as one GeometryCollection of
// hundreds of megabytes, for which OGR, which builds a tree of the whole file first, needs 25 bytes of memory a byte;
// this reads it as it streams by. None for everything else and for whatever is odd about the file: OGR's turn then, and
// its say. Coordinates are longitudes and latitudes on WGS 84 (RFC 7946).
std::optional<GeometryParts> readBareGeojson(const std::string& path);

}  // namespace coastmesh
