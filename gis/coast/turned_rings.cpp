#include "gis/coast/turned_rings.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace coastmesh {

namespace {

// An edge from pole to pole has no length, whatever its longitudes.
bool jumps(const Point& a, const Point& b) { return std::abs(a.x - b.x) > 180 && !(a.y == b.y && std::abs(a.y) == 90); }

}  // namespace

bool longitudesJump(const Ring& lonlat) {
  for (std::size_t i = 0; i < lonlat.size(); ++i) {
    if (jumps(lonlat[i], lonlat[(i + 1) % lonlat.size()])) return true;
  }
  return false;
}

std::vector<Ring> turnedRings(const Ring& lonlat) {
  if (!longitudesJump(lonlat)) return {lonlat};
  Ring ring{lonlat.front()};
  double turn = 0;
  for (std::size_t i = 1; i <= lonlat.size(); ++i) {
    const Point &a = lonlat[i - 1], &b = lonlat[i % lonlat.size()];
    if (jumps(a, b)) turn += a.x > b.x ? 360 : -360;
    ring.push_back({b.x + turn, b.y});
  }
  if (turn == 0) {
    ring.pop_back();
  } else {
    const double sum =
        std::accumulate(lonlat.begin(), lonlat.end(), 0.0, [](double so_far, const Point& p) { return so_far + p.y; });
    const double pole = sum < 0 ? -90 : 90;
    ring.insert(ring.end(), {{ring.back().x, pole}, {ring.front().x, pole}});
  }
  std::vector<Ring> rings;
  for (const double shift : {-360.0, 0.0, 360.0}) {
    rings.push_back(ring);
    for (Point& p : rings.back()) p.x += shift;
  }
  return rings;
}

}  // namespace coastmesh
