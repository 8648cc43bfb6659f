#pragma once

#include <optional>
#include <string>

#include "gis/read/ogr_geometry.hpp"

namespace coastmesh {

// Streams a GeoJSON file that is one bare geometry, not a Feature. World maps come as one GeometryCollection of
// hundreds of megabytes; OGR builds a tree of the whole file first, which takes 25 bytes of memory per byte. Returns
// nullopt for any other file and for anything unusual in it: OGR then reads it, and reports errors. Coordinates are
// longitudes and latitudes on WGS 84 (RFC 7946).
std::optional<GeometryParts> readBareGeojson(const std::string& path);

}  // namespace coastmesh
