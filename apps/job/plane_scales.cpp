#include "apps/job/plane_scales.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace coastmesh {

namespace {

using ScaleAt = double (Projection::*)(const Point&) const;

// Smallest and largest value of a scale, `Projection::scaleAt` or `measureAt`, at a sample of the points.
std::pair<double, double> scaleRange(std::span<const Point> points, const Projection& projection, ScaleAt scale_at) {
  constexpr std::size_t kLeastSample = 16, kMostSample = 1024, kPointsForOne = 16;
  double least = std::numeric_limits<double>::infinity(), greatest = 0.0;
  const std::size_t count = points.size();
  const std::size_t step =
      std::max<std::size_t>(1, count / std::clamp(count / kPointsForOne, kLeastSample, kMostSample));
  for (std::size_t i = 0; i < count; i += step) {
    const double scale = (projection.*scale_at)(points[i]);
    least = std::min(least, scale);
    greatest = std::max(greatest, scale);
  }
  return {least, greatest};
}

}  // namespace

Point centreOf(const Pslg& pslg) {
  if (pslg.points.empty()) return {};  // a whole globe
  Point low = pslg.points.front();
  Point high = low;
  for (const Point& p : pslg.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return {low.x + (high.x - low.x) / 2, low.y + (high.y - low.y) / 2};
}

std::pair<double, double> scaleRange(std::span<const Point> points, const Projection& projection) {
  return scaleRange(points, projection, &Projection::scaleAt);
}

std::pair<double, double> measureRange(const Domain& domain) {
  const double centre = domain.projection.measureAt(centreOf(domain.pslg));
  const auto [least, greatest] = scaleRange(domain.pslg.points, domain.projection, &Projection::measureAt);
  return {std::min(centre, least), std::max(centre, greatest)};
}

}  // namespace coastmesh
