#include "gis/grid/boundary_chains.hpp"

#include <algorithm>

#include "gis/grid/linked_grid.hpp"
#include "gis/grid/loop_role.hpp"

namespace coastmesh {

std::vector<Boundary> findBoundaries(const TriMesh& mesh, const ItemLoop& loop) {
  constexpr std::size_t kWorthAStretch = 16;
  std::vector<std::vector<VertexId>> loops = boundaryLoops(mesh, loop);
  std::vector<Boundary> boundaries(loops.size());
  const auto make = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      boundaries[i] = {roleOfLoop(mesh.points, loops[i], Crs{}), true, std::move(loops[i])};
  };
  forStretches(loop, loops.size(), make, kWorthAStretch);
  return boundaries;
}

void findMissingBoundaries(Grid& grid) {
  if (!grid.boundaries.empty()) return;
  for (std::vector<std::uint32_t>& nodes : boundaryLoops(linkGrid(grid).mesh)) {
    const BoundaryRole role = roleOfLoop(grid.nodes, nodes, grid.crs);
    grid.boundaries.push_back({role, true, std::move(nodes)});
  }
}

std::vector<NodePair> edgesOf(const Boundary& boundary) {
  std::vector<NodePair> edges;
  const std::vector<std::uint32_t>& nodes = boundary.nodes;
  edges.reserve(nodes.size());
  for (std::size_t i = 1; i < nodes.size(); ++i) edges.push_back({nodes[i - 1], nodes[i]});
  if (boundary.closed && nodes.size() > 1) edges.push_back({nodes.back(), nodes.front()});
  return edges;
}

std::vector<std::vector<NodePair>> keepBoundaryEdges(std::span<const std::array<std::uint32_t, 3>> triangles,
                                                     std::vector<std::vector<NodePair>>& edge_groups) {
  struct Sides {
    NodePair edge;  // the lesser node first
    std::uint32_t along = 0;
    std::uint32_t against = 0;
  };
  std::vector<Sides> sides;
  std::uint32_t greatest = 0;
  for (const auto& group : edge_groups) {
    for (const auto& [a, b] : group) {
      sides.push_back({{std::min(a, b), std::max(a, b)}});
      greatest = std::max({greatest, a, b});
    }
  }
  std::vector<std::vector<NodePair>> inner(edge_groups.size());
  if (sides.empty()) return inner;
  std::ranges::sort(sides, {}, &Sides::edge);
  const auto repeated = std::ranges::unique(sides, {}, &Sides::edge);
  sides.erase(repeated.begin(), repeated.end());
  std::vector<bool> touched(std::size_t{greatest} + 1, false);
  for (const Sides& side : sides) touched[side.edge[0]] = touched[side.edge[1]] = true;
  const auto isTouched = [&](std::uint32_t v) { return v <= greatest && touched[v]; };
  const auto find = [&](std::uint32_t a, std::uint32_t b) {
    const NodePair key{std::min(a, b), std::max(a, b)};
    const auto at = std::ranges::lower_bound(sides, key, {}, &Sides::edge);
    return at != sides.end() && at->edge == key ? &*at : nullptr;
  };
  for (const auto& v : triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t a = v[i], b = v[next3(i)];
      if (!isTouched(a) || !isTouched(b)) continue;
      Sides* const side = find(a, b);
      if (side == nullptr) continue;
      if (a < b)
        ++side->along;
      else
        ++side->against;
    }
  }
  for (std::size_t g = 0; g < edge_groups.size(); ++g) {
    std::vector<NodePair>& group = edge_groups[g];
    std::erase_if(group, [&](const NodePair& edge) {
      const Sides* side = find(edge[0], edge[1]);
      if (side->along == 1 && side->against == 1) inner[g].push_back(edge);
      return side->along + side->against != 1;
    });
    for (NodePair& edge : group) {
      const Sides* side = find(edge[0], edge[1]);
      const bool along = edge[0] < edge[1];
      if (along != (side->along == 1)) std::swap(edge[0], edge[1]);
    }
  }
  return inner;
}

std::vector<Boundary> chainEdges(std::span<const NodePair> edges) {
  std::vector<std::uint32_t> by_start(edges.size());
  for (std::uint32_t i = 0; i < edges.size(); ++i) by_start[i] = i;
  const auto startOf = [&](std::uint32_t i) { return edges[i][0]; };
  std::ranges::stable_sort(by_start, {}, startOf);
  std::vector<std::uint32_t> ends;
  for (const NodePair& edge : edges) ends.push_back(edge[1]);
  std::ranges::sort(ends);

  std::vector<bool> used(edges.size(), false);
  const auto follower = [&](std::uint32_t i) {
    if (i + 1 < edges.size() && !used[i + 1] && edges[i + 1][0] == edges[i][1]) return i + 1;
    for (const std::uint32_t j : std::ranges::equal_range(by_start, edges[i][1], {}, startOf))
      if (!used[j]) return j;
    return kNone;
  };
  std::vector<Boundary> chains;
  const auto follow = [&](std::uint32_t first) {
    Boundary chain{BoundaryRole::Open, false, {}};
    std::uint32_t at = first;
    while (at != kNone) {
      used[at] = true;
      chain.nodes.push_back(edges[at][0]);
      const std::uint32_t end = edges[at][1];
      const std::uint32_t next = follower(at);
      const bool home = end == edges[first][0];
      if (next == kNone || (home && next != at + 1)) {
        chain.closed = home;
        if (!home) chain.nodes.push_back(end);
        break;
      }
      at = next;
    }
    chains.push_back(std::move(chain));
  };
  for (std::uint32_t i = 0; i < edges.size(); ++i)
    if (!used[i] && !std::ranges::binary_search(ends, edges[i][0])) follow(i);
  for (std::uint32_t i = 0; i < edges.size(); ++i)
    if (!used[i]) follow(i);
  return chains;
}

}  // namespace coastmesh
