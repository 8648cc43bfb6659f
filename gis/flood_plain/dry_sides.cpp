#include "gis/flood_plain/dry_sides.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "gis/crs/geodesy.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid_edit.hpp"

namespace coastmesh {

namespace {

constexpr std::size_t kFewestBetween = 3, kFewestAtCoast = 2;  // dry nodes that close a boundary

// Edges of one loop that are open, in order; a whole loop begins anywhere.
struct OpenChain {
  std::vector<std::uint32_t> nodes;  // the first is repeated at the end of a whole loop
  bool is_loop = false;
};

template <typename IsOpen>
std::vector<OpenChain> openChains(const std::vector<std::uint32_t>& loop, const IsOpen& is_open) {
  const std::size_t n = loop.size();
  std::size_t start = 0;  // an edge behind one that is not open
  while (start < n && is_open(loop[(start + n - 1) % n], loop[start])) ++start;
  std::vector<OpenChain> chains;
  bool goes_on = false;
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint32_t from = loop[(start + k) % n], to = loop[(start + k + 1) % n];
    if (!is_open(from, to)) {
      goes_on = false;
      continue;
    }
    if (!std::exchange(goes_on, true)) chains.push_back({{from}, start == n});
    chains.back().nodes.push_back(to);
  }
  return chains;
}

// For each node of the chain, whether the edges at it are closed.
template <typename IsDryNode>
std::vector<bool> closedAt(const OpenChain& chain, const IsDryNode& isDryNode, bool to_the_coast) {
  std::vector<std::uint32_t> nodes = chain.nodes;
  std::vector<bool> closed(nodes.size(), false);
  const auto isDry = [&](std::size_t i) { return isDryNode(nodes[i]); };
  if (chain.is_loop) {  // dry stretches of a loop may pass its ends: found by going round twice
    nodes.insert(nodes.end(), chain.nodes.begin() + 1, chain.nodes.end());
  }
  for (std::size_t first = 0, last = 0; first < nodes.size(); first = last + 1) {
    for (last = first; last < nodes.size() && isDry(last);) ++last;
    const bool at_end = !chain.is_loop && (first == 0 || last == nodes.size());
    const std::size_t fewest = !at_end ? kFewestBetween : to_the_coast ? 1 : kFewestAtCoast;
    if (last - first < fewest) continue;
    for (std::size_t i = first; i < last; ++i) closed[i % (chain.nodes.size() - (chain.is_loop ? 1 : 0))] = true;
  }
  if (chain.is_loop) closed.back() = closed.front();
  return closed;
}

// The edges of triangles on land, in the order of their corners.
std::vector<NodePair> edgesOnLand(const Grid& grid, const LandFlags& land) {
  std::vector<NodePair> edges;
  for (std::size_t t = 0; t < land.triangles.size(); ++t) {
    if (land.triangles[t] == 0) continue;
    const auto& [a, b, c] = grid.triangles[t];
    edges.insert(edges.end(), {NodePair{a, b}, NodePair{b, c}, NodePair{c, a}});
  }
  std::ranges::sort(edges);
  return edges;
}

}  // namespace

DrySides closeDrySides(Grid& grid, bool to_the_coast, const LandFlags& land, const ItemLoop& loop) {
  const auto isOpen = [](const Boundary& boundary) { return boundary.role == BoundaryRole::Open; };
  if (grid.z.empty() || std::ranges::none_of(grid.boundaries, isOpen)) return {};
  const std::vector<std::vector<std::uint32_t>> loops = boundaryLoops(grid, loop);
  const EdgeKinds before(grid);
  const std::vector<NodePair> on_land = edgesOnLand(grid, land);
  const auto isDry = [&](std::uint32_t node) { return grid.z[node] >= 0.0 || land.isLandNode(node); };
  std::vector<NodePair> closed;
  std::vector<std::vector<Point>> lines;
  const auto close = [&](std::uint32_t from, std::uint32_t to) {
    closed.push_back({from, to});
    lines.push_back({grid.nodes[from], grid.nodes[to]});
  };
  for (const std::vector<std::uint32_t>& nodes : loops) {
    const auto isOpenEdge = [&](std::uint32_t from, std::uint32_t to) {
      return before.isOpen(from, to) && !std::ranges::binary_search(on_land, NodePair{from, to});
    };
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::uint32_t from = nodes[i], to = nodes[(i + 1) % nodes.size()];
      if (before.isOpen(from, to) && !isOpenEdge(from, to)) close(from, to);
    }
    for (const OpenChain& chain : openChains(nodes, isOpenEdge)) {
      const std::vector<bool> at = closedAt(chain, isDry, to_the_coast);
      for (std::size_t i = 0; i + 1 < chain.nodes.size(); ++i) {
        if (at[i] || at[i + 1]) close(chain.nodes[i], chain.nodes[i + 1]);
      }
    }
  }
  DrySides dry;
  dry.edges = closed.size();
  if (closed.empty()) return dry;
  dry.place = meanPlace(grid.crs, lines.front());
  for (const double length : chainLengths(lines, grid.crs)) dry.length_m += length;
  std::ranges::sort(closed);
  grid.boundaries = cutLoops(grid, loops, [&](std::uint32_t from, std::uint32_t to) {
    return std::ranges::binary_search(closed, NodePair{from, to}) ? BoundaryKind{} : before.forCutting(from, to);
  });
  return dry;
}

}  // namespace coastmesh
