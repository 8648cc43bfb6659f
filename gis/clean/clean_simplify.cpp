#include "gis/clean/clean_simplify.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <unordered_map>
#include <unordered_set>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

namespace {

// A vertex and its first two segments. If there are exactly two, of the same labels, they link it into a chain.
struct Link {
  std::array<std::uint32_t, 2> segment{kNone, kNone};
  std::uint32_t degree = 0;
  std::uint32_t version = 0;  // grows whenever a neighbour changes: older queue entries are stale
};

// A living segment, with the vertices dropped from it, in order from a to b.
struct Piece {
  Segment segment;
  std::vector<VertexId> dropped;
  bool alive = true;
};

class Simplifier {
 public:
  Simplifier(const CleanVertices& vertices, const LabelledEdges& edges, const Resolution& resolution,
             const std::function<double(VertexId)>& tolerance, double apart)
      : vertices_(vertices),
        lines_(edges.lines),
        resolution_(resolution),
        tolerance_(tolerance),
        apart_(apart),
        links_(vertices.plane.size()) {
    pieces_.reserve(edges.segments.size());
    for (const VertexId v : edges.points) links_[v].degree = 3;  // never dropped, but it blocks others
    kept_.insert(edges.asked.begin(), edges.asked.end());
    for (const Segment& s : edges.segments) {
      for (const VertexId v : {s.a, s.b}) {
        Link& link = links_[v];
        if (link.degree < 2) link.segment[link.degree] = static_cast<std::uint32_t>(pieces_.size());
        ++link.degree;
      }
      pieces_.push_back({s, {}, true});
      ends_.insert(keyOf(s.a, s.b));
    }
    for (const Segment& s : edges.segments) {
      for (const auto& [v, w] : {std::pair(s.a, s.b), std::pair(s.b, s.a)}) {
        if (links_[v].degree > 2) junctions_[v].push_back(w);
      }
    }
    std::vector<Box> boxes(links_.size());
    for (VertexId v = 0; v < links_.size(); ++v) {
      if (links_[v].degree > 0) boxes[v].add(at(v));
    }
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
  }

  // Limits removal to vertices v for which `may(v, p, q)` is true, with the neighbours p and q.
  template <typename May>
  void restrictTo(May&& may) {
    for (VertexId v = 0; v < links_.size(); ++v) {
      if (!removable(v) || !may(v, other(links_[v].segment[0], v), other(links_[v].segment[1], v))) kept_.insert(v);
    }
  }

  template <typename Dropped>
  std::vector<Segment> run(Dropped&& dropped) {
    for (VertexId v = 0; v < links_.size(); ++v) enqueue(v);
    // Terminates, since only dropping a vertex adds entries.
    while (!queue_.empty()) {
      const Entry entry = queue_.top();
      queue_.pop();
      if (entry.version != links_[entry.vertex].version || !removable(entry.vertex)) continue;
      if (blocked(entry.vertex) || pointed(entry.vertex)) continue;
      dropped(entry.vertex, pieces_[links_[entry.vertex].segment[0]].segment);
      drop(entry.vertex);
    }
    std::vector<Segment> kept;
    for (const Piece& piece : pieces_) {
      if (piece.alive) kept.push_back(piece.segment);
    }
    return kept;
  }

 private:
  struct Entry {
    double cost;
    VertexId vertex;
    std::uint32_t version;

    bool operator<(const Entry& other) const { return cost != other.cost ? cost > other.cost : vertex > other.vertex; }
  };

  const Point& at(VertexId v) const { return vertices_.plane[v]; }

  VertexId other(std::uint32_t segment, VertexId v) const {
    const Segment& s = pieces_[segment].segment;
    return s.a == v ? s.b : s.a;
  }

  // Labels on the left and on the right when leaving v.
  std::pair<RegionId, RegionId> labelsFrom(std::uint32_t segment, VertexId v) const {
    const Segment& s = pieces_[segment].segment;
    return s.a == v ? std::pair(s.left, s.right) : std::pair(s.right, s.left);
  }

  bool removable(VertexId v) const {
    if (links_[v].degree != 2 || kept_.contains(v)) return false;
    const auto [first, second] = links_[v].segment;
    const std::int32_t tag = pieces_[first].segment.tag;
    if (tag != pieces_[second].segment.tag || (isLineTag(tag) && lines_[lineOfTag(tag)].borders_region)) return false;
    const auto [left, right] = labelsFrom(first, v);
    if (labelsFrom(second, v) != std::pair(right, left)) return false;
    const VertexId p = other(first, v), q = other(second, v);
    return p != q && !joined(p, q);
  }

  // True if p and q are joined by a segment already: the ring is a triangle, or two chains run between them.
  bool joined(VertexId p, VertexId q) const { return ends_.contains(keyOf(p, q)); }

  static std::uint64_t keyOf(VertexId p, VertexId q) {
    return (static_cast<std::uint64_t>(std::min(p, q)) << 32) | std::max(p, q);
  }

  // The largest squared distance of v, and of vertices dropped beside it, from the segment that would replace it.
  double costOf(VertexId v) const {
    const auto [first, second] = links_[v].segment;
    const Point &a = at(other(first, v)), &b = at(other(second, v));
    double cost = squaredDistanceToSegment(at(v), a, b);
    for (const std::uint32_t s : {first, second}) {
      for (const VertexId d : pieces_[s].dropped) cost = std::max(cost, squaredDistanceToSegment(at(d), a, b));
    }
    return cost;
  }

  void enqueue(VertexId v) {
    if (!removable(v)) return;
    const double cost = costOf(v), tolerance = tolerance_(v);
    if (tolerance >= 0.0 && cost <= tolerance * tolerance) queue_.push({cost, v, links_[v].version});
  }

  // True if the triangle of v and its neighbours contains another living vertex, or one on its boundary, or if the
  // segment that would replace v comes too near to one: within the gap, or, within `apart_` of the tolerance, much
  // nearer than the shore was.
  bool blocked(VertexId v) const {
    const VertexId p = other(links_[v].segment[0], v), q = other(links_[v].segment[1], v);
    const int turn = orient2d(at(p), at(v), at(q));
    Box box = Box::of(at(p), at(q));
    box.add(at(v));
    bool found = false;
    const double gap = resolution_.gap, apart = apart_ > 0.0 ? apart_ * tolerance_(v) : 0.0;
    tree_.visit(box.grownBy(std::max(gap, apart)), [&](std::uint32_t w) {
      if (found || w == v || w == p || w == q || links_[w].degree == 0) return;
      const double distance = squaredDistanceToSegment(at(w), at(p), at(q));
      found = distance < gap * gap || (distance < apart * apart && narrows(w, v, distance));
      if (found) return;
      if (turn == 0) {  // v lies on pq, or the chain turns back: no vertex may lie on that line
        found = orient2d(at(p), at(q), at(w)) == 0;
        return;
      }
      found = orient2d(at(p), at(v), at(w)) * turn >= 0 && orient2d(at(v), at(q), at(w)) * turn >= 0 &&
              orient2d(at(q), at(p), at(w)) * turn >= 0;
    });
    return found;
  }

  // True if w is less than half as far from the segment that would replace v as from the shore that this segment stands
  // for. `distance` is squared.
  bool narrows(VertexId w, VertexId v, double distance) const {
    constexpr double kShare = 0.5;
    const auto isNear = [&](const Point& a, const Point& b) {
      return kShare * kShare * squaredDistanceToSegment(at(w), a, b) <= distance;
    };
    for (const std::uint32_t s : links_[v].segment) {
      const Piece& piece = pieces_[s];
      VertexId from = piece.segment.a;
      for (const VertexId to : piece.dropped) {
        if (isNear(at(from), at(to))) return false;
        from = to;
      }
      if (isNear(at(from), at(piece.segment.b))) return false;
    }
    return true;
  }

  // True if the segment that would replace v makes too small an angle with another at one of its ends.
  bool pointed(VertexId v) const {
    const VertexId p = other(links_[v].segment[0], v), q = other(links_[v].segment[1], v);
    return pointedAt(p, v, q) || pointedAt(q, v, p);
  }

  // The same at p, where pq would replace pv.
  bool pointedAt(VertexId p, VertexId v, VertexId q) const {
    const Point out = at(q) - at(p);
    const double length = std::sqrt(squaredLength(out));
    double shortest = length, least_apart = std::numeric_limits<double>::infinity();
    const auto take = [&](VertexId r) {
      if (r == v) return;
      const Point beside = at(r) - at(p);
      const double beside_length = std::sqrt(squaredLength(beside));
      shortest = std::min(shortest, beside_length);
      if (dot(out, beside) > 0) least_apart = std::min(least_apart, std::abs(cross(out, beside)) / beside_length);
    };
    if (links_[p].degree <= 2) {
      for (std::uint32_t i = 0; i < links_[p].degree; ++i) take(other(links_[p].segment[i], p));
    } else if (const auto junction = junctions_.find(p); junction != junctions_.end()) {
      for (const VertexId r : junction->second) take(r);
    }
    return least_apart / length * shortest < resolution_.grain;
  }

  void drop(VertexId v) {
    const auto [first, second] = links_[v].segment;
    const VertexId p = other(first, v), q = other(second, v);
    const auto [left, right] = labelsFrom(second, v);
    Piece joined{{p, q, pieces_[first].segment.tag, left, right}, {}, true};
    for (const std::uint32_t s : {first, second}) {
      std::vector<VertexId> dropped = std::move(pieces_[s].dropped);
      const bool along = pieces_[s].segment.b == (s == first ? v : q);
      if (!along) std::reverse(dropped.begin(), dropped.end());
      joined.dropped.insert(joined.dropped.end(), dropped.begin(), dropped.end());
      if (s == first) joined.dropped.push_back(v);
      pieces_[s].alive = false;
    }
    const auto number = static_cast<std::uint32_t>(pieces_.size());
    pieces_.push_back(std::move(joined));
    links_[v].degree = 0;
    ends_.erase(keyOf(p, v));
    ends_.erase(keyOf(v, q));
    ends_.insert(keyOf(p, q));
    for (const VertexId end : {p, q}) {
      Link& link = links_[end];
      for (std::uint32_t& s : link.segment) {
        if (s == first || s == second) s = number;
      }
      if (link.degree > 2) std::ranges::replace(junctions_[end], v, end == p ? q : p);
      ++link.version;
    }
    enqueue(p);
    enqueue(q);
  }

  const CleanVertices& vertices_;
  const std::vector<DomainLine>& lines_;
  const Resolution& resolution_;
  const std::function<double(VertexId)>& tolerance_;  // in the plane
  double apart_;                                      // of the tolerance: see `blocked`
  std::vector<Link> links_;
  std::vector<Piece> pieces_;
  std::unordered_map<VertexId, std::vector<VertexId>> junctions_;  // neighbours, if more than two
  std::unordered_set<std::uint64_t> ends_;                         // of living pieces
  std::unordered_set<VertexId> kept_;                              // never to be dropped
  BoxTree tree_;
  std::priority_queue<Entry> queue_;
};

}  // namespace

std::vector<Segment> simplifyEdges(const CleanVertices& vertices, const LabelledEdges& edges,
                                   const Coastline& coastline, const Projection& projection,
                                   const Resolution& resolution, double tolerance_m, CleanReport& report) {
  const std::function<double(VertexId)> tolerance = [&](VertexId v) {
    return tolerance_m * projection.scaleAt(vertices.plane[v]);
  };
  constexpr double kApart = 0.25;  // hardly fewer points with more of it, which takes longer
  Simplifier simplifier(vertices, edges, resolution, tolerance, kApart);
  return simplifier.run([&](VertexId v, const Segment& segment) {
    const auto feature = static_cast<std::size_t>(std::max(segment.left, segment.right));
    report.add(EditKind::SimplifiedPoint, vertices.input[v], coastline, feature);
  });
}

namespace {

// The unit of the last decimal in which a coordinate is written: 1e-7 for 3.1415926; no more than `most`, and no less
// than `least`.
double lastDecimal(double x, double most, double least) {
  double step = most;
  for (double scale = 1.0 / most; step > least; scale *= 10.0, step /= 10.0)
    if (std::abs(x - std::round(x * scale) / scale) <= 2.0 * std::numeric_limits<double>::epsilon() * std::abs(x))
      break;
  return std::max(step, least);
}

}  // namespace

std::vector<Segment> dropTraces(const CleanVertices& vertices, const LabelledEdges& edges, const Coastline& coastline,
                                const Projection& projection, const Resolution& resolution, CleanReport& report) {
  constexpr double kFarthest = 1000;  // metres: not reached, since `isStraight` is stricter
  const double coarsest = coastline.crs.geographic ? 1e-7 : 0.01;  // last decimals: degrees, metres
  constexpr double kStraight = 0.01;  // of the new segment: a longer deviation is a bend, however coarse the decimals
  constexpr double kRounding = 0x1p-44;  // of a coordinate
  const std::function<double(VertexId)> farthest = [&](VertexId v) {
    return kFarthest * projection.scaleAt(vertices.plane[v]);
  };
  Simplifier simplifier(vertices, edges, resolution, farthest, 0.0);
  simplifier.restrictTo([&](VertexId v, VertexId p, VertexId q) {
    if (!std::ranges::binary_search(edges.traces, v)) return false;
    const auto isStraight = [](const Point& at, const Point& a, const Point& b, double room) {
      const double square = squaredDistanceToSegment(at, a, b);
      return square <= room * room && square <= kStraight * kStraight * squaredDistance(a, b);
    };
    if (vertices.is_new[v])
      return isStraight(vertices.plane[v], vertices.plane[p], vertices.plane[q], resolution.grain);
    const Point &at = vertices.input[v], &a = vertices.input[p], &b = vertices.input[q];
    if (coastline.crs.geographic && std::abs(a.x - b.x) >= 180) return false;
    const double least = kRounding * std::max({std::abs(at.x), std::abs(at.y), std::abs(a.x), std::abs(a.y)});
    return isStraight(at, a, b, std::min(lastDecimal(at.x, coarsest, least), lastDecimal(at.y, coarsest, least)));
  });
  return simplifier.run([&](VertexId v, const Segment& segment) {
    const auto feature = static_cast<std::size_t>(std::max(segment.left, segment.right));
    report.add(EditKind::DissolvedEdge, vertices.input[v], coastline, feature);
  });
}

}  // namespace coastmesh
