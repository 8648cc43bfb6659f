#include "gis/shore/shore_divide.hpp"

#include <algorithm>
#include <cmath>

#include "core/metric.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

namespace {

// Shares of the size wanted.
constexpr double kLong = 2.0;
constexpr double kNear = 0.5;        // the least distance that mending leaves between shores
constexpr double kShortest = 0.5;    // of pieces
constexpr double kMostPieces = 1e4;  // per segment

bool isLongShore(const ShoreChains& c, VertexId v, double size) {
  return c.alive[v] && c.next[v] != kNone && c.leaving[v].tag != kOpenTag &&
         squaredDistance(c.at[v], c.at[c.next[v]]) > kLong * kLong * size * size;
}

class Divider {
 public:
  explicit Divider(ShoreChains& chains) : c_(chains) {
    std::vector<char> is_loose(c_.at.size(), 0);
    for (VertexId v = 0; v < is_loose.size(); ++v)
      is_loose[v] = c_.alive[v] && c_.next[v] == kNone && c_.prev[v] == kNone;
    for (const Segment& s : c_.lines) {
      given_.emplace_back(s.a, s.b);
      is_loose[s.a] = is_loose[s.b] = 0;
    }
    for (VertexId v = 0; v < is_loose.size(); ++v)
      if (is_loose[v]) given_.emplace_back(v, v);
    std::vector<Box> boxes;
    for (const auto& [a, b] : given_) boxes.push_back(Box::of(c_.at[a], c_.at[b]));
    if (!boxes.empty()) tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
  }

  void run() {
    if (given_.empty()) return;
    const auto count = static_cast<VertexId>(c_.at.size());
    for (VertexId v = 0; v < count; ++v)
      if (isLongShore(c_, v, c_.size[v])) divide(v);
  }

 private:
  void divide(VertexId v) {
    const VertexId end = c_.next[v];
    const Point a = c_.at[v], b = c_.at[end];
    const double size = std::max(c_.size[v], c_.size[end]), length = distance(a, b);
    std::vector<double> first, others;  // lengths from a
    const double step = std::max(size, length / kMostPieces);
    tree_.visit(Box::of(a, b).grownBy(kNear * size), [&](std::uint32_t item) {
      const auto& [p, q] = given_[item];
      if (p == v || q == v || p == end || q == end) return;
      Point from{dot(c_.at[p] - a, b - a) / length, cross(b - a, c_.at[p] - a) / length};
      Point to{dot(c_.at[q] - a, b - a) / length, cross(b - a, c_.at[q] - a) / length};
      if (!clip(from, to, {0.0, 0.0}, {length, kNear * size})) return;
      const auto [low, high] = std::minmax({from.x, to.x});
      first.insert(first.end(), {low, high});
      others.insert(others.end(), {low - size, high + size});
      for (double x = low + step; x < high; x += step) others.push_back(x);
    });
    if (first.empty()) return;
    // The ends of the stretches beside lines take precedence.
    std::vector<double> cuts{0.0, length};
    for (std::vector<double>* places : {&first, &others}) {
      std::ranges::sort(*places);
      for (const double x : *places) {
        const auto next = std::ranges::lower_bound(cuts, x);
        if (next == cuts.begin() || next == cuts.end()) continue;
        if (x - *(next - 1) >= kShortest * size && *next - x >= kShortest * size) cuts.insert(next, x);
      }
    }
    VertexId last = v;
    for (std::size_t i = 1; i + 1 < cuts.size(); ++i) last = cutAfter(c_, last, a + cuts[i] / length * (b - a), size);
  }

  // Clips a segment to the rectangle; false if nothing is left.
  static bool clip(Point& p, Point& q, const Point& low, const Point& high) {
    const Point along = q - p, from = p;
    double first = 0.0, last = 1.0;
    const auto cut = [&](double at, double by, double least, double most) {
      if (by == 0.0) {
        if (at < least || at > most) first = 2.0;
        return;
      }
      const double one = (least - at) / by, other = (most - at) / by;
      first = std::max(first, std::min(one, other));
      last = std::min(last, std::max(one, other));
    };
    cut(from.x, along.x, low.x, high.x);
    cut(from.y, along.y, low.y, high.y);
    if (first > last) return false;
    p = from + first * along;
    q = from + last * along;
    return true;
  }

  ShoreChains& c_;
  std::vector<std::pair<VertexId, VertexId>> given_;  // ends of line segments; a point twice
  BoxTree tree_;
};

}  // namespace

void divideBeside(ShoreChains& chains, VertexId v) {
  const double size = chains.size[v];
  const VertexId p = chains.prev[v], q = chains.next[v];
  const auto cut = [&](VertexId from, VertexId to, VertexId after) {
    const Point &a = chains.at[from], &b = chains.at[to];
    const Point x = a + size / distance(a, b) * (b - a);
    cutAfter(chains, after, x, size);
  };
  if (q != kNone && isLongShore(chains, v, size)) cut(v, q, v);
  if (p != kNone && isLongShore(chains, p, size)) cut(v, p, p);
}

void divideAtLines(ShoreChains& chains) { Divider(chains).run(); }

}  // namespace coastmesh
