#include "gis/model/apart_waters.hpp"

#include <algorithm>
#include <array>
#include <compare>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "gis/geometry/union_find.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/ground_orientation.hpp"

namespace coastmesh {

namespace {

// For each triangle: whether it has no connection to an open boundary, and the first triangle of its water. Empty if
// there is no such boundary.
struct Apart {
  std::vector<bool> is_apart;
  std::vector<std::uint32_t> water;
};

// The areas of waters by their first triangles.
using WaterAreas = std::map<std::uint32_t, double>;

double sumOf(const WaterAreas& areas) {
  double sum = 0.0;
  for (const auto& [first, area] : areas) sum += area;
  return sum;
}

double largestOf(const WaterAreas& areas) {
  double largest = 0.0;
  for (const auto& [first, area] : areas) largest = std::max(largest, area);
  return largest;
}

// The edges of a grid's triangles in either direction, as clockwise triangles may be among them.
class EdgesByNode {
 public:
  struct Edge {
    std::uint32_t other = 0, triangle = 0;  // the end with the larger number
    friend auto operator<=>(const Edge&, const Edge&) = default;
  };

  EdgesByNode(const Grid& grid, const ItemLoop& loop)
      : first_(grid.nodes.size() + 1, 0), edges_(3 * grid.triangles.size()) {
    const auto forEachEdge = [&grid](const auto& use) {
      for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) {
        const auto& [a, b, c] = grid.triangles[t];
        use(std::min(a, b), Edge{std::max(a, b), t});
        use(std::min(b, c), Edge{std::max(b, c), t});
        use(std::min(c, a), Edge{std::max(c, a), t});
      }
    };
    forEachEdge([this](std::uint32_t node, const Edge&) { ++first_[node + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    forEachEdge([&](std::uint32_t node, const Edge& edge) { edges_[next[node]++] = edge; });
    forEachByStretches(loop, grid.nodes.size(), [this](std::size_t node) {
      std::sort(edges_.begin() + first_[node], edges_.begin() + first_[node + 1]);
    });
  }

  // The edges from a node to those with larger numbers, in their order.
  std::span<const Edge> from(std::uint32_t node) const {
    return std::span(edges_).subspan(first_[node], first_[node + 1] - first_[node]);
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<Edge> edges_;
};

Apart apartOf(const Grid& grid, const ItemLoop& loop) {
  const EdgesByNode edges(grid, loop);
  UnionFind waters(grid.triangles.size());
  for (std::uint32_t node = 0; node < grid.nodes.size(); ++node) {
    const std::span<const EdgesByNode::Edge> there = edges.from(node);
    for (std::size_t i = 1; i < there.size(); ++i)
      if (there[i].other == there[i - 1].other) waters.unite(there[i].triangle, there[i - 1].triangle);
  }

  std::vector<bool> reached(grid.triangles.size(), false);  // of a water's first triangle
  bool any = false;
  for (const Boundary& boundary : grid.boundaries) {
    if (boundary.role != BoundaryRole::Open && boundary.role != BoundaryRole::River) continue;
    for (std::size_t i = 0; i + 1 < boundary.nodes.size(); ++i) {
      const auto [from, to] = std::minmax(boundary.nodes[i], boundary.nodes[i + 1]);
      const std::span<const EdgesByNode::Edge> there = edges.from(from);
      const auto found = std::ranges::lower_bound(there, to, {}, &EdgesByNode::Edge::other);
      if (found == there.end() || found->other != to) continue;
      reached[waters.find(found->triangle)] = true;
      any = true;
    }
  }
  if (!any) return {};
  Apart apart;
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) {
    apart.water.push_back(waters.find(t));
    apart.is_apart.push_back(!reached[apart.water.back()]);
  }
  return apart;
}

}  // namespace

std::vector<ApartWater> apartWaters(const Grid& grid, const ItemLoop& loop) {
  const Apart apart = apartOf(grid, loop);
  std::map<std::uint32_t, std::size_t> counts;
  for (std::uint32_t t = 0; t < apart.water.size(); ++t)
    if (apart.is_apart[t]) ++counts[apart.water[t]];
  std::vector<ApartWater> found;
  for (const auto& [first, count] : counts) found.push_back({first, count});
  return found;
}

bool isOneWater(const Grid& grid) {
  // Tests connections through nodes. They are connections through edges too unless a node alone connects two parts:
  // more than two boundary edges would end in it.
  std::vector<std::uint8_t> ends(grid.nodes.size(), 0);
  for (const Boundary& boundary : grid.boundaries) {
    const std::size_t edges = boundary.closed ? boundary.nodes.size() : boundary.nodes.size() - 1;
    for (std::size_t i = 0; i < edges && !boundary.nodes.empty(); ++i)
      for (const std::uint32_t node : {boundary.nodes[i], boundary.nodes[(i + 1) % boundary.nodes.size()]})
        if (++ends[node] > 2) return false;
  }
  UnionFind nodes(grid.nodes.size());
  for (const auto& [a, b, c] : grid.triangles) {
    nodes.unite(a, b);
    nodes.unite(b, c);
  }
  return std::ranges::all_of(grid.triangles,
                             [&](const auto& v) { return nodes.find(v[0]) == nodes.find(grid.triangles[0][0]); });
}

DroppedWaters dropApartWaters(Grid& grid, GrazedWaters grazed, const ItemLoop& loop) {
  constexpr double kLittle = 0.1;  // share of all water, or of the largest: less is hardly what the user means
  if (isOneWater(grid)) return {};
  Apart apart = apartOf(grid, loop);
  WaterAreas left_out, at_open;
  for (std::uint32_t t = 0; t < apart.water.size(); ++t)
    (apart.is_apart[t] ? left_out : at_open)[apart.water[t]] += grid.area_m2[t];
  const double all = sumOf(left_out) + sumOf(at_open);
  if (sumOf(at_open) < kLittle * all) return {};
  DroppedWaters dropped;
  const double least = grazed == GrazedWaters::Drop ? kLittle * largestOf(at_open) : 0.0;
  for (const auto& [first, area] : at_open) {
    if (area >= least) continue;
    left_out[first] = area;
    ++dropped.at_open;
  }
  if (left_out.empty()) return {};
  double largest = 0.0;
  for (const auto& [first, area] : left_out) {
    if (area <= largest) continue;
    largest = area;
    dropped.place = middleOf(grid, first);
  }
  for (std::uint32_t t = 0; t < apart.water.size(); ++t) {
    apart.is_apart[t] = left_out.contains(apart.water[t]);
    if (apart.is_apart[t] && !grid.feature_of.empty()) dropped.area_of[grid.feature_of[t]] += grid.area_m2[t];
  }
  dropped.waters = left_out.size();
  dropped.area_m2 = sumOf(left_out);
  dropped.share = dropped.area_m2 / all;
  dropped.in_plane = grid.crs.isPlane();
  removeTriangles(grid, apart.is_apart);
  removeUnusedNodes(grid);
  return dropped;
}

}  // namespace coastmesh
