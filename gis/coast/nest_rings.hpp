#pragma once

#include <cstddef>
#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// An outer ring and the holes directly inside it, as indices.
struct NestedRing {
  std::size_t outer = 0;
  std::vector<std::size_t> holes;
};

// Even-odd nesting: a ring in no other is an outer ring, one directly inside an outer ring is its hole, one directly
// inside a hole is an outer ring again. Rings may touch. If rings cross, the smaller is inside the other if its box is
// within the other's and its first vertex off the other ring is inside that. Outer rings are in the order given.
// `geographic`: in longitudes and latitudes; those that jump are continued past the antimeridian (`turnedRings`).
std::vector<NestedRing> nestRings(const std::vector<Ring>& rings, bool geographic);

}  // namespace coastmesh
