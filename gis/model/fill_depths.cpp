#include "gis/model/fill_depths.hpp"

#include <cmath>
#include <numbers>
#include <queue>
#include <span>
#include <tuple>

#include "gis/geometry/neighbours.hpp"
#include "gis/grid/mesh_edges.hpp"

namespace coastmesh {
namespace {

// Ascending.
Neighbours neighboursIn(const Grid& grid) {
  const auto edges = uniqueEdges(grid.nodes.size(), grid.triangles);
  return {grid.nodes.size(), [&](const auto& visit) {
            for (const auto& [a, b] : edges) visit(a, b);
          }};
}

// In metres or, in a plane, its units; near enough to tell which of two nodes is nearer.
double distance(const Grid& grid, std::uint32_t a, std::uint32_t b) {
  const Point &p = grid.nodes[a], &q = grid.nodes[b];
  const double scale = grid.crs.geographic ? std::cos((p.y + q.y) / 2.0 * std::numbers::pi / 180.0) : 1.0;
  return std::hypot((p.x - q.x) * scale, p.y - q.y);
}

}  // namespace

std::size_t fillFromNeighbours(Grid& grid) {
  const Neighbours neighbours = neighboursIn(grid);
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

std::size_t fillFromNearest(Grid& grid) {
  const Neighbours neighbours = neighboursIn(grid);
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
