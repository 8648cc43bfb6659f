#include "gis/model/fill_depths.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "gis/geometry/neighbours.hpp"

namespace coastmesh {
namespace {

// Ascending; only of edges at nodes without a value.
Neighbours neighboursOfUnknown(const Grid& grid, const ItemLoop& loop) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  const auto isUnknown = [&](std::uint32_t node) { return std::isnan(grid.z[node]); };
  std::vector<Edge> edges = joined(overStretches(loop, grid.triangles.size(), [&](std::size_t first, std::size_t last) {
    std::vector<Edge> some;
    for (std::size_t t = first; t < last; ++t) {
      const auto& [a, b, c] = grid.triangles[t];
      for (const auto& [from, to] : {Edge{a, b}, Edge{b, c}, Edge{c, a}})
        if (isUnknown(from) || isUnknown(to)) some.emplace_back(std::minmax(from, to));
    }
    return some;
  }));
  std::ranges::sort(edges);
  edges.erase(std::ranges::unique(edges).begin(), edges.end());
  return {grid.nodes.size(), [&](const auto& visit) {
            for (const auto& [a, b] : edges) visit(a, b);
          }};
}

// In metres or, in a plane, its units; near enough to tell which of two nodes is nearer.
double distance(const Grid& grid, std::uint32_t a, std::uint32_t b) {
  const Point &p = grid.nodes[a], &q = grid.nodes[b];
  if (!grid.crs.geographic) return std::hypot(p.x - q.x, p.y - q.y);
  const double scale = std::cos((p.y + q.y) / 2.0 * std::numbers::pi / 180.0);
  return std::hypot(std::remainder(p.x - q.x, 360.0) * scale, p.y - q.y);
}

}  // namespace

std::size_t fillFromNeighbours(Grid& grid, const ItemLoop& loop) {
  const Neighbours neighbours = neighboursOfUnknown(grid, loop);
  std::vector<std::uint32_t> ring;
  const auto isUnknown = [&](std::uint32_t node) { return std::isnan(grid.z[node]); };
  const auto addUnknownNeighbours = [&](std::uint32_t node, std::vector<bool>& waiting) {
    for (const std::uint32_t next : neighbours.of(node)) {
      if (!isUnknown(next) || waiting[next]) continue;
      waiting[next] = true;
      ring.push_back(next);
    }
  };
  std::vector<bool> waiting(grid.nodes.size(), false);
  for (std::uint32_t node = 0; node < grid.nodes.size(); ++node)
    if (!isUnknown(node)) addUnknownNeighbours(node, waiting);
  std::size_t filled = 0;
  std::vector<double> values;
  while (!ring.empty()) {  // a node enters once
    values.clear();
    for (const std::uint32_t node : ring) {
      double sum = 0.0;
      int known = 0;
      for (const std::uint32_t next : neighbours.of(node)) {
        if (isUnknown(next)) continue;
        sum += grid.z[next];
        ++known;
      }
      values.push_back(sum / known);
    }
    const std::vector<std::uint32_t> done = std::move(ring);
    ring.clear();
    for (std::size_t i = 0; i < done.size(); ++i) grid.z[done[i]] = values[i];
    for (const std::uint32_t node : done) addUnknownNeighbours(node, waiting);
    filled += done.size();
  }
  return filled;
}

std::size_t fillFromNearest(Grid& grid, const ItemLoop& loop) {
  const Neighbours neighbours = neighboursOfUnknown(grid, loop);
  using Entry = std::tuple<double, std::uint32_t, std::uint32_t>;  // distance, node, where its value comes from
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<bool> done(grid.nodes.size(), false);
  for (std::uint32_t node = 0; node < grid.nodes.size(); ++node) done[node] = !std::isnan(grid.z[node]);
  const auto addNeighbours = [&](std::uint32_t node, std::uint32_t source, double far) {
    for (const std::uint32_t next : neighbours.of(node))
      if (!done[next]) queue.emplace(far + distance(grid, node, next), next, source);
  };
  for (std::uint32_t node = 0; node < grid.nodes.size(); ++node)
    if (done[node]) addNeighbours(node, node, 0.0);
  std::size_t filled = 0;
  while (!queue.empty()) {  // an edge enters twice at most
    const auto [far, node, source] = queue.top();
    queue.pop();
    if (done[node]) continue;
    done[node] = true;
    grid.z[node] = grid.z[source];
    ++filled;
    addNeighbours(node, source, far);
  }
  return filled;
}

}  // namespace coastmesh
