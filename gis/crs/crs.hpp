#pragma once

#include <string>

#include "gis/crs/crs_definition.hpp"

namespace coastmesh {

// `text` is "plane" or anything that PROJ knows: "EPSG:32616", WKT, a PROJ string. Vertical axes are dropped; a local
// (engineering) CRS is a plane. Throws InputError, also for geocentric CRS and for geographic ones that do not measure
// in degrees.
Crs parseCrs(const std::string& text);

Crs wgs84();

// True iff coordinates mean the same place in both.
bool sameCrs(const Crs& a, const Crs& b);

// Metres on the ground that a unit of the coordinates stands for, at a scale of 1; of degrees those at the equator; 1
// for a plane.
double metresPerUnit(const Crs& crs);

// For people: "EPSG:32616", else the name that the CRS gives itself, else "plane".
std::string nameOf(const Crs& crs);

}  // namespace coastmesh
