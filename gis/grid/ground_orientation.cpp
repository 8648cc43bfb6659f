#include "gis/grid/ground_orientation.hpp"

#include <GeographicLib/Math.hpp>
#include <cmath>
#include <limits>

#include "core/predicates.hpp"
#include "gis/crs/lon_lat.hpp"
#include "gis/grid/grid_edit.hpp"

namespace coastmesh {

namespace {

using GeographicLib::Math;

struct Direction {
  double east, north;
};

// The direction from `from` to `to` on the unit sphere: components of the vector of `to` along the tangents at `from`.
// They are computed from differences of longitudes and latitudes, so they stay precise however close the two are.
Direction seenFrom(const LonLat& from, const LonLat& to) {
  double rest_lon, rest_lat;
  const double lon = Math::AngDiff(from.lon, to.lon, rest_lon), lat = Math::AngDiff(from.lat, to.lat, rest_lat);
  double sin_lon, cos_lon, sin_half, cos_half, sin_lat, cos_lat, sin_from, cos_from, sin_to, cos_to;
  Math::sincosd(lon + rest_lon, sin_lon, cos_lon);
  Math::sincosd((lon + rest_lon) / 2, sin_half, cos_half);
  Math::sincosd(lat + rest_lat, sin_lat, cos_lat);
  Math::sincosd(from.lat, sin_from, cos_from);
  Math::sincosd(to.lat, sin_to, cos_to);
  return {cos_to * sin_lon, sin_lat + 2 * sin_from * cos_to * sin_half * sin_half};
}

}  // namespace

int orientationOnGround(const Point& a, const Point& b, const Point& c, const Crs& crs) {
  if (!crs.geographic) return orient2d(a, b, c);
  constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();
  const LonLat apex = asLonLat(a);
  const Direction to_b = seenFrom(apex, asLonLat(b)), to_c = seenFrom(apex, asLonLat(c));
  const double left = to_b.east * to_c.north, right = to_b.north * to_c.east;
  const double determinant = left - right;
  if (std::abs(determinant) <= kRounding * (std::abs(left) + std::abs(right))) return 0;
  return determinant > 0 ? 1 : -1;
}

std::vector<std::uint32_t> turnedTriangles(const Grid& grid, std::span<const double> area_m2, const ItemLoop& loop) {
  // Square metres: more than the error of areas between geodesics around half the globe.
  constexpr double kSureArea = 1.0;
  return joined(overStretches(loop, grid.triangles.size(), [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> turned;
    for (std::size_t t = first; t < last; ++t) {
      const auto& [a, b, c] = grid.triangles[t];
      const bool sure = grid.crs.geographic && !area_m2.empty() && std::abs(area_m2[t]) > kSureArea;
      const bool right =
          sure ? area_m2[t] > 0 : orientationOnGround(grid.nodes[a], grid.nodes[b], grid.nodes[c], grid.crs) > 0;
      if (!right) turned.push_back(static_cast<std::uint32_t>(t));
    }
    return turned;
  }));
}

Point middleOf(const Grid& grid, std::uint32_t triangle) {
  const auto& [a, b, c] = grid.triangles[triangle];
  return meanPlace(grid.crs, std::array{grid.nodes[a], grid.nodes[b], grid.nodes[c]});
}

}  // namespace coastmesh
