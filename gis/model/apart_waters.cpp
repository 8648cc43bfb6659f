#include "gis/model/apart_waters.hpp"

#include <algorithm>
#include <array>
#include <map>
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

Apart apartOf(const Grid& grid) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<std::pair<Edge, std::uint32_t>> edges;
  edges.reserve(3 * grid.triangles.size());
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) {
    const auto& v = grid.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) edges.push_back({std::minmax(v[i], v[(i + 1) % 3]), t});
  }
  std::ranges::sort(edges);
  UnionFind waters(grid.triangles.size());
  for (std::size_t i = 0; i + 1 < edges.size(); ++i)
    if (edges[i].first == edges[i + 1].first) waters.unite(edges[i].second, edges[i + 1].second);

  std::vector<bool> reached(grid.triangles.size(), false);  // of a water's first triangle
  bool any = false;
  for (const Boundary& boundary : grid.boundaries) {
    if (boundary.role != BoundaryRole::Open && boundary.role != BoundaryRole::River) continue;
    for (std::size_t i = 0; i + 1 < boundary.nodes.size(); ++i) {
      const Edge edge = std::minmax(boundary.nodes[i], boundary.nodes[i + 1]);
      const auto found = std::ranges::lower_bound(edges, std::pair(edge, 0u));
      if (found == edges.end() || found->first != edge) continue;
      reached[waters.find(found->second)] = true;
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

std::vector<ApartWater> apartWaters(const Grid& grid) {
  const Apart apart = apartOf(grid);
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

DroppedWaters dropApartWaters(Grid& grid) {
  constexpr double kLittle = 0.1;  // share of all water: less than this is hardly what the user means
  if (isOneWater(grid)) return {};
  const Apart apart = apartOf(grid);
  DroppedWaters dropped;
  double all = 0.0;
  std::map<std::uint32_t, double> areas;
  for (std::uint32_t t = 0; t < apart.water.size(); ++t) {
    all += grid.area_m2[t];
    if (apart.is_apart[t]) areas[apart.water[t]] += grid.area_m2[t];
  }
  if (areas.empty()) return dropped;
  double largest = 0.0;
  for (const auto& [first, area] : areas) {
    dropped.area_m2 += area;
    if (area <= largest) continue;
    largest = area;
    dropped.place = middleOf(grid, first);
  }
  dropped.share = dropped.area_m2 / all;
  if (dropped.share > 1.0 - kLittle) return {};
  for (std::uint32_t t = 0; t < apart.water.size() && !grid.feature_of.empty(); ++t)
    if (apart.is_apart[t]) dropped.area_of[grid.feature_of[t]] += grid.area_m2[t];
  dropped.waters = areas.size();
  dropped.in_plane = grid.crs.isPlane();
  removeTriangles(grid, apart.is_apart);
  removeUnusedNodes(grid);
  return dropped;
}

}  // namespace coastmesh
