#pragma once

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// True for uses that limit, divide or name the water or the areas of others.
constexpr bool isGuest(FeatureUse use) {
  return use == FeatureUse::Frame || use == FeatureUse::Constraint || use == FeatureUse::Weir ||
         use == FeatureUse::Region;
}

// Moves polygons, lines and points of guests by full turns into the 360 degrees of longitude that begin at `west`.
// Those that reach over an end of this range stay, and so do frames. REQUIRES: the CRS is geographic.
void bringGuests(Coastline& coastline, double west);

}  // namespace coastmesh
