#include "gis/crs/resolution.hpp"

#include <algorithm>
#include <cmath>

namespace coastmesh {

namespace {

double largestCoordinate(const std::vector<Point>& points) {
  double largest = 0;
  for (const Point& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  return largest;
}

double grainOf(double largest) { return std::ldexp(largest, -44); }

}  // namespace

Resolution resolutionOf(const std::vector<Point>& plane, const std::vector<Point>& input, const Crs& crs, double scale,
                        double snap) {
  const double in_plane = largestCoordinate(plane);
  const double in_output = crs.isPlane() ? 0 : largestCoordinate(input) * metresPerUnit(crs) * scale;
  const double grain = grainOf(std::max(in_plane, in_output));
  return {grain, std::max(snap, grain)};
}

Resolution resolutionOf(const std::vector<Point>& plane) {
  const double grain = grainOf(largestCoordinate(plane));
  return {grain, grain};
}

}  // namespace coastmesh
