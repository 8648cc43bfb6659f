#include "gis/follow/shore_settle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "core/hilbert.hpp"
#include "core/large_list.hpp"
#include "core/links.hpp"
#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/follow/shore_flips.hpp"
#include "gis/follow/shore_patches.hpp"

namespace coastmesh {

namespace {

constexpr double kShiftOfCopies = 0.05;  // as a share of the size
constexpr double kShiftOfHeight = 0.25;  // as a share of the least height of the triangles there
constexpr int kHalvings = 40;            // of a shift that inverts a triangle

class Settler {
 public:
  Settler(ShoreTriangles& triangles, const SizeFunction& size, const ItemLoop& loop)
      : t_(triangles), flips_(triangles, size), loop_(loop) {}

  void run() {
    settle();
    for (const VertexId v : loose_) flips_.remove(v);
    flips_.finish();
    t_.is_new = false;
  }

  // Leaves the triangles unfinished.
  ShoreGraph graph() {
    settle();
    for (const VertexId v : loose_) t_.home[v] = kNone;
    return graphOf(t_);
  }

 private:
  // A part of the water that touches others in a vertex; it gets a vertex of its own.
  struct Copy {
    VertexId of;
    std::vector<TriId> fan;  // counter-clockwise
    Point shift;
  };
  struct Fan {
    std::vector<TriId> triangles;
    double angle = 0.0;
    bool has_line = false;
  };

  void settle() {
    is_near_.assign(mesh().points.size(), 0);
    const auto isChanged = [&](TriId t) { return mesh().regions[t] != t_.region_was[t]; };
    const auto isOtherSegment = [&](EdgeRef e) { return segmentNow(e) != mesh().segment(e); };
    const std::vector<TriId> changed = numbersWith(loop_, 0, mesh().triangles.size(), [&](TriId t) {
      return isChanged(t) || (t_.is_new && (isOtherSegment(edgeRef(t, 0)) || isOtherSegment(edgeRef(t, 1)) ||
                                            isOtherSegment(edgeRef(t, 2))));
    });
    for (const TriId t : changed) {
      for (unsigned i = 0; i < 3; ++i) markSegment(edgeRef(t, i));
      if (!isChanged(t)) continue;
      for (const VertexId v : mesh().triangles[t].v) is_near_[v] = 1;
    }
    for (const VertexId v : t_.helpers) is_near_[v] = 1;
    t_.helpers.clear();
    const std::size_t count = mesh().points.size();
    const auto isInside = [&](VertexId v) { return t_.home[v] != kNone && (t_.use[v] & kAround) == 0; };
    for (const VertexId v : numbersWith(
             loop_, 0, count, [&](VertexId v) { return isInside(v) && (is_near_[v] != 0 || t_.is_new) && isPinch(v); }))
      split(v);
    for (const Copy& copy : copies_) separate(copy);
    loose_ = numbersWith(loop_, 0, count, [&](VertexId v) {
      return isInside(v) && (is_near_[v] != 0 || (t_.is_new && (t_.use[v] & kLoose) != 0)) && !findUse(v);
    });
  }

  TriMesh& mesh() { return t_.mesh; }
  const TriMesh& mesh() const { return t_.mesh; }
  bool isWater(TriId t) const { return mesh().regions[t] != t_.land; }

  // The segment that the edge should be part of: the last tag's for a new one.
  SegmentId segmentNow(EdgeRef e) const {
    const EdgeRef back = mesh().twin(e);
    if (back == kNone) return mesh().segment(e);
    const TriId t = triOf(e), u = triOf(back);
    const RegionId left = mesh().regions[t], right = mesh().regions[u], left_was = t_.region_was[t],
                   right_was = t_.region_was[u];
    const SegmentId was = mesh().segment(e), made = static_cast<SegmentId>(t_.tags.size() - 1);
    const bool was_line = was != kNone && (left_was == t_.land) == (right_was == t_.land);
    const bool is_there = (left != t_.land || right != t_.land) && (left != right || was_line);
    const bool is_same = was != kNone && left == left_was && right == right_was;
    return !is_there ? kNone : is_same ? was : made;
  }

  void markSegment(EdgeRef e) {
    const SegmentId now = segmentNow(e);
    if (now == mesh().segment(e)) return;
    setSegment(mesh().triangles, e, now);
    is_near_[mesh().origin(e)] = is_near_[mesh().target(e)] = 1;
    if (now == kNone) flips_.touch(triOf(e));
  }

  // True if the water touches itself there.
  bool isPinch(VertexId v) const {
    std::size_t changes = 0;
    const bool first = isWater(t_.home[v]);
    bool before = first;
    forTrianglesRound(t_, v, [&](TriId t) {
      const bool is_water = isWater(t);
      changes += is_water != before ? 1 : 0;
      before = is_water;
    });
    return changes + (before != first ? 1 : 0) > 2;
  }

  void split(VertexId v) {
    round_.clear();
    forTrianglesRound(t_, v, [&](TriId t) { round_.push_back(t); });
    std::size_t first = 0;
    while (isWater(round_[first]) || !isWater(round_[(first + 1) % round_.size()])) ++first;
    std::vector<Fan> fans;
    for (std::size_t i = 1; i <= round_.size(); ++i) {
      const TriId t = round_[(first + i) % round_.size()];
      if (!isWater(t)) continue;
      if (!isWater(round_[(first + i - 1) % round_.size()])) fans.emplace_back();
      Fan& fan = fans.back();
      const unsigned corner = mesh().cornerOf(t, v);
      const auto& c = mesh().triangle(t).v;
      fan.angle += angleAt(mesh().point(v), mesh().point(c[next3(corner)]), mesh().point(c[prev3(corner)]));
      fan.triangles.push_back(t);
      for (const unsigned side : {next3(corner), prev3(corner)}) {
        const EdgeRef e = edgeRef(t, side);
        fan.has_line = fan.has_line || (mesh().segment(e) != kNone && isWater(triOf(mesh().twin(e))));
      }
    }
    const auto kept = std::ranges::max_element(
        fans, [](const Fan& a, const Fan& b) { return a.has_line != b.has_line ? b.has_line : a.angle < b.angle; });
    for (auto fan = fans.begin(); fan != fans.end(); ++fan)
      if (fan != kept) planCopy(v, std::move(*fan));
  }

  void planCopy(VertexId v, Fan&& fan) {
    const Point& x = mesh().point(v);
    double least = std::numeric_limits<double>::infinity(), size = least;
    for (const TriId t : fan.triangles) {
      const unsigned corner = mesh().cornerOf(t, v);
      const auto& c = mesh().triangle(t).v;
      least =
          std::min(least, squaredDistanceToSegment(x, mesh().point(c[next3(corner)]), mesh().point(c[prev3(corner)])));
      size = std::min(size, t_.size[t]);
    }
    const double shift = std::min(kShiftOfCopies * size, kShiftOfHeight * std::sqrt(least));
    const TriId t = fan.triangles.front();
    const Point out = mesh().point(mesh().triangle(t).v[next3(mesh().cornerOf(t, v))]) - x;
    const double half = 0.5 * fan.angle, length = std::sqrt(squaredLength(out));
    const Point way{(out.x * std::cos(half) - out.y * std::sin(half)) / length,
                    (out.x * std::sin(half) + out.y * std::cos(half)) / length};
    copies_.push_back({v, std::move(fan.triangles), shift * way});
    is_near_[v] = 1;
  }

  bool isTurned(const Point& a, const Point& b, const Point& c) const { return orient2d(a, b, c) <= 0; }

  // Adds a triangle of land on either side of the fan.
  void separate(const Copy& copy) {
    const VertexId v = copy.of, made = static_cast<VertexId>(mesh().points.size());
    const EdgeRef first = edgeRef(copy.fan.front(), prev3(mesh().cornerOf(copy.fan.front(), v)));  // from v
    const EdgeRef last = edgeRef(copy.fan.back(), next3(mesh().cornerOf(copy.fan.back(), v)));     // to v
    const VertexId a = mesh().target(first), b = mesh().origin(last);
    const EdgeRef beyond_first = mesh().twin(first), beyond_last = mesh().twin(last);
    const SegmentId at_first = mesh().segment(first), at_last = mesh().segment(last);
    addPoint(copy, a, b);
    for (const TriId t : copy.fan) mesh().triangles[t].v[mesh().cornerOf(t, v)] = made;
    const TriId before = flips_.make({v, a, made}, t_.land), after = flips_.make({v, made, b}, t_.land);
    link(mesh().triangles, edgeRef(before, 0), first, at_first);
    link(mesh().triangles, edgeRef(before, 2), beyond_first, kNone);
    link(mesh().triangles, edgeRef(after, 0), last, at_last);
    link(mesh().triangles, edgeRef(after, 1), beyond_last, kNone);
    link(mesh().triangles, edgeRef(before, 1), edgeRef(after, 2), kNone);
    for (const TriId t : copy.fan) flips_.touch(t);
    flips_.touch(before);
    flips_.touch(after);
    t_.use[made] = useOf(t_, made);
  }

  // Half the turn from xa counter-clockwise to xb, as a vector of length 1.
  static Point bisector(const Point& x, const Point& a, const Point& b) {
    const Point to_a = a - x, to_b = b - x;
    double turn = std::atan2(cross(to_a, to_b), to_a.x * to_b.x + to_a.y * to_b.y);
    if (turn <= 0.0) turn += 2.0 * std::numbers::pi;
    const double c = std::cos(0.5 * turn), s = std::sin(0.5 * turn), length = std::sqrt(squaredLength(to_a));
    return {(to_a.x * c - to_a.y * s) / length, (to_a.x * s + to_a.y * c) / length};
  }

  void addPoint(const Copy& copy, VertexId a, VertexId b) {
    const Point x = mesh().point(copy.of);
    const auto fits = [&](const Point& to) {
      return !isTurned(x, mesh().point(a), to) && !isTurned(x, to, mesh().point(b)) &&
             std::ranges::none_of(copy.fan, [&](TriId t) {
               const unsigned i = mesh().cornerOf(t, copy.of);
               const auto& c = mesh().triangle(t).v;
               return isTurned(to, mesh().point(c[next3(i)]), mesh().point(c[prev3(i)]));
             });
    };
    const auto shortened = [&](Point shift) {
      for (int i = 0; i < kHalvings && !fits(x + shift); ++i) shift = 0.5 * shift;
      return shift;
    };
    Point shift = shortened(copy.shift);
    // Copies that were added beside it may have left room in another direction only.
    if (!fits(x + shift))
      shift = shortened(std::sqrt(squaredLength(copy.shift)) * bisector(x, mesh().point(a), mesh().point(b)));
    if (!fits(x + shift)) {
      throw BadPslg(
          {PslgDefect::Kind::OutOfRange, x, kNone, kNone,
           "water that touches itself has no room for a vertex of its own (--pinches open parts such water)"});
    }
    mesh().points.push_back(x + shift);
    if (!t_.size_at.empty()) t_.size_at.push_back(t_.size_at[copy.of]);
    t_.source.push_back(kNone);
    t_.home.push_back(kNone);
    t_.use.push_back(0);
  }

  // Returns false if the vertex is to be removed.
  bool findUse(VertexId v) {
    const std::uint8_t use = useOf(t_, v);
    const bool stays =
        (use & kLoose) == 0 || (t_.source[v] != kNone && (t_.use[v] & kLoose) != 0 && isWater(t_.home[v]));
    t_.use[v] = use | (t_.use[v] & kAtLine);
    return stays;
  }

  ShoreTriangles& t_;
  ShoreFlips flips_;
  const ItemLoop& loop_;
  std::vector<char> is_near_;    // vertices near a change
  std::vector<VertexId> loose_;  // to be removed
  std::vector<TriId> round_;
  std::vector<Copy> copies_;
};

}  // namespace

TriId locateIn(const ShoreTriangles& triangles, const Point& x, TriId from) {
  const TriMesh& mesh = triangles.mesh;
  const auto holds = [&](TriId t, unsigned i) {
    const EdgeRef e = edgeRef(t, i);
    return orient2d(mesh.point(mesh.origin(e)), mesh.point(mesh.target(e)), x) >= 0;
  };
  TriId t = from;
  const auto most = static_cast<unsigned>(100.0 + 10.0 * std::sqrt(static_cast<double>(mesh.triangles.size())));
  for (unsigned step = 0; step < most; ++step) {
    unsigned k = 0;
    while (k < 3 && holds(t, (step + k) % 3)) ++k;
    if (k == 3) return t;
    const EdgeRef onward = mesh.twin(edgeRef(t, (step + k) % 3));
    if (onward == kNone) return kNone;  // the triangulation is convex
    t = triOf(onward);
  }
  for (t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.triangle(t).v[0] != kNone && holds(t, 0) && holds(t, 1) && holds(t, 2)) return t;
  return kNone;
}

void settleShores(ShoreTriangles& triangles, const SizeFunction& size, const ItemLoop& loop) {
  Settler(triangles, size, loop).run();
}

ShoreGraph settledGraph(ShoreTriangles&& triangles, const SizeFunction& size, const ItemLoop& loop) {
  return Settler(triangles, size, loop).graph();
}

void insertPoints(ShoreTriangles& triangles, const std::vector<Point>& points, const SizeFunction& size) {
  const TriMesh& mesh = triangles.mesh;
  ShoreFlips flips(triangles, size);
  TriId t = 0;
  for (const std::uint32_t k : hilbertOrder(points)) {  // so that walks are short
    const Point& x = points[k];
    const TriId found = locateIn(triangles, x, t);
    if (found == kNone) continue;
    t = found;
    bool is_free = true;
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      is_free = is_free && mesh.point(mesh.origin(e)) != x &&
                (mesh.segment(e) == kNone || orient2d(mesh.point(mesh.origin(e)), mesh.point(mesh.target(e)), x) != 0);
    }
    if (!is_free) continue;
    const auto v = static_cast<VertexId>(mesh.points.size());
    triangles.mesh.points.push_back(x);
    if (!triangles.size_at.empty()) triangles.size_at.push_back(size.at(x));
    triangles.source.push_back(kNone);
    triangles.home.push_back(kNone);
    triangles.use.push_back(kInWater | kLoose);
    triangles.helpers.push_back(v);
    flips.insert(v, t);
  }
  flips.finish();
}

}  // namespace coastmesh
