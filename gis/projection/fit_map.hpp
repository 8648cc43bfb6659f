#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/projection/conformal_map.hpp"
#include "gis/projection/surface_kind.hpp"

namespace coastmesh {

// A conformal map chosen for an extent, and its name for messages.
struct FittedMap {
  std::unique_ptr<ConformalMap> map;
  std::string description;
  std::string reason;       // why this one, for messages
  bool is_surface = false;  // lengths and angles are those of the map's sphere
};

// Rings in coordinates of a geographic CRS that enclose an area together, by the even-odd rule.
struct RingGroup {
  std::vector<const Ring*> rings;
  bool is_land = false;  // what it contains is left out, even if others contain it
};

// Chooses by the extent of the places (any longitudes): transverse Mercator for north-south extents, Lambert's conic
// for east-west extents, polar stereographic around a pole, oblique stereographic for the rest and for everything
// larger than a cap of 30 degrees. Extents larger than a hemisphere are projected from the centre of the largest
// area that is left out: on land, or in no group unless all are land. Throws InputError if there is none. Stereographic
// whenever a surface is requested, which the automatic choice does beyond that cap. REQUIRES: `places` is not empty,
// latitudes within ±90.
FittedMap fitMap(const std::vector<LonLat>& places, const std::vector<RingGroup>& groups, const Ellipsoid& ellipsoid,
                 SurfaceKind kind = SurfaceKind::Plane);

// Stereographic, for a globe without input: all places are equal, so the centre is arbitrary.
FittedMap mapOfEmptyGlobe(const Ellipsoid& ellipsoid);

}  // namespace coastmesh
