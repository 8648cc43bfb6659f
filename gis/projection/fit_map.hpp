#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/projection/conformal_map.hpp"
#include "gis/projection/surface_kind.hpp"

namespace coastmesh {

// A conformal map chosen for an extent, and its name for people.
struct FittedMap {
  std::unique_ptr<ConformalMap> map;
  std::string description;
  std::string reason;       // why this one, for people
  bool is_surface = false;  // lengths and angles are those of the map's sphere
};

// Rings in coordinates of a geographic CRS that hold something together, by the even-odd rule.
struct RingGroup {
  std::vector<const Ring*> rings;
  bool is_land = false;  // what it holds is left out, whatever else holds it
};

// Chooses by the extent of the places (any longitudes): transverse Mercator for what reaches north and south,
// Lambert's conic for what reaches east and west, polar stereographic around a pole, oblique stereographic for the rest
// and for all that is larger than a cap of 30 degrees. What is larger than a hemisphere is projected away from the
// middle of the largest place that is left out: on land, or in no group. Throws InputError where there is none.
// Stereographic wherever a surface is asked for, which the automatic choice does beyond that cap.
// REQUIRES: `places` is not empty, latitudes within ±90.
FittedMap fitMap(const std::vector<LonLat>& places, const std::vector<RingGroup>& groups, const Ellipsoid& ellipsoid,
                 SurfaceKind kind = SurfaceKind::Plane);

// Stereographic, for a globe with nothing on it: no place is special, so the centre is any.
FittedMap mapOfEmptyGlobe(const Ellipsoid& ellipsoid);

}  // namespace coastmesh
