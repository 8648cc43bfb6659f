#pragma once

#include <string>

#include "gis/crs/crs_definition.hpp"

namespace coastmesh {

// `text` is "plane" or anything that PROJ accepts: "EPSG:32616", WKT, a PROJ string. Vertical axes are dropped; a local
// (engineering) CRS is a plane. Throws InputError, also for geocentric and vertical CRS and for geographic ones with
// units other than degrees.
Crs parseCrs(const std::string& text);

Crs wgs84();

// True if equal coordinates mean the same place in both.
bool sameCrs(const Crs& a, const Crs& b);

// Metres on the ground per unit of the coordinates, at a scale of 1; for degrees at the equator; 1 for a plane.
double metresPerUnit(const Crs& crs);

// The unit of a projected CRS: "metre", "US survey foot". REQUIRES: neither a plane nor geographic.
std::string unitOf(const Crs& crs);

// For messages: "EPSG:32616", else the CRS's own name, else "plane".
std::string nameOf(const Crs& crs);

}  // namespace coastmesh
