#include "gis/crs/ground_balls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/metric.hpp"

namespace coastmesh {

GroundBalls::GroundBalls(const Crs& crs) {
  if (!crs.isPlane()) map_.emplace(crs);
}

SpacePoint GroundBalls::inSpace(const Point& place) const {
  if (!map_) return {place.x, place.y, 0.0};
  constexpr double kEarth = 6'371'000.0;
  const LonLat ground = map_->forward(place);
  const double lon = toRadians(ground.lon), lat = toRadians(ground.lat);
  return kEarth * SpacePoint{std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

SpaceBall GroundBalls::around(std::span<const Point> places) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  SpacePoint low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (const Point& place : places) {
    const SpacePoint p = inSpace(place);
    if (!std::isfinite(p.x + p.y + p.z)) return {{}, kInfinity};
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return {0.5 * (low + high), 0.5 * distance(low, high)};
}

}  // namespace coastmesh
