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

void keepInFrame(Grid& grid, const Coastline& coastline) {
  if (!coastline.framed_by_box) return;
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
  std::vector<bool> outside(grid.nodes.size(), false);
  for (std::size_t n = 0; n < grid.nodes.size(); ++n) outside[n] = !(inBox(grid.nodes[n]) == grid.nodes[n]);
  std::vector<std::size_t> changed;  // triangles
  for (std::size_t t = 0; t < grid.triangles.size(); ++t)
    if (std::ranges::any_of(grid.triangles[t], [&](std::uint32_t n) { return outside[n]; })) changed.push_back(t);
  const std::vector<Point> before = grid.nodes;
  for (std::size_t n = 0; n < grid.nodes.size(); ++n)
    if (outside[n]) grid.nodes[n] = inBox(grid.nodes[n]);
  const auto isTurned = [&](std::size_t t) {
    const auto& [a, b, c] = grid.triangles[t];
    return orientationOnGround(grid.nodes[a], grid.nodes[b], grid.nodes[c], grid.crs) <= 0;
  };
  // Nodes that go back may turn over what was looked at before; each can go back once.
  for (bool again = true; again;) {
    again = false;
    for (const std::size_t t : changed) {
      if (!isTurned(t)) continue;
      for (const std::uint32_t n : grid.triangles[t]) {
        again = again || !(grid.nodes[n] == before[n]);
        grid.nodes[n] = before[n];
      }
    }
  }
  std::vector<std::array<std::uint32_t, 3>> corners;
  for (const std::size_t t : changed) corners.push_back(grid.triangles[t]);
  if (!grid.area_m2.empty() && !corners.empty()) {
    const std::vector<double> areas = triangleAreas(grid.nodes, corners, grid.crs);
    for (std::size_t k = 0; k < changed.size(); ++k) grid.area_m2[changed[k]] = areas[k];
  }
  if (grid.min_angle_deg.empty()) return;
  for (const std::size_t t : changed) {
    const std::vector<Point> p = localPlane(grid, grid.triangles[t]);
    grid.min_angle_deg[t] = std::ranges::min(anglesDeg(p[0], p[1], p[2]));
  }
}

}  // namespace coastmesh
