#include "gis/model/fill_depths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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

// Values at nodes, each the mean of its neighbours', by conjugate gradients from what is there. It takes about as many
// steps as a gap is wide, in edges.
class MeanOfNeighbours {
 public:
  // `nodes` are to be changed, and all of their neighbours have a value.
  MeanOfNeighbours(Grid& grid, const Neighbours& neighbours, std::vector<std::uint32_t> nodes, const ItemLoop& loop)
      : grid_(grid), nodes_(std::move(nodes)), loop_(loop) {
    std::ranges::sort(nodes_);
    std::vector<std::uint32_t> number(grid.nodes.size(), kNone);
    for (std::size_t i = 0; i < nodes_.size(); ++i) number[nodes_[i]] = static_cast<std::uint32_t>(i);
    begin_.push_back(0);
    for (const std::uint32_t node : nodes_) {
      double fixed = 0.0;
      for (const std::uint32_t next : neighbours.of(node)) {
        if (number[next] != kNone) {
          inner_.push_back(number[next]);
          continue;
        }
        fixed += grid.z[next];
        low_ = std::min(low_, grid.z[next]);
        high_ = std::max(high_, grid.z[next]);
      }
      fixed_.push_back(fixed);
      degree_.push_back(static_cast<double>(neighbours.of(node).size()));
      begin_.push_back(inner_.size());
      value_.push_back(grid.z[node]);
    }
  }

  void run() {
    constexpr int kMostSteps = 1000;
    constexpr double kClose = 1e-5, kRounding = 1e-12;  // to the mean, of the range of the values around, and of them
    const double close = kClose * (high_ - low_) + kRounding * std::max(std::abs(low_), std::abs(high_));
    const std::size_t count = nodes_.size();
    std::vector<double> rest(count), way(count), image(count);
    apply(value_, image);
    forEachByStretches(loop_, count, [&](std::size_t i) {
      rest[i] = fixed_[i] - image[i];
      way[i] = rest[i] / degree_[i];
    });
    double size = sumOf([&](std::size_t i) { return rest[i] * rest[i] / degree_[i]; });
    for (int step = 0; step < kMostSteps && farthest(rest) > close; ++step) {
      apply(way, image);
      const double length = size / sumOf([&](std::size_t i) { return way[i] * image[i]; });
      forEachByStretches(loop_, count, [&](std::size_t i) {
        value_[i] += length * way[i];
        rest[i] -= length * image[i];
      });
      const double left = sumOf([&](std::size_t i) { return rest[i] * rest[i] / degree_[i]; });
      forEachByStretches(loop_, count, [&](std::size_t i) { way[i] = rest[i] / degree_[i] + left / size * way[i]; });
      size = left;
    }
    for (std::size_t i = 0; i < count; ++i) grid_.z[nodes_[i]] = std::clamp(value_[i], low_, high_);
  }

 private:
  void apply(const std::vector<double>& values, std::vector<double>& to) const {
    forEachByStretches(loop_, values.size(), [&](std::size_t i) {
      double sum = degree_[i] * values[i];
      for (std::size_t k = begin_[i]; k < begin_[i + 1]; ++k) sum -= values[inner_[k]];
      to[i] = sum;
    });
  }
  // The same for any number of threads.
  template <typename Term>
  double sumOf(const Term& term) const {
    double all = 0.0;
    for (const double part : overStretches(loop_, nodes_.size(), [&](std::size_t first, std::size_t last) {
           double sum = 0.0;
           for (std::size_t i = first; i < last; ++i) sum += term(i);
           return sum;
         }))
      all += part;
    return all;
  }
  double farthest(const std::vector<double>& rest) const {
    double most = 0.0;
    for (std::size_t i = 0; i < rest.size(); ++i) most = std::max(most, std::abs(rest[i]) / degree_[i]);
    return most;
  }

  Grid& grid_;
  std::vector<std::uint32_t> nodes_;
  const ItemLoop& loop_;
  // For each of the nodes: its neighbours among them, from begin_[i] on, by their places in `nodes_`; the sum of the
  // values of the others; the number of all; its value.
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> inner_;
  std::vector<double> fixed_, degree_, value_;
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

}  // namespace

std::size_t fillFromNeighbours(Grid& grid, const ItemLoop& loop) {
  const Neighbours neighbours = neighboursOfUnknown(grid, loop);
  std::vector<std::uint32_t> ring, all;
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
  // From the edges of a gap inwards: a first guess.
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
    all.insert(all.end(), done.begin(), done.end());
  }
  const std::size_t filled = all.size();
  if (filled > 0) MeanOfNeighbours(grid, neighbours, std::move(all), loop).run();
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
