#include "gis/shore_mend.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "gis/box_tree.hpp"

namespace coastmesh {

namespace {

// Lengths are shares of the size wanted.
constexpr double kShort = 0.5;
constexpr double kNarrow = 0.5;
constexpr double kSmallAngle = toRadians(50.0);
constexpr double kMoved = 0.5;
constexpr double kClosed = 1.2;  // how far a sharp corner may end from where it was
constexpr double kBetter = 0.03;
constexpr int kRounds = 12;
constexpr int kDirections = 8;
constexpr double kSteps[] = {0.1, 0.25, 0.45};

bool crosses(const Point& a, const Point& b, const Point& c, const Point& d) {
  return orient2d(a, b, c) * orient2d(a, b, d) <= 0 && orient2d(c, d, a) * orient2d(c, d, b) <= 0 &&
         Box::of(a, b).meets(Box::of(c, d));
}

bool holds(const Point& a, const Point& b, const Point& c, const Point& x) {
  const int turn = orient2d(a, b, c);
  if (turn == 0)
    return orient2d(a, b, x) == 0 && (Box::of(a, b).meets(Box::of(x, x)) || Box::of(b, c).meets(Box::of(x, x)));
  return orient2d(a, b, x) * turn >= 0 && orient2d(b, c, x) * turn >= 0 && orient2d(c, a, x) * turn >= 0;
}

class Mender {
 public:
  Mender(ShoreChains& chains, const std::function<void(VertexId, RegionId)>& gone,
         const std::function<void(VertexId, RegionId)>& moved)
      : c_(chains), gone_(gone), moved_(moved), from_(chains.at) {}

  void run() {
    for (int round = 0; round < kRounds && mendOnce(); ++round) {
    }
  }

 private:
  // A vertex's piece of shore as it would be: p, x, q; or p, q where x is none.
  struct Change {
    std::optional<Point> x;
    double quality = 0.0;
  };

  bool mendOnce() {
    buildTrees();
    locked_.assign(c_.at.size(), 0);
    std::vector<std::pair<double, VertexId>> bad;
    for (VertexId v = 0; v < c_.at.size(); ++v) {
      if (c_.next[v] == kNone || c_.prev[v] == kNone) continue;
      gather(v);
      const double quality = qualityOf(v, c_.at[v]);
      if (quality < 1.0) bad.emplace_back(quality, v);
    }
    std::ranges::sort(bad);
    bool any = false;
    for (const auto& [quality, v] : bad) {
      if (c_.stays[v] || c_.open[v] || c_.next[v] == kNone) continue;
      gather(v);
      if (std::ranges::any_of(points_, [&](VertexId w) { return locked_[w] != 0; })) continue;
      if (!mend(v, quality)) continue;
      for (const VertexId w : points_) locked_[w] = 1;
      any = true;
    }
    return any;
  }

  bool mend(VertexId v, double quality) {
    const double size = c_.size[v];
    Change best{std::nullopt, quality + kBetter};
    bool found = false;
    if (canTakeOut(c_, v) && holdsNoOther(v)) {
      const double after = qualityOf(v, std::nullopt);
      if (after >= best.quality) best = {std::nullopt, after}, found = true;
    }
    for (const double step : kSteps) {
      for (int i = 0; i < kDirections; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kDirections;
        const Point x = c_.at[v] + step * size * Point{std::cos(angle), std::sin(angle)};
        if (squaredDistance(x, from_[v]) > kMoved * kMoved * size * size) continue;
        const double after = qualityOf(v, x);
        if (after > best.quality + (found ? kBetter : 0.0) && canMove(v, x)) best = {x, after}, found = true;
      }
    }
    if (!found) return false;
    if (best.x) {
      if (c_.source[v] != kNone) moved_(v, c_.leaving[v].left);
      c_.at[v] = *best.x;
      c_.source[v] = kNone;
    } else {
      gone_(v, c_.leaving[v].left);
      takeOut(c_, v);
    }
    return true;
  }

  void buildTrees() {
    std::vector<Box> points(c_.at.size()), segments;
    ends_.clear();
    for (VertexId v = 0; v < c_.at.size(); ++v) {
      if (!c_.alive[v]) continue;
      points[v].add(c_.at[v]);
      if (c_.next[v] != kNone) ends_.emplace_back(v, c_.next[v]);
    }
    for (const Segment& s : c_.lines) ends_.emplace_back(s.a, s.b);
    for (const auto& [a, b] : ends_) segments.push_back(Box::of(c_.at[a], c_.at[b]));
    point_tree_ = BoxTree(points, BoxTree::Order::Hilbert);
    segment_tree_ = BoxTree(segments, BoxTree::Order::Hilbert);
  }

  // What is near enough to v's piece of shore to matter, wherever v goes.
  void gather(VertexId v) {
    points_.clear();
    segments_.clear();
    const VertexId p = c_.prev[v], q = c_.next[v];
    Box box = Box::of(c_.at[p], c_.at[q]);
    box.add(c_.at[v]);
    box = box.grownBy((kNarrow + kSteps[2]) * c_.size[v]);
    point_tree_.visit(box, [&](std::uint32_t w) { points_.push_back(w); });
    segment_tree_.visit(box, [&](std::uint32_t s) {
      segments_.push_back(ends_[s]);
      for (const VertexId w : {ends_[s].first, ends_[s].second}) points_.push_back(w);
    });
    for (const VertexId w : {c_.prev[p], c_.next[q]})
      if (w != kNone) points_.push_back(w);
    std::ranges::sort(points_);
    const auto repeated = std::ranges::unique(points_);
    points_.erase(repeated.begin(), repeated.end());
  }

  // The worst of what v's piece of shore takes part in, 1 where all is as wanted, with v at x or taken out.
  double qualityOf(VertexId v, const std::optional<Point>& x) const {
    const VertexId p = c_.prev[v], q = c_.next[v], pp = c_.prev[p], qq = c_.next[q];
    const Point &a = c_.at[p], &b = c_.at[q];
    double quality = 1.0;
    const auto take = [&](double share) { quality = std::min(quality, share); };
    const auto takeLength = [&](const Point& from, const Point& to) {
      take(distance(from, to) / (kShort * c_.size[v]));
    };
    const auto takeAngle = [&](const Point& from, const Point& at, const Point& to) {
      take(waterAngle(from, at, to) / kSmallAngle);
    };
    if (x) {
      takeLength(a, *x), takeLength(*x, b);
      takeAngle(a, *x, b);
      if (pp != kNone) takeAngle(c_.at[pp], a, *x);
      if (qq != kNone) takeAngle(*x, b, c_.at[qq]);
    } else {
      takeLength(a, b);
      if (pp != kNone) takeAngle(c_.at[pp], a, b);
      if (qq != kNone) takeAngle(a, b, c_.at[qq]);
    }
    const double least = kNarrow * c_.size[v];
    for (const VertexId w : points_) {
      if (w == v || w == p || w == q || !c_.alive[w]) continue;
      const Point& y = c_.at[w];
      if (x) {
        if (w != pp) take(apart(y, a, *x) / least);
        if (w != qq) take(apart(y, *x, b) / least);
      } else if (w != pp && w != qq) {
        take(apart(y, a, b) / least);
      }
    }
    if (!x) return quality;
    for (const auto& [s, e] : segments_) {
      if (s == v || e == v || s == p || e == p || s == q || e == q || !c_.alive[s] || !c_.alive[e]) continue;
      // With the segment's own water to its left, or a line with water on both sides.
      take(std::sqrt(squaredDistanceToSegment(*x, c_.at[s], c_.at[e])) *
           (c_.next[s] == e && orient2d(c_.at[s], c_.at[e], *x) <= 0 ? 1e9 : 1.0) / least);
    }
    return quality;
  }

  // The distance of y from ab, with the water to its left; large where y lies on the land's side.
  static double apart(const Point& y, const Point& a, const Point& b) {
    return orient2d(a, b, y) <= 0 ? 1e300 : std::sqrt(squaredDistanceToSegment(y, a, b));
  }

  bool holdsNoOther(VertexId v) const {
    const VertexId p = c_.prev[v], q = c_.next[v];
    const Point &a = c_.at[p], &x = c_.at[v], &b = c_.at[q];
    const double most = (waterAngle(a, x, b) < kSmallAngle ? kClosed : kMoved) * c_.size[v];
    if (squaredDistanceToSegment(from_[v], a, b) > most * most) return false;
    return std::ranges::none_of(
        points_, [&](VertexId w) { return w != v && w != p && w != q && c_.alive[w] && holds(a, x, b, c_.at[w]); });
  }

  bool canMove(VertexId v, const Point& x) const {
    const VertexId p = c_.prev[v], q = c_.next[v];
    const Point& from = c_.at[v];
    for (const VertexId w : points_) {
      if (w == v || !c_.alive[w]) continue;
      if (w != p && w != q && (holds(c_.at[p], from, x, c_.at[w]) || holds(from, c_.at[q], x, c_.at[w]))) return false;
    }
    if (orient2d(c_.at[p], x, c_.at[q]) == 0 || holds(c_.at[p], from, x, c_.at[q]) ||
        holds(from, c_.at[q], x, c_.at[p]))
      return false;
    return std::ranges::none_of(segments_, [&](const auto& s) {
      return s.first != v && s.second != v && c_.alive[s.first] && c_.alive[s.second] &&
             crosses(from, x, c_.at[s.first], c_.at[s.second]);
    });
  }

  ShoreChains& c_;
  const std::function<void(VertexId, RegionId)>& gone_;
  const std::function<void(VertexId, RegionId)>& moved_;
  std::vector<Point> from_;
  std::vector<std::pair<VertexId, VertexId>> ends_;
  BoxTree point_tree_, segment_tree_;
  std::vector<char> locked_;
  std::vector<VertexId> points_;                         // near the vertex looked at
  std::vector<std::pair<VertexId, VertexId>> segments_;  // the same
};

}  // namespace

void mendShores(ShoreChains& chains, const std::function<void(VertexId, RegionId)>& gone,
                const std::function<void(VertexId, RegionId)>& moved) {
  Mender(chains, gone, moved).run();
}

}  // namespace coastmesh
