#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/point.hpp"
#include "core/refine/refine_options.hpp"

namespace coastmesh {

// A polygon, counter-clockwise. Sides that are kept get no further points.
struct JunctionOutline {
  std::vector<Point> points;
  std::vector<std::uint8_t> keeps;  // for each side, that from the point of its number
};

struct JunctionMesh {
  std::vector<Point> points;  // those of the outline first
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Fills a polygon with triangles within the bounds on angles, except where sides that are kept leave no room for them.
// REQUIRES: no two sides meet other than at their ends.
JunctionMesh fillJunction(const JunctionOutline& outline, const RefineOptions& options);

}  // namespace coastmesh
