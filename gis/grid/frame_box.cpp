#include "gis/grid/frame_box.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "core/quality.hpp"
#include "gis/coast/feature_bounds.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/geometry/box.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/grid/local_plane.hpp"

namespace coastmesh {

FrameMoves keepInFrame(Grid& grid, const Coastline& coastline, double min_angle_deg, const ItemLoop& loop) {
  if (!coastline.framed_by_box) return {};
  Box box;
  bool in_parts = false;
  for (const Feature& feature : coastline.features) {
    if (feature.use != FeatureUse::Frame) continue;
    box.add(boundsOf(feature));
    in_parts = in_parts || feature.polygons.size() > 1;
  }
  const auto inBox = [&](const Point& p) {
    return Point{in_parts ? p.x : std::clamp(p.x, box.xmin, box.xmax), std::clamp(p.y, box.ymin, box.ymax)};
  };
  const std::vector<std::uint32_t> outside =
      joined(overStretches(loop, grid.nodes.size(), [&](std::size_t first, std::size_t last) {
        std::vector<std::uint32_t> some;
        for (std::size_t n = first; n < last; ++n)
          if (!(inBox(grid.nodes[n]) == grid.nodes[n])) some.push_back(static_cast<std::uint32_t>(n));
        return some;
      }));
  if (outside.empty()) return {};
  std::vector<std::uint8_t> moves(grid.nodes.size(), 0);
  for (const std::uint32_t n : outside) moves[n] = 1;
  const std::vector<std::size_t> changed =  // triangles
      joined(overStretches(loop, grid.triangles.size(), [&](std::size_t first, std::size_t last) {
        std::vector<std::size_t> some;
        for (std::size_t t = first; t < last; ++t)
          if (std::ranges::any_of(grid.triangles[t], [&](std::uint32_t n) { return moves[n] != 0; })) some.push_back(t);
        return some;
      }));
  const auto isShort = [&](std::size_t t) {
    const std::vector<Point> p = localPlane(grid, grid.triangles[t]);
    return leastAngleDeg(p[0], p[1], p[2]) < min_angle_deg - kAngleSlackDeg;
  };
  const auto isTurned = [&](std::size_t t) {
    const auto& [a, b, c] = grid.triangles[t];
    return orientationOnGround(grid.nodes[a], grid.nodes[b], grid.nodes[c], grid.crs) <= 0;
  };
  std::vector<std::uint8_t> was_short;  // a flag for each of `changed`
  for (const std::size_t t : changed) was_short.push_back(isShort(t));
  std::vector<Point> before;
  for (const std::uint32_t n : outside) {
    before.push_back(grid.nodes[n]);
    grid.nodes[n] = inBox(grid.nodes[n]);
  }
  // Nodes that are put back may invert triangles checked before. Each node is put back at most once.
  for (bool again = true; again;) {
    again = false;
    for (const std::size_t t : changed) {
      if (!isTurned(t)) continue;
      for (const std::uint32_t n : grid.triangles[t]) {
        if (moves[n] == 0) continue;
        const auto at = std::ranges::lower_bound(outside, n);
        grid.nodes[n] = before[static_cast<std::size_t>(at - outside.begin())];
        moves[n] = 0;
        again = true;
      }
    }
  }
  FrameMoves result;
  result.nodes = static_cast<std::size_t>(std::ranges::count(moves, std::uint8_t{1}));
  for (std::size_t k = 0; k < changed.size(); ++k)
    if (!was_short[k] && isShort(changed[k])) result.fell_short.push_back(static_cast<std::uint32_t>(changed[k]));
  std::vector<std::array<std::uint32_t, 3>> corners;
  for (const std::size_t t : changed) corners.push_back(grid.triangles[t]);
  if (!grid.area_m2.empty() && !corners.empty()) {
    const std::vector<double> areas = areasOfFew(grid.nodes, corners, grid.crs);
    for (std::size_t k = 0; k < changed.size(); ++k) grid.area_m2[changed[k]] = areas[k];
  }
  if (grid.min_angle_deg.empty()) return result;
  for (const std::size_t t : changed) {
    const std::vector<Point> p = localPlane(grid, grid.triangles[t]);
    grid.min_angle_deg[t] = leastAngleDeg(p[0], p[1], p[2]);
  }
  return result;
}

}  // namespace coastmesh
