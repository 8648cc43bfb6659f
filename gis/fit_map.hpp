#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gis/coastline.hpp"
#include "gis/conformal_map.hpp"

namespace coastmesh {

// A conformal map chosen for an extent, and its name for people. Private to gis.
struct FittedMap {
  std::unique_ptr<ConformalMap> map;
  std::string description;
  std::string reason;  // why this one, for people
};

// Chooses by the extent of `lonlat` (degrees; any longitudes): transverse Mercator for what reaches north and south,
// Lambert's conic for what reaches east and west, polar stereographic around a pole, oblique stereographic for the rest
// and for all that is larger than a cap of 30 degrees. What is larger than a hemisphere is projected away from the
// middle of the largest place that `rings` (longitudes and latitudes, even-odd) leave out. Throws InputError where they
// leave out nothing. REQUIRES: `lonlat` is not empty, latitudes within ±90.
FittedMap fitMap(const std::vector<Point>& lonlat, const std::vector<const Ring*>& rings, const Ellipsoid& ellipsoid);

}  // namespace coastmesh
