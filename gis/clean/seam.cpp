#include "gis/clean/seam.hpp"

#include <algorithm>
#include <cmath>

#include "gis/geometry/box.hpp"

namespace coastmesh {

namespace {

// Adds the latitudes strictly between those of a and b, in the order from a to b.
void addBetween(const Point& a, const Point& b, const std::vector<double>& latitudes, std::vector<Point>& points) {
  const auto low = std::upper_bound(latitudes.begin(), latitudes.end(), std::min(a.y, b.y));
  const auto high = std::lower_bound(low, latitudes.end(), std::max(a.y, b.y));
  const auto begin = static_cast<std::ptrdiff_t>(points.size());
  for (auto at = low; at != high; ++at) points.push_back({a.x, *at});
  if (a.y > b.y) std::reverse(points.begin() + begin, points.end());
}

}  // namespace

std::optional<Seam> healSeam(const std::vector<Ring*>& rings, const Crs& crs, const Projection& projection) {
  if (!crs.geographic) return std::nullopt;
  Box box;
  for (const Ring* ring : rings) {
    for (const Point& p : *ring) box.add(p);
  }
  if (box.xmax - box.xmin != 360) return std::nullopt;
  const Seam seam{box.xmin, box.xmax};
  std::vector<double> latitudes;
  for (const Ring* ring : rings) {
    for (const Point& p : *ring) {
      if (seam.holds(p)) latitudes.push_back(p.y);
    }
  }
  std::sort(latitudes.begin(), latitudes.end());
  latitudes.erase(std::unique(latitudes.begin(), latitudes.end()), latitudes.end());
  const double middle = latitudes[latitudes.size() / 2];
  const Point west = projection.forward({box.xmin, middle});
  const Point east = projection.forward({box.xmax, middle});
  if (!(std::hypot(east.x - west.x, east.y - west.y) < 1e-3)) return std::nullopt;

  for (Ring* ring : rings) {
    Ring healed;
    for (std::size_t i = 0; i < ring->size(); ++i) {
      const Point &a = (*ring)[i], &b = (*ring)[(i + 1) % ring->size()];
      healed.push_back(a);
      if (a.x == b.x && seam.holds(a)) addBetween(a, b, latitudes, healed);
    }
    *ring = std::move(healed);
  }
  return seam;
}

}  // namespace coastmesh
