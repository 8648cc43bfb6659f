#include "gis/flood_plain/plain_land.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "gis/geometry/edges_below.hpp"
#include "gis/grid/grid_edit.hpp"

namespace coastmesh {

// The boundary of a water in its working plane, in which the sides of the mesh are straight too.
struct PlainLand::Water {
  explicit Water(const Domain& domain) : projection(domain.projection), points(domain.pslg.points) {
    for (const Segment& s : domain.pslg.segments) {
      if ((s.left == kOutside) == (s.right == kOutside)) continue;
      edges.emplace_back(s.a, s.b);
      wet_on_left.push_back(s.right == kOutside);
      box.add(domain.input_points[s.a]);
      box.add(domain.input_points[s.b]);
    }
    // Sides that are straight in one of the planes are curved in the other.
    constexpr double kBulge = 0.1;
    box = box.grownBy(kBulge * std::max(box.xmax - box.xmin, box.ymax - box.ymin));
    below = std::make_unique<EdgesBelow>(points, edges);
  }

  bool holds(const Point& place) const {
    const std::uint32_t edge = below->at(projection.forward(place));
    return edge != kNone && wet_on_left[edge] == below->runsEast(edge);
  }

  Projection projection;
  std::vector<Point> points;
  std::vector<std::pair<VertexId, VertexId>> edges;
  std::vector<bool> wet_on_left;  // of each edge, from its first to its second end
  Box box;                        // in the coordinates of the input
  std::unique_ptr<const EdgesBelow> below;
};

PlainLand::PlainLand(const std::vector<Domain>& waters) {
  std::vector<Box> boxes;
  for (const Domain& water : waters) {
    waters_.push_back(std::make_shared<const Water>(water));
    boxes.push_back(waters_.back()->box);
  }
  boxes_ = BoxTree(boxes, BoxTree::Order::Hilbert);
}

bool PlainLand::isLand(const Point& place) const {
  bool in_water = false;
  boxes_.visit(Box::of(place, place), [&](std::uint32_t w) { in_water = in_water || waters_[w]->holds(place); });
  return !in_water;
}

LandFlags landFlags(const Grid& grid, const PlainLand* land, const ItemLoop& loop) {
  LandFlags flags;
  if (land == nullptr) return flags;
  flags.triangles.resize(grid.triangles.size());
  forEachByStretches(loop, grid.triangles.size(), [&](std::size_t t) {
    const auto& [a, b, c] = grid.triangles[t];
    const std::array corners{grid.nodes[a], grid.nodes[b], grid.nodes[c]};
    flags.triangles[t] = land->isLand(meanPlace(grid.crs, corners)) ? 1 : 0;
  });
  flags.nodes.resize(grid.nodes.size());
  forEachByStretches(loop, grid.nodes.size(), [&](std::size_t v) { flags.nodes[v] = land->isLand(grid.nodes[v]); });
  for (std::size_t t = 0; t < grid.triangles.size(); ++t)
    if (flags.triangles[t] == 0)
      for (const std::uint32_t corner : grid.triangles[t]) flags.nodes[corner] = 0;
  return flags;
}

}  // namespace coastmesh
