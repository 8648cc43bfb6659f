#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "core/point.hpp"

namespace coastmesh {

// A whole turn of longitudes that contains those of some points.
struct LongitudeRange {
  double west = -180.0;

  double bring(double longitude) const {
    if (longitude >= west && longitude <= west + 360.0) return longitude;
    return longitude - 360.0 * std::floor((longitude - west) / 360.0);
  }
};

// That of -180 to 180 and 0 to 360 in which the points are, or else one around their middle. REQUIRES: at least one
// point.
inline LongitudeRange rangeOf(std::span<const Point> points) {
  const auto [least, greatest] = std::ranges::minmax(points, {}, &Point::x);
  if (least.x >= -180.0 && greatest.x <= 180.0) return {-180.0};
  if (least.x >= 0.0 && greatest.x <= 360.0) return {0.0};
  return {(least.x + greatest.x) / 2.0 - 180.0};
}

}  // namespace coastmesh
