#pragma once

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh::testing {

using SpaceVector = std::array<double, 3>;

inline SpaceVector vectorOf(const Point& lonlat) {
  const double lon = lonlat.x * std::numbers::pi / 180.0, lat = lonlat.y * std::numbers::pi / 180.0;
  return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

inline double dot(const SpaceVector& a, const SpaceVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline SpaceVector cross(const SpaceVector& a, const SpaceVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double lengthOf(const SpaceVector& a) { return std::sqrt(dot(a, a)); }

// The closed globe: an octahedron with a corner at each pole, its triangles divided in four `times` times; only
// triangles that are `wanted` are kept. Nodes on the antimeridian have a longitude of 180.
template <typename Wanted>
Grid octahedralGlobe(int times, const Wanted& wanted) {
  std::vector<SpaceVector> places{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t west = 1 + k, east = 1 + (k + 1) % 4;
    triangles.push_back({west, east, 0});
    triangles.push_back({east, west, 5});
  }
  for (int time = 0; time < times; ++time) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, made] =
          middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(places.size()));
      if (made) {
        SpaceVector sum{places[a][0] + places[b][0], places[a][1] + places[b][1], places[a][2] + places[b][2]};
        const double length = lengthOf(sum);
        for (double& x : sum) x /= length;
        places.push_back(sum);
      }
      return found->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  Grid grid;
  grid.crs = wgs84();
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  std::vector<std::uint32_t> number(places.size(), kNone);
  for (auto corners : triangles) {
    SpaceVector sum{};
    for (const std::uint32_t node : corners)
      for (std::size_t k = 0; k < 3; ++k) sum[k] += places[node][k];
    if (!wanted(sum)) continue;
    for (std::uint32_t& corner : corners) {
      if (number[corner] == kNone) {
        number[corner] = static_cast<std::uint32_t>(grid.nodes.size());
        const SpaceVector& p = places[corner];
        const bool pole = p[0] == 0.0 && p[1] == 0.0;
        grid.nodes.push_back(
            {pole ? 0.0 : std::atan2(p[1], p[0]) * kDegrees, std::atan2(p[2], std::hypot(p[0], p[1])) * kDegrees});
      }
      corner = number[corner];
    }
    grid.triangles.push_back(corners);
  }
  std::vector<EdgeConflict> conflicts;
  grid.boundaries = findBoundaries(linkTriangles(grid.nodes, grid.triangles, conflicts));
  return grid;
}

}  // namespace coastmesh::testing
