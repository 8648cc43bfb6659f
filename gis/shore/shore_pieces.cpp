#include "gis/shore/shore_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/metric.hpp"
#include "core/predicates.hpp"

namespace coastmesh {

namespace {

// Lengths are shares of the size wanted.
constexpr double kShort = 0.5;
constexpr double kNarrow = 0.5;
constexpr double kWide = 1.4;  // of the least length: narrower water hardly has room for triangles with such edges
// Two corners of the water with angles in this range, and this near to each other, make a square end: triangles without
// obtuse angles need a vertex in its middle, and so much shorter edges.
constexpr double kSquareLow = toRadians(62.0), kSquareHigh = toRadians(140.0), kSquareSide = 1.5;
constexpr double kClearlySquare = toRadians(10.0);  // this far inside the range, the quality is that of a square end:
constexpr double kSquareEnd = 0.7;
constexpr double kLittleMore = 1.0 + 1e-9;  // rounding
const double kSharp = std::pow(std::cos(kSmallShoreAngle), 2) * (1.0 - 1e-9);

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

// True if ab may meet the box, which its own box does: false only if all corners lie on one side of it.
bool mayMeet(const Point& a, const Point& b, const Box& box) {
  const Point middle{0.5 * (box.xmin + box.xmax), 0.5 * (box.ymin + box.ymax)}, along = b - a;
  const double reach = 0.5 * ((box.xmax - box.xmin) * std::abs(along.y) + (box.ymax - box.ymin) * std::abs(along.x));
  return std::abs(cross(along, middle - a)) <= kLittleMore * reach;
}

// The distance of y from ab, with the water to its left; 1e300 if y is on the land's side.
double apartInWater(const Point& y, const Point& a, const Point& b) {
  return orient2d(a, b, y) <= 0 ? 1e300 : std::sqrt(squaredDistanceToSegment(y, a, b));
}

}  // namespace

double ShorePieces::shortestAt(VertexId v) const {
  return c_.least.empty() ? kShort * c_.size[v] : std::max(kShort * c_.size[v], c_.least[v]);
}

double ShorePieces::narrowestAt(VertexId v) const {
  return c_.least.empty() ? kNarrow * c_.size[v] : std::max(kNarrow * c_.size[v], kWide * c_.least[v]);
}

void ShorePieces::buildTrees(const ItemLoop& loop) {
  std::vector<char> is_loose(c_.at.size(), 0);
  const auto trees = std::make_shared<Trees>();
  trees->ends.reserve(c_.at.size() + c_.lines.size());
  for (VertexId v = 0; v < c_.at.size(); ++v) {
    if (!c_.alive[v]) continue;
    is_loose[v] = c_.next[v] == kNone && c_.prev[v] == kNone;
    if (c_.next[v] != kNone) trees->ends.emplace_back(v, c_.next[v]);
  }
  trees->at_lines = trees->ends.size();
  for (const Segment& s : c_.lines) {
    trees->ends.emplace_back(s.a, s.b);
    is_loose[s.a] = is_loose[s.b] = 0;
  }
  std::vector<Box> points, segments(trees->ends.size());
  for (VertexId v = 0; v < is_loose.size(); ++v) {
    if (is_loose[v] == 0) continue;
    trees->loose.push_back(v);
    points.push_back(Box::of(c_.at[v], c_.at[v]));
  }
  forEachByStretches(loop, segments.size(), [&](std::size_t s) {
    const auto& [a, b] = trees->ends[s];
    segments[s] = Box::of(c_.at[a], c_.at[b]);
  });
  trees->points = points.empty() ? BoxTree() : BoxTree(points, BoxTree::Order::Hilbert, loop);
  trees->segments = BoxTree(segments, BoxTree::Order::Hilbert, loop);
  trees_ = trees;
}

void ShorePieces::renewTrees(const ItemLoop& loop) {
  trees_->segments.refit(loop, [&](std::uint32_t s) {
    auto& [a, b] = trees_->ends[s];
    if (s < trees_->at_lines) b = c_.next[a];
    return b == kNone ? Box{} : Box::of(c_.at[a], c_.at[b]);
  });
}

void ShorePieces::gather(VertexId v, double reach) {
  points_.clear();
  segments_.clear();
  const VertexId p = c_.prev[v], q = c_.next[v];
  Box box = Box::of(c_.at[p], c_.at[q]);
  box.add(c_.at[v]);
  box = box.grownBy(narrowestAt(v) + reach * c_.size[v]);
  trees_->points.visit(box, [&](std::uint32_t i) { points_.push_back(trees_->loose[i]); });
  trees_->segments.visit(box, [&](std::uint32_t s) {
    const auto& [from, to] = trees_->ends[s];
    // The box of a long slanting segment holds much that is nowhere near it.
    if (!mayMeet(c_.at[from], c_.at[to], box)) return;
    segments_.emplace_back(from, to);
    points_.push_back(from);
    points_.push_back(to);
  });
  for (const VertexId w : {c_.prev[p], c_.next[q]})
    if (w != kNone) points_.push_back(w);
  std::ranges::sort(points_);
  const auto repeated = std::ranges::unique(points_);
  points_.erase(repeated.begin(), repeated.end());
}

double ShorePieces::qualityOf(VertexId v, const std::optional<Point>& x) const {
  const VertexId p = c_.prev[v], q = c_.next[v], pp = c_.prev[p], qq = c_.next[q];
  const Point &a = c_.at[p], &b = c_.at[q];
  double quality = 1.0;
  const auto take = [&](double share) { quality = std::min(quality, share); };
  const double shortest = shortestAt(v);
  const auto takeLength = [&](const Point& from, const Point& to) { take(distance(from, to) / shortest); };
  const auto takeAngle = [&](const Point& from, const Point& at, const Point& to) {
    take(waterAngle(from, at, to) / kSmallShoreAngle);
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
  take(qualityOfEnds(v, x));
  const double least = narrowestAt(v);
  for (const VertexId w : points_) {
    if (w == v || w == p || w == q || !c_.alive[w]) continue;
    const Point& y = c_.at[w];
    if (x) {
      if (w != pp) take(apartInWater(y, a, *x) / least);
      if (w != qq) take(apartInWater(y, *x, b) / least);
    } else if (w != pp && w != qq) {
      take(apartInWater(y, a, b) / least);
    }
  }
  if (!x) return quality;
  for (const auto& [s, e] : segments_) {
    if (s == v || e == v || s == p || e == p || s == q || e == q || !c_.alive[s] || !c_.alive[e]) continue;
    // Only on the segment's water side (left); a line has water on both.
    take(std::sqrt(squaredDistanceToSegment(*x, c_.at[s], c_.at[e])) *
         (c_.next[s] == e && orient2d(c_.at[s], c_.at[e], *x) <= 0 ? 1e9 : 1.0) / least);
  }
  return quality;
}

double ShorePieces::qualityOfEnds(VertexId v, const std::optional<Point>& x) const {
  if (!c_.no_square_ends) return 1.0;
  const VertexId p = c_.prev[v], q = c_.next[v], pp = c_.prev[p], qq = c_.next[q];
  std::array<Point, 5> way;
  std::size_t count = 0;
  if (pp != kNone) way[count++] = c_.at[pp];
  way[count++] = c_.at[p];
  if (x) way[count++] = *x;
  way[count++] = c_.at[q];
  if (qq != kNone) way[count++] = c_.at[qq];
  double most = 0.0;
  const auto squareness = [&](std::size_t i) {
    const double angle = waterAngle(way[i - 1], way[i], way[i + 1]);
    return std::clamp(std::min(angle - kSquareLow, kSquareHigh - angle) / kClearlySquare, 0.0, 1.0);
  };
  for (std::size_t i = 1; i + 2 < count; ++i)
    if (distance(way[i], way[i + 1]) < kSquareSide * c_.size[v])
      most = std::max(most, std::min(squareness(i), squareness(i + 1)));
  return 1.0 - (1.0 - kSquareEnd) * most;
}

bool ShorePieces::isFine(VertexId v) const {
  const VertexId p = c_.prev[v], q = c_.next[v], pp = c_.prev[p], qq = c_.next[q];
  const Point &a = c_.at[p], &x = c_.at[v], &b = c_.at[q];
  const double shortest = kLittleMore * shortestAt(v), least = kLittleMore * narrowestAt(v);
  if (std::min(squaredDistance(a, x), squaredDistance(x, b)) < shortest * shortest) return false;
  const auto isSharp = [&](const Point& from, const Point& at, const Point& to) {
    const Point in = from - at, out = to - at;
    const double along = dot(in, out);
    return along > 0.0 && along * along > kSharp * squaredLength(in) * squaredLength(out);
  };
  if (isSharp(a, x, b) || (pp != kNone && isSharp(c_.at[pp], a, x)) || (qq != kNone && isSharp(x, b, c_.at[qq])))
    return false;
  if (qualityOfEnds(v, x) < 1.0) return false;
  const Box first = Box::of(a, x).grownBy(least), second = Box::of(x, b).grownBy(least);
  const auto isOwn = [&](VertexId w) { return w == v || w == p || w == q; };
  // Across the water.
  const auto isNear = [&](const Point& y, const Box& box, const Point& from, const Point& to) {
    return box.meets(Box::of(y, y)) && squaredDistanceToSegment(y, from, to) < least * least &&
           orient2d(from, to, y) > 0;
  };
  const auto isAway = [&](VertexId w) {
    return w == kNone || isOwn(w) ||
           ((w == pp || !isNear(c_.at[w], first, a, x)) && (w == qq || !isNear(c_.at[w], second, x, b)));
  };
  if (!isAway(pp) || !isAway(qq)) return false;
  bool fine = true;
  const auto enter = [&](const Box& box, std::size_t, std::size_t) {
    return fine && (box.meets(first) || box.meets(second));
  };
  trees_->points.descend(enter, [&](std::uint32_t i) { fine = fine && isAway(trees_->loose[i]); });
  trees_->segments.descend(enter, [&](std::uint32_t i) {
    const auto& [s, e] = trees_->ends[i];
    if (isOwn(s) && isOwn(e)) return;
    fine = fine && isAway(s) && isAway(e);
    if (!fine || isOwn(s) || isOwn(e)) return;
    const double apart = squaredDistanceToSegment(x, c_.at[s], c_.at[e]);
    // A shore with its land towards x does not matter, unless x lies on it.
    const bool is_beyond = c_.next[s] == e && orient2d(c_.at[s], c_.at[e], x) < 0;
    fine = apart >= (is_beyond ? 1e-16 : 1.0) * least * least;
  });
  return fine;
}

bool ShorePieces::canMove(VertexId v, const Point& x, VertexId but) const {
  const VertexId p = c_.prev[v], q = c_.next[v];
  const Point& from = c_.at[v];
  for (const VertexId w : points_) {
    if (w == v || w == but || !c_.alive[w]) continue;
    if (w != p && w != q && (holds(c_.at[p], from, x, c_.at[w]) || holds(from, c_.at[q], x, c_.at[w]))) return false;
  }
  if (orient2d(c_.at[p], x, c_.at[q]) == 0 || holds(c_.at[p], from, x, c_.at[q]) || holds(from, c_.at[q], x, c_.at[p]))
    return false;
  return std::ranges::none_of(segments_, [&](const auto& s) {
    return s.first != v && s.second != v && s.first != but && s.second != but && c_.alive[s.first] &&
           c_.alive[s.second] && crosses(from, x, c_.at[s.first], c_.at[s.second]);
  });
}

bool ShorePieces::canCut(VertexId v) const {
  const VertexId p = c_.prev[v], q = c_.next[v];
  const Point &a = c_.at[p], &x = c_.at[v], &b = c_.at[q];
  return std::ranges::none_of(
      points_, [&](VertexId w) { return w != v && w != p && w != q && c_.alive[w] && holds(a, x, b, c_.at[w]); });
}

double ShorePieces::apart(VertexId v, const Point& x) const {
  const VertexId p = c_.prev[v], q = c_.next[v];
  const Point &a = c_.at[p], &b = c_.at[q];
  double least = std::numeric_limits<double>::infinity();
  for (const VertexId w : points_) {
    if (w == v || w == p || w == q || w == c_.prev[p] || w == c_.next[q] || !c_.alive[w]) continue;
    least = std::min({least, squaredDistanceToSegment(c_.at[w], a, x), squaredDistanceToSegment(c_.at[w], x, b)});
  }
  for (const auto& [s, e] : segments_) {
    if (s == v || e == v || s == p || e == p || s == q || e == q || !c_.alive[s] || !c_.alive[e]) continue;
    least = std::min(least, squaredDistanceToSegment(x, c_.at[s], c_.at[e]));
  }
  return std::sqrt(least);
}

}  // namespace coastmesh
