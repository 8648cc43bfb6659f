#pragma once

#include <vector>

#include "core/point.hpp"

namespace coastmesh {

// A centre line in the working plane.
struct PlaneRiver {
  std::vector<Point> points;     // at least two, no two that follow one another are equal
  double width = 0.0;            // plane units; the usual one
  std::vector<double> widths{};  // at the points; empty: the same everywhere
};

}  // namespace coastmesh
