#pragma once

#include <ogr_spatialref.h>

#include <optional>
#include <string>
#include <string_view>

#include "gis/crs/crs.hpp"

namespace coastmesh {

// OGR's name for the CRS of a GeoPackage layer that has none.
inline constexpr std::string_view kUndefinedGeographic = "Undefined geographic SRS";

// The CRS of `srs`; a plane for null, and for an undefined one. Looks up the EPSG code if the source has none that
// PROJ knows, as in the WKT of a .prj file. Throws InputError with `source`, whose CRS it is, in front: "'lake.prj'".
Crs fromOgr(const OGRSpatialReference* srs, const std::string& source);

// The same for WKT of any kind; nullopt if it is none.
std::optional<Crs> crsFromWkt(const std::string& wkt, const std::string& source);

}  // namespace coastmesh
