#include "gis/elements/measure_unknown.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/quality.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/elements/quads.hpp"
#include "gis/grid/local_plane.hpp"

namespace coastmesh {

namespace {

std::vector<std::uint32_t> unknownIn(const BulkList<double>& values) {
  std::vector<std::uint32_t> unknown;
  for (std::uint32_t t = 0; t < values.size(); ++t)
    if (std::isnan(values[t])) unknown.push_back(t);
  return unknown;
}

void measureAngles(Grid& grid, const ItemLoop& loop) {
  const std::vector<std::uint32_t> unknown = unknownIn(grid.min_angle_deg);
  if (unknown.empty()) return;
  for (const Quad& quad : quadsOf(grid))
    for (const std::uint32_t t : quad.halves)
      if (std::isnan(grid.min_angle_deg[t])) grid.min_angle_deg[t] = std::ranges::min(anglesOf(grid, quad));
  loop(unknown.size(), [&](std::size_t i) {
    const std::uint32_t t = unknown[i];
    if (!std::isnan(grid.min_angle_deg[t])) return;
    const auto [a, b, c] = localPlane(grid, grid.triangles[t]);
    grid.min_angle_deg[t] = leastAngleDeg(a, b, c);
  });
}

}  // namespace

void measureUnknown(Grid& grid, const ItemLoop& loop) {
  measureAngles(grid, loop);
  const std::vector<std::uint32_t> unknown = unknownIn(grid.area_m2);
  if (unknown.empty()) return;
  std::vector<std::array<std::uint32_t, 3>> corners;
  for (const std::uint32_t t : unknown) corners.push_back(grid.triangles[t]);
  const std::vector<double> areas = areasOfFew(grid.nodes, corners, grid.crs, loop);
  for (std::size_t i = 0; i < unknown.size(); ++i) grid.area_m2[unknown[i]] = areas[i];
}

}  // namespace coastmesh
