#include "core/size/on_surface.hpp"

#include <cmath>

namespace coastmesh {

namespace {

// If the scale factor varies by less than this share in a rectangle, that in its middle is used, which avoids sums that
// nearly cancel.
constexpr double kAlike = 1e-3;

}  // namespace

// The area is the integral of the squared scale factor, which is the divergence of half the position times the scale
// factor. So it is the flux through the four sides, an arctangent each.
double areaOn(const Surface& surface, const Point& low, const Point& high) {
  const double width = high.x - low.x, height = high.y - low.y;
  if (!surface.isCurved()) return width * height;
  const Point middle = midpoint(low, high);
  const double near_x = std::max(std::abs(middle.x) - 0.5 * width, 0.0);
  const double near_y = std::max(std::abs(middle.y) - 0.5 * height, 0.0);
  const double most = surface.shrinkAt({near_x, near_y});
  const double least = surface.shrinkAt({std::abs(middle.x) + 0.5 * width, std::abs(middle.y) + 0.5 * height});
  if (most <= least * (1.0 + kAlike)) {
    const double shrink = surface.shrinkAt(middle);
    return width * height * shrink * shrink;
  }
  const double per_length = std::sqrt(surface.curvature);
  // The flux times the curvature, through a side at `across` from the origin, from `from` to `to` along it.
  const auto through = [&](double across, double from, double to) {
    const double u = per_length * across, away = std::sqrt(1.0 + u * u);
    return 0.5 * u / away * (std::atan(per_length * to / away) - std::atan(per_length * from / away));
  };
  return (through(high.x, low.y, high.y) - through(low.x, low.y, high.y) + through(high.y, low.x, high.x) -
          through(low.y, low.x, high.x)) /
         surface.curvature;
}

}  // namespace coastmesh
