#include "gis/clean/frame_sides.hpp"

#include <algorithm>
#include <cmath>

#include "gis/geometry/box.hpp"

namespace coastmesh {

namespace {

Box around(const std::vector<Point>& points) {
  Box box;
  for (const Point& p : points) box.add(p);
  return box.empty() ? box : box.grownBy(std::max(box.xmax - box.xmin, box.ymax - box.ymin));
}

}  // namespace

std::vector<std::pair<Point, Point>> frameSidesNear(const Coastline& coastline, std::span<const std::size_t> frames,
                                                    const Domain& domain) {
  std::vector<std::pair<Point, Point>> sides;
  if (frames.empty()) return sides;
  // The first box is a cheap test. Far away, the plane may not show a frame.
  const Box near_input = around(domain.input_points), near = around(domain.pslg.points);
  const auto add = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if (!near_input.meets(Box::of(a, b))) continue;
      const Point from = domain.projection.forward(a), to = domain.projection.forward(b);
      const bool is_shown = std::isfinite(from.x + from.y + to.x + to.y);
      if (is_shown && near.meets(Box::of(from, to))) sides.emplace_back(from, to);
    }
  };
  for (const std::size_t frame : frames) {
    for (const Polygon& polygon : coastline.features[frame].polygons) {
      add(polygon.outer);
      for (const Ring& hole : polygon.holes) add(hole);
    }
  }
  return sides;
}

}  // namespace coastmesh
