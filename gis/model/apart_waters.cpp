#include "gis/model/apart_waters.hpp"

#include <algorithm>
#include <array>
#include <compare>
#include <functional>
#include <map>
#include <span>
#include <utility>

#include "core/bulk_list.hpp"
#include "core/large_list.hpp"
#include "core/union_find.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/ground_orientation.hpp"

namespace coastmesh {

namespace {

// For each triangle the first triangle of its water, and for each of these whether the water is connected to an open
// boundary. Empty if there is no such boundary.
struct Apart {
  BulkList<std::uint32_t> water;
  std::vector<std::uint8_t> reached;

  bool isApart(std::uint32_t t) const { return reached[water[t]] == 0; }
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
      : grid_(grid),
        last_(noNumbers(loop, grid.nodes.size())),
        before_(unsetList<std::uint32_t>(3 * grid.triangles.size())) {
    forEachByStretches(loop, grid.triangles.size(), [this](std::size_t t) {
      for (unsigned i = 0; i < 3; ++i) {
        const auto edge = static_cast<std::uint32_t>(3 * t + i);
        const auto [low, high] = endsOf(edge);
        before_[edge] = __atomic_exchange_n(&last_[low], edge, __ATOMIC_RELAXED);
      }
    });
  }

  // The edges from a node to those with larger numbers, in their order, in a list whose memory is used again.
  void listFrom(std::uint32_t node, std::vector<Edge>& edges) const {
    edges.clear();
    for (std::uint32_t edge = last_[node]; edge != kNone; edge = before_[edge])
      edges.push_back({endsOf(edge).second, edge / 3});
    std::ranges::sort(edges);
  }

 private:
  std::pair<std::uint32_t, std::uint32_t> endsOf(std::uint32_t edge) const {
    const auto& corners = grid_.triangles[edge / 3];
    return std::minmax({corners[edge % 3], corners[(edge % 3 + 1) % 3]});
  }

  const Grid& grid_;
  // Edge i of triangle t is 3 t + i: the last of each node, and the one before each.
  BulkList<std::uint32_t> last_, before_;
};

Apart apartOf(const Grid& grid, const ItemLoop& loop) {
  using Edge = EdgesByNode::Edge;
  const EdgesByNode edges(grid, loop);
  SharedUnionFind waters(grid.triangles.size(), loop);
  forStretches(loop, grid.nodes.size(), [&](std::size_t first, std::size_t last) {
    std::vector<Edge> there;
    for (std::size_t node = first; node < last; ++node) {
      edges.listFrom(static_cast<std::uint32_t>(node), there);
      for (std::size_t i = 1; i < there.size(); ++i)
        if (there[i].other == there[i - 1].other) waters.unite(there[i].triangle, there[i - 1].triangle);
    }
  });

  std::vector<Edge> there;
  const auto triangleAt = [&](std::uint32_t a, std::uint32_t b) {
    const auto [from, to] = std::minmax(a, b);
    edges.listFrom(from, there);
    const auto found = std::ranges::lower_bound(there, to, {}, &Edge::other);
    return found == there.end() || found->other != to ? kNone : found->triangle;
  };
  for (const Boundary& boundary : grid.boundaries) {
    for (std::size_t i = 0; i + 1 < boundary.back_nodes.size(); ++i) {
      const std::uint32_t front = triangleAt(boundary.nodes[i], boundary.nodes[i + 1]);
      const std::uint32_t back = triangleAt(boundary.back_nodes[i], boundary.back_nodes[i + 1]);
      if (front != kNone && back != kNone) waters.unite(front, back);
    }
  }
  Apart apart;
  apart.reached.resize(grid.triangles.size(), 0);
  bool any = false;
  for (const Boundary& boundary : grid.boundaries) {
    if (boundary.role != BoundaryRole::Open && boundary.role != BoundaryRole::River) continue;
    for (std::size_t i = 0; i + 1 < boundary.nodes.size(); ++i) {
      const std::uint32_t t = triangleAt(boundary.nodes[i], boundary.nodes[i + 1]);
      if (t == kNone) continue;
      apart.reached[waters.find(t)] = 1;
      any = true;
    }
  }
  if (!any) return {};
  resizeUnset(apart.water, grid.triangles.size());
  forEachByStretches(loop, apart.water.size(),
                     [&](std::size_t t) { apart.water[t] = waters.find(static_cast<std::uint32_t>(t)); });
  return apart;
}

}  // namespace

std::vector<ApartWater> apartWaters(const Grid& grid, const ItemLoop& loop) {
  using Counts = std::map<std::uint32_t, std::size_t>;
  const Apart apart = apartOf(grid, loop);
  Counts counts;
  for (const Counts& some : overStretches(loop, apart.water.size(), [&](std::size_t begin, std::size_t end) {
         Counts of_stretch;
         for (auto t = static_cast<std::uint32_t>(begin); t < end; ++t)
           if (apart.isApart(t)) ++of_stretch[apart.water[t]];
         return of_stretch;
       }))
    for (const auto& [first, count] : some) counts[first] += count;
  std::vector<ApartWater> found;
  for (const auto& [first, count] : counts) found.push_back({first, count});
  return found;
}

bool isOneWater(const Grid& grid, const ItemLoop& loop) {
  if (grid.triangles.empty()) return true;
  // Tests connections through nodes. They are connections through edges too unless a node alone connects two parts:
  // more than two boundary edges would end in it.
  std::vector<std::uint8_t> ends;
  reserveOn(loop, ends, grid.nodes.size());
  ends.resize(grid.nodes.size(), 0);
  bool pinched = false;  // threads set it
  constexpr std::size_t kWorthAStretch = 16;
  const auto countEnds = [&](std::size_t first, std::size_t last) {
    for (const Boundary& boundary : std::span(grid.boundaries).subspan(first, last - first)) {
      if (boundary.nodes.empty()) continue;
      const std::size_t edges = boundary.closed ? boundary.nodes.size() : boundary.nodes.size() - 1;
      for (std::size_t i = 0; i < edges && !__atomic_load_n(&pinched, __ATOMIC_RELAXED); ++i)
        for (const std::uint32_t node : {boundary.nodes[i], boundary.nodes[(i + 1) % boundary.nodes.size()]})
          if (__atomic_add_fetch(&ends[node], 1, __ATOMIC_RELAXED) > 2)
            __atomic_store_n(&pinched, true, __ATOMIC_RELAXED);
    }
  };
  forStretches(loop, grid.boundaries.size(), countEnds, kWorthAStretch);
  if (pinched) return false;
  SharedUnionFind nodes(grid.nodes.size(), loop);
  forEachByStretches(loop, grid.triangles.size(), [&](std::size_t t) {
    const auto& [a, b, c] = grid.triangles[t];
    nodes.unite(a, b);
    nodes.unite(b, c);
  });
  const std::uint32_t water = nodes.find(grid.triangles[0][0]);
  return std::ranges::all_of(overStretches(loop, grid.triangles.size(),
                                           [&](std::size_t first, std::size_t last) -> std::uint8_t {
                                             for (std::size_t t = first; t < last; ++t)
                                               if (nodes.find(grid.triangles[t][0]) != water) return 0;
                                             return 1;
                                           }),
                             std::identity());
}

DroppedWaters dropApartWaters(Grid& grid, GrazedWaters grazed, const ItemLoop& loop) {
  constexpr double kLittle = 0.1;  // share of all water, or of the largest: less is hardly what the user means
  if (isOneWater(grid, loop)) return {};
  const Apart apart = apartOf(grid, loop);
  WaterAreas left_out, at_open;
  for (std::uint32_t t = 0; t < apart.water.size(); ++t)
    (apart.isApart(t) ? left_out : at_open)[apart.water[t]] += grid.area_m2[t];
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
  std::vector<bool> gone(apart.water.size());
  for (std::uint32_t t = 0; t < apart.water.size(); ++t) {
    gone[t] = left_out.contains(apart.water[t]);
    if (gone[t] && !grid.feature_of.empty()) dropped.area_of[grid.feature_of[t]] += grid.area_m2[t];
  }
  dropped.waters = left_out.size();
  dropped.area_m2 = sumOf(left_out);
  dropped.share = dropped.area_m2 / all;
  dropped.in_plane = grid.crs.isPlane();
  removeTriangles(grid, gone);
  removeUnusedNodes(grid);
  return dropped;
}

}  // namespace coastmesh
