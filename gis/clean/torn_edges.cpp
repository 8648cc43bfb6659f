#include "gis/clean/torn_edges.hpp"

#include <cmath>

#include "core/metric.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

// The point at the share `t` of the way from a to b, the shorter way in longitude.
Point along(const Point& a, const Point& b, double t, bool geographic) {
  double dx = b.x - a.x;
  if (geographic && std::abs(dx) > 180 && std::abs(dx) < 360) dx -= std::copysign(360.0, dx);
  return {a.x + t * dx, a.y + t * (b.y - a.y)};
}

// True if the image of an edge jumps; otherwise small steps along the edge are small in the plane.
bool jumps(const Point& a, const Point& b, const Point& plane_a, const Point& plane_b, bool geographic,
           const Projection& projection) {
  constexpr int kSteps = 64;
  constexpr double kJump = 0.5;  // of the distance between the two ends
  const double longest = kJump * distance(plane_a, plane_b);
  Point before = plane_a;
  for (int i = 1; i <= kSteps; ++i) {
    const Point here =
        i < kSteps ? projection.forward(along(a, b, static_cast<double>(i) / kSteps, geographic)) : plane_b;
    if (distance(before, here) > longest) return true;
    before = here;
  }
  return false;
}

std::string inWords(const Point& p) { return std::to_string(p.x) + ", " + std::to_string(p.y); }

}  // namespace

void requireUntorn(const ProjectedChain& chain, double extent, const Crs& crs, const Projection& projection) {
  constexpr double kWorthALook = 0.125;  // of the extent
  const std::size_t n = chain.points.size();
  for (std::size_t i = chain.closed ? 0 : 1; i < n; ++i) {
    const std::size_t before = i > 0 ? i - 1 : n - 1;
    if (!(distance(chain.plane[before], chain.plane[i]) >= kWorthALook * extent)) continue;
    const Point &a = chain.points[before], &b = chain.points[i];
    if (!jumps(a, b, chain.plane[before], chain.plane[i], crs.geographic, projection)) continue;
    throw InputError(chain.owner + ": the CRS to work in, " + projection.description() + ", tears it apart between " +
                     inWords(a) + " and " + inWords(b) + ": leave out --crs, or give one that shows it in one piece");
  }
}

}  // namespace coastmesh
