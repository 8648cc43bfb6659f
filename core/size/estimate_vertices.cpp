#include "core/size/estimate_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/metric.hpp"

namespace coastmesh {

namespace {

// Vertices on each side of a segment much shorter than requested; measured on coasts at 33 degrees.
constexpr double kLeadingOut = 1.2;

// The number of requested lengths from a to b, by the trapezoid rule; stops past `enough`.
double lengthsAlong(const Point& a, const Point& b, const SizeFunction& size, const Surface& surface, double enough) {
  const double length = distance(a, b);
  const auto inPlane = [&](const Point& x) { return size.at(x) / surface.shrinkAt(x); };
  double along = 0.0, count = 0.0, here = inPlane(a);
  while (along < length && count <= enough) {
    const double next = std::min(along + here, length);
    if (!(next > along)) return enough + 1.0;  // lengths below the resolution of coordinates
    const double there = inPlane(a + (next / length) * (b - a));
    count += 0.5 * (next - along) * (1.0 / here + 1.0 / there);
    along = next;
    here = there;
  }
  return count;
}

}  // namespace

double verticesOfSegments(const Pslg& pslg, const SizeFunction& size, double enough, const Surface& surface,
                          const ItemLoop& loop) {
  constexpr std::size_t kLeastSegments = 512;  // few of a frame may be most of the work
  const std::vector<double> sums = overStretches(
      loop, pslg.segments.size(),
      [&](std::size_t first, std::size_t last) {
        double sum = 0.0;
        for (std::size_t i = first; i < last && sum <= enough; ++i) {
          const Segment& s = pslg.segments[i];
          const bool labelled = s.left != kUnlabelled || s.right != kUnlabelled;
          const int sides = labelled ? (s.left >= 0) + (s.right >= 0) : 1;
          const double lengths =
              lengthsAlong(pslg.points[s.a], pslg.points[s.b], size, surface, 2.0 * (enough - sum) + 1.0);
          if (sides == 1) sum += 0.5 * std::max(1.0, lengths);
          sum += sides * kLeadingOut * std::max(0.0, 1.0 - lengths);
        }
        return sum;
      },
      kLeastSegments);
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace coastmesh
