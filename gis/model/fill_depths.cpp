#include "gis/model/fill_depths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "core/box_halves.hpp"
#include "core/metric.hpp"
#include "gis/geometry/membrane.hpp"
#include "gis/geometry/neighbours.hpp"
#include "gis/rounded_depth.hpp"

namespace coastmesh {
namespace {

// Neighbours of each node, ascending, along edges with an end of unknown z.
Neighbours neighboursOfUnknown(const Grid& grid, const std::vector<double>& values_at, const ItemLoop& loop) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  const auto isUnknown = [&](std::uint32_t node) { return std::isnan(values_at[node]); };
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

// In degrees of latitude, otherwise units of the CRS; exact enough to find the nearer of two nodes.
double distance(const Grid& grid, std::uint32_t a, std::uint32_t b) {
  const Point &p = grid.nodes[a], &q = grid.nodes[b];
  if (!grid.crs.geographic) return std::hypot(p.x - q.x, p.y - q.y);
  const double scale = std::cos((p.y + q.y) / 2.0 * std::numbers::pi / 180.0);
  return std::hypot(std::remainder(p.x - q.x, 360.0) * scale, p.y - q.y);
}

// Sets `nodes` to the means of their neighbours, all of which have a value.
void settleNodes(std::vector<double>& values_at, const Neighbours& neighbours, std::vector<std::uint32_t> nodes,
                 double (*rounded)(double), const ItemLoop& loop) {
  std::ranges::sort(nodes);
  std::vector<std::uint32_t> number(values_at.size(), kNone);
  for (std::size_t i = 0; i < nodes.size(); ++i) number[nodes[i]] = static_cast<std::uint32_t>(i);
  Membrane membrane;
  std::vector<double> values;
  for (const std::uint32_t node : nodes) {
    double fixed = 0.0;
    for (const std::uint32_t next : neighbours.of(node)) {
      if (number[next] != kNone) {
        membrane.neighbour.push_back(number[next]);
        continue;
      }
      fixed += values_at[next];
      membrane.low = std::min(membrane.low, values_at[next]);
      membrane.high = std::max(membrane.high, values_at[next]);
    }
    membrane.fixed.push_back(fixed);
    membrane.degree.push_back(static_cast<double>(neighbours.of(node).size()));
    membrane.begin.push_back(membrane.neighbour.size());
    values.push_back(values_at[node]);
  }
  membrane.weight.assign(membrane.neighbour.size(), 1.0);
  settle(membrane, values, loop);
  for (std::size_t i = 0; i < nodes.size(); ++i) values_at[nodes[i]] = rounded(values[i]);
}

}  // namespace

std::size_t fillFromNeighbours(const Grid& grid, std::vector<double>& values_at, double (*rounded)(double),
                               const ItemLoop& loop) {
  const Neighbours neighbours = neighboursOfUnknown(grid, values_at, loop);
  std::vector<std::uint32_t> ring, all;
  const auto isUnknown = [&](std::uint32_t node) { return std::isnan(values_at[node]); };
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
  // A first guess, from the edges of a gap inwards.
  std::vector<double> values;
  while (!ring.empty()) {  // a node enters once
    values.clear();
    for (const std::uint32_t node : ring) {
      double sum = 0.0;
      int known = 0;
      for (const std::uint32_t next : neighbours.of(node)) {
        if (isUnknown(next)) continue;
        sum += values_at[next];
        ++known;
      }
      values.push_back(sum / known);
    }
    const std::vector<std::uint32_t> done = std::move(ring);
    ring.clear();
    for (std::size_t i = 0; i < done.size(); ++i) values_at[done[i]] = values[i];
    for (const std::uint32_t node : done) addUnknownNeighbours(node, waiting);
    all.insert(all.end(), done.begin(), done.end());
  }
  const std::size_t filled = all.size();
  if (filled > 0) settleNodes(values_at, neighbours, std::move(all), rounded, loop);
  return filled;
}

std::size_t fillFromNearest(const Grid& grid, std::vector<double>& values_at, const ItemLoop& loop) {
  const Neighbours neighbours = neighboursOfUnknown(grid, values_at, loop);
  using Entry = std::tuple<double, std::uint32_t, std::uint32_t>;  // distance, node, the node with its value
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<bool> done(grid.nodes.size(), false);
  for (std::uint32_t node = 0; node < grid.nodes.size(); ++node) done[node] = !std::isnan(values_at[node]);
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
    values_at[node] = values_at[source];
    ++filled;
    addNeighbours(node, source, far);
  }
  return filled;
}

std::vector<std::uint32_t> fillWatersApart(const Grid& grid, std::vector<double>& values_at) {
  std::vector<std::uint32_t> known, unknown;
  for (std::uint32_t node = 0; node < grid.nodes.size(); ++node)
    (std::isnan(values_at[node]) ? unknown : known).push_back(node);
  if (known.empty()) return {};
  if (unknown.empty()) return unknown;
  std::vector<Bounds> places;
  for (const std::uint32_t node : known) places.push_back({grid.nodes[node], grid.nodes[node]});
  const BoxHalves tree(places);
  std::vector<double> values;
  for (const std::uint32_t node : unknown) {
    double nearest = std::numeric_limits<double>::infinity();
    std::uint32_t source = known.front();
    for (const double turn : {0.0, -360.0, 360.0}) {
      if (turn != 0.0 && !grid.crs.geographic) continue;
      const Point from{grid.nodes[node].x + turn, grid.nodes[node].y};
      const double scale = grid.crs.geographic ? std::cos(from.y * std::numbers::pi / 180.0) : 1.0;
      tree.visit(
          [&](const Bounds& box) {
            const double dx = scale * std::max({box.low.x - from.x, 0.0, from.x - box.high.x});
            return std::hypot(dx, std::max({box.low.y - from.y, 0.0, from.y - box.high.y})) <= nearest;
          },
          [&](std::uint32_t i) {
            const Point way = grid.nodes[known[i]] - from;
            const std::pair found{std::hypot(scale * way.x, way.y), known[i]};
            if (found < std::pair{nearest, source}) std::tie(nearest, source) = found;
          });
    }
    values.push_back(values_at[source]);
  }
  for (std::size_t i = 0; i < unknown.size(); ++i) values_at[unknown[i]] = values[i];
  return unknown;
}

std::size_t fillFromNeighbours(Grid& grid, const ItemLoop& loop) {
  return fillFromNeighbours(grid, grid.z, roundedDepth, loop);
}

std::size_t fillFromNearest(Grid& grid, const ItemLoop& loop) { return fillFromNearest(grid, grid.z, loop); }

std::vector<std::uint32_t> fillWatersApart(Grid& grid) { return fillWatersApart(grid, grid.z); }

}  // namespace coastmesh
