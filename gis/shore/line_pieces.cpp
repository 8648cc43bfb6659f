#include "gis/shore/line_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "gis/geometry/chain_index.hpp"
#include "gis/geometry/crossing.hpp"

namespace coastmesh {

namespace {

// Shares of the size.
constexpr double kAtVertex = 0.1;
constexpr double kOnShore = 1e-6;      // nearer points lie on the shore
constexpr double kNoDistance = 1e-12;  // nearer crossings are the same

std::vector<std::pair<VertexId, VertexId>> edgesOf(const std::vector<Segment>& segments) {
  std::vector<std::pair<VertexId, VertexId>> edges;
  edges.reserve(segments.size());
  for (const Segment& s : segments) edges.emplace_back(s.a, s.b);
  return edges;
}

BoxTree treeOf(const std::vector<Point>& points, const std::vector<Segment>& segments) {
  std::vector<Box> boxes;
  boxes.reserve(segments.size());
  for (const Segment& s : segments) boxes.push_back(Box::of(points[s.a], points[s.b]));
  return {boxes, BoxTree::Order::Hilbert};
}

}  // namespace

LineCutter::LineCutter(const Pslg& shores, const std::vector<Point>& at, const std::vector<Segment>& lines,
                       const SizeFunction& size)
    : shores_(shores),
      points_(at),
      lines_(lines),
      size_(size),
      edges_(edgesOf(shores.segments)),
      map_(shores.points, edges_),
      faces_(map_, shores.points, edges_),
      shore_boxes_(treeOf(shores.points, shores.segments)),
      line_boxes_(treeOf(at, lines)),
      cuts_(shores.segments.size()),
      cut_pieces_(lines.size()) {
  for (std::uint32_t v = 0; v < at.size(); ++v) nodes_.push_back(nodeOf(v));
}

// A point of a line; part of the shore if it lies on it, up to rounding.
LineNode LineCutter::nodeOf(std::uint32_t point) {
  LineNode node{.at = points_[point], .of = point};
  const double near = kOnShore * size_.at(node.at);
  double nearest = near;
  shore_boxes_.visit(Box::of(node.at, node.at).grownBy(near), [&](std::uint32_t s) {
    const auto [p, q] = edges_[s];
    for (const VertexId v : {p, q}) {
      const double off = distance(node.at, shores_.points[v]);
      if (off > near || (node.vertex != kNone && (off > nearest || (off == nearest && v >= node.vertex)))) continue;
      nearest = off;
      node.vertex = v;
    }
    const double off = std::sqrt(squaredDistanceToSegment(node.at, shores_.points[p], shores_.points[q]));
    if (off <= near && node.shore > s) node.shore = s;
  });
  if (node.vertex != kNone) {
    node.at = shores_.points[node.vertex];
    node.shore = kNone;
  } else if (node.shore != kNone) {
    cuts_[node.shore].push_back(point);
  }
  return node;
}

std::uint32_t LineCutter::addNode(const Point& x) {
  nodes_.push_back({.at = x});
  return static_cast<std::uint32_t>(nodes_.size() - 1);
}

RegionId LineCutter::waterAt(const Point& x) const {
  const auto around = map_.around(faces_.faceAt(x));
  if (around.empty()) return kOutside;
  const Segment& s = shores_.segments[around.front() / 2];
  return around.front() % 2 == 0 ? s.left : s.right;
}

bool LineCutter::isShoreWithin(const Point& x, double distance) const {
  bool found = false;
  shore_boxes_.visit(Box::of(x, x).grownBy(distance), [&](std::uint32_t s) {
    const Segment& shore = shores_.segments[s];
    found =
        found || squaredDistanceToSegment(x, shores_.points[shore.a], shores_.points[shore.b]) < distance * distance;
  });
  return found;
}

bool LineCutter::isOf(std::uint32_t node, SegmentId shore) const {
  const Segment& s = shores_.segments[shore];
  const LineNode& n = nodes_[node];
  return n.vertex != kNone ? n.vertex == s.a || n.vertex == s.b : n.shore == shore;
}

bool LineCutter::hasNodeAt(const Point& x) const {
  bool found = false;
  line_boxes_.visit(Box::of(x, x).grownBy(beyond_), [&](std::uint32_t s) {
    found = found || points_[lines_[s].a] == x || points_[lines_[s].b] == x;
    for (const auto& [a, b] : cut_pieces_[s]) found = found || a == x || b == x;
  });
  return found;
}

bool LineCutter::areOnOneShore(std::uint32_t a, std::uint32_t b) const {
  if (!nodes_[a].isAtShore() || !nodes_[b].isAtShore()) return false;
  bool found = false;
  shore_boxes_.visit(Box::of(at(a), at(a)), [&](std::uint32_t s) { found = found || (isOf(a, s) && isOf(b, s)); });
  return found;
}

// In order along the line.
std::vector<LineCutter::Crossing> LineCutter::crossingsOf(SegmentId line) const {
  std::vector<Crossing> crossings;
  const VertexId from = lines_[line].a, to = lines_[line].b;
  const Point &a = at(from), &b = at(to);
  const auto add = [&](const Point& x, SegmentId s) {
    crossings.push_back({.at = x, .along = squaredDistance(a, x), .shore = s});
  };
  shore_boxes_.visit(Box::of(a, b), [&](std::uint32_t s) {
    if (isOf(from, s) || isOf(to, s)) return;
    const Point &p = shores_.points[edges_[s].first], &q = shores_.points[edges_[s].second];
    if (!segmentsMeet(a, b, p, q)) return;
    const bool p_is_on = orient2d(a, b, p) == 0, q_is_on = orient2d(a, b, q) == 0;
    const Box box = Box::of(a, b);
    if (p_is_on && box.meets(Box::of(p, p))) add(p, s);
    if (q_is_on && box.meets(Box::of(q, q))) add(q, s);
    if (p_is_on || q_is_on) return;
    const bool a_is_on = orient2d(p, q, a) == 0, b_is_on = orient2d(p, q, b) == 0;
    add(a_is_on ? a : b_is_on ? b : crossingPoint(a, b, p, q), s);
  });
  std::ranges::sort(crossings, [](const Crossing& x, const Crossing& y) {
    return x.along != y.along ? x.along < y.along : x.shore < y.shore;
  });
  return crossings;
}

void LineCutter::cut(SegmentId line, std::vector<LinePiece>& pieces, std::vector<std::pair<Point, Point>>& dry) {
  const Segment& whole = lines_[line];
  std::vector<Crossing> crossings = crossingsOf(line);
  const double least = kNoDistance * size_.at(at(whole.a));
  for (std::size_t i = 0; i <= crossings.size(); ++i) {
    const bool is_last = i == crossings.size();
    const Point from = i == 0 ? at(whole.a) : crossings[i - 1].at, to = is_last ? at(whole.b) : crossings[i].at;
    if (distance(from, to) <= least) continue;
    if (waterAt(midpoint(from, to)) != whole.left) {
      dry.emplace_back(from, to);
      continue;
    }
    LinePiece piece{i == 0 ? whole.a : nodeAt(crossings[i - 1], to, is_last ? whole.b : kNone, line), whole.b, line};
    if (!is_last) piece.b = nodeAt(crossings[i], at(piece.a), piece.a, line);
    if (piece.a != piece.b && fits(piece.a, at(piece.a), piece.b, line)) {
      pieces.push_back(piece);
      if (!crossings.empty()) noteCut(line, at(piece.a), at(piece.b));
    } else {
      dry.emplace_back(from, to);
    }
  }
}

// The node where a line ends at a shore. The line comes from `inner`, the place of `inner_node` unless that is kNone.
std::uint32_t LineCutter::nodeAt(Crossing& crossing, Point inner, std::uint32_t inner_node, SegmentId line,
                                 bool leads) {
  if (crossing.node != kNone) return crossing.node;
  const auto [p, q] = edges_[crossing.shore];
  const double most = kAtVertex * size_.at(crossing.at);
  double nearest = std::numeric_limits<double>::infinity();
  LineNode found{.at = crossing.at, .shore = crossing.shore};
  std::uint32_t known = kNone;
  const auto look = [&](const LineNode other, std::uint32_t id) {
    const double off = distance(crossing.at, other.at);
    if (off > most || off >= nearest) return;
    nodes_.push_back(other);
    const bool fits_so = fits(inner_node, inner, static_cast<std::uint32_t>(nodes_.size() - 1), line, leads);
    nodes_.pop_back();
    if (!fits_so) return;
    nearest = off;
    found = other;
    known = id;
  };
  for (const VertexId v : {p, q}) look({.at = shores_.points[v], .vertex = v}, kNone);
  for (const std::uint32_t other : cuts_[crossing.shore]) look(nodes_[other], other);
  if (known == kNone) {
    known = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(found);
    if (found.vertex == kNone) cuts_[crossing.shore].push_back(known);
  }
  return crossing.node = known;
}

// True if a piece of the line from x to `end` meets shores and other lines only at its ends. `start` is the node at x,
// or kNone. `leads`: the piece leads away from the line, whose own pieces are then ignored.
bool LineCutter::fits(std::uint32_t start, const Point& x, std::uint32_t end, SegmentId line, bool leads) const {
  const Point& y = at(end);
  if (x == y) return false;
  const auto runsAlong = [](const Point& from, const Point& to, const Point& other) {
    return orient2d(from, to, other) == 0 && dot(to - from, other - from) > 0.0;
  };
  bool fits_so = true;
  shore_boxes_.visit(Box::of(x, y), [&](std::uint32_t s) {
    const Point &p = shores_.points[edges_[s].first], &q = shores_.points[edges_[s].second];
    const bool at_start = start != kNone ? isOf(start, s) : segmentsMeet(x, x, p, q), at_end = isOf(end, s);
    if (at_start && at_end) {
      fits_so = false;
    } else if (at_start || at_end) {
      const Point &from = at_start ? x : y, &to = at_start ? y : x;
      fits_so = fits_so && !runsAlong(from, to, p) && !runsAlong(from, to, q);
    } else {
      fits_so = fits_so && !segmentsMeet(x, y, p, q);
    }
  });
  const auto isClearOf = [&](const Point& p, const Point& q) {
    if (x == p) return y != q && !runsAlong(x, y, q);
    if (x == q) return y != p && !runsAlong(x, y, p);
    if (y == p) return !runsAlong(y, x, q);
    if (y == q) return !runsAlong(y, x, p);
    return !segmentsMeet(x, y, p, q);
  };
  line_boxes_.visit(Box::of(x, y).grownBy(beyond_), [&](std::uint32_t s) {
    fits_so = fits_so && (s == line || isClearOf(points_[lines_[s].a], points_[lines_[s].b]));
    if (leads && s == line) return;
    for (const auto& [a, b] : cut_pieces_[s]) fits_so = fits_so && isClearOf(a, b);
  });
  return fits_so;
}

void LineCutter::noteCut(SegmentId line, const Point& a, const Point& b) {
  cut_pieces_[line].emplace_back(a, b);
  const Box box = Box::of(points_[lines_[line].a], points_[lines_[line].b]), piece = Box::of(a, b);
  beyond_ =
      std::max({beyond_, box.xmin - piece.xmin, piece.xmax - box.xmax, box.ymin - piece.ymin, piece.ymax - box.ymax});
}

std::optional<LinePiece> LineCutter::leadToShore(std::uint32_t node, SegmentId line, double most) {
  const Point x = at(node);
  double nearest = most;
  Crossing foot{.at = x, .shore = kNone};
  shore_boxes_.visit(Box::of(x, x).grownBy(most), [&](std::uint32_t s) {
    const Point &p = shores_.points[edges_[s].first], &q = shores_.points[edges_[s].second];
    const double along = shareAlongSegment(x, p, q);
    const Point at = along == 1.0 ? q : p + along * (q - p);
    const double off = distance(x, at);
    if (off > nearest || (off == nearest && foot.shore < s)) return;
    nearest = off;
    foot = {.at = at, .shore = s};
  });
  if (foot.shore == kNone) return std::nullopt;
  const LinePiece piece{node, nodeAt(foot, x, node, line, true), line};
  if (!fits(piece.a, x, piece.b, line, true)) return std::nullopt;
  noteCut(line, x, at(piece.b));
  return piece;
}

}  // namespace coastmesh
