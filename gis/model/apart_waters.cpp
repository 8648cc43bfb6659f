#include "gis/model/apart_waters.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "gis/geometry/union_find.hpp"

namespace coastmesh {

std::vector<ApartWater> apartWaters(const Grid& grid) {
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
  std::map<std::uint32_t, std::size_t> apart;
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t)
    if (!reached[waters.find(t)]) ++apart[waters.find(t)];
  std::vector<ApartWater> found;
  for (const auto& [first, count] : apart) found.push_back({first, count});
  return found;
}

}  // namespace coastmesh
