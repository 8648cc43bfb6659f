#include "core/triangulate/insert_points.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "core/links.hpp"
#include "core/metric.hpp"
#include "core/predicates.hpp"

namespace coastmesh {

namespace {

// The number of rounds after that of a point. Each round has four times the points of the previous one (Amenta, Choi,
// Rote, "Incremental constructions con BRIO", 2003; we differ: a hash replaces chance).
std::uint32_t roundsLeft(VertexId v) {
  std::uint32_t h = v * 0x9E3779B1u;
  h = (h ^ h >> 15) * 0x85EBCA77u;
  return static_cast<std::uint32_t>(std::countr_zero(h | 1u << 20)) / 2;
}

std::vector<VertexId> insertionOrder(std::span<const VertexId> along) {
  std::array<std::size_t, 12> first{};
  for (const VertexId v : along) ++first[11 - roundsLeft(v)];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<VertexId> order(along.size());
  for (const VertexId v : along) order[first[10 - roundsLeft(v)]++] = v;
  return order;
}

class PointInserter {
 public:
  PointInserter(Triangulation& triangulation, TriId first)
      : all_(triangulation), points_(all_.points), triangles_(all_.mesh.triangles), first_(first), next_(first) {}

  TriId run(std::vector<VertexId> order) {
    if (!startWith(order)) return kNone;
    for (std::size_t i = 3; i < order.size(); ++i) insertPoint(order[i]);
    TriId ghost = kNone;
    for (TriId t = first_; t < next_; ++t) {
      if (all_.isGhost(t)) {
        ghost = t;
      } else {
        for (const VertexId v : triangles_[t].v) all_.triangle_of[v] = t;
      }
    }
    return ghost;
  }

 private:
  // Makes the first triangle, of the first three points not on a line; they move to the front. False if there are none.
  bool startWith(std::vector<VertexId>& order) {
    if (order.size() < 2) return false;
    const Point &p = points_[order[0]], &q = points_[order[1]];
    if (p == q) throw Clash(Clash::Kind::PointsCoincide, order[1], kNone);
    const auto third =
        std::find_if(order.begin() + 2, order.end(), [&](VertexId v) { return orient2d(p, q, points_[v]) != 0; });
    if (third == order.end()) {
      std::ranges::sort(order, [&](VertexId a, VertexId b) { return lexLess(points_[a], points_[b]); });
      const auto same =
          std::ranges::adjacent_find(order, [&](VertexId a, VertexId b) { return points_[a] == points_[b]; });
      if (same != order.end()) throw Clash(Clash::Kind::PointsCoincide, *same, kNone);
      return false;
    }
    std::rotate(order.begin() + 2, third, third + 1);
    VertexId a = order[0], b = order[1];
    const VertexId c = order[2];
    if (orient2d(p, q, points_[c]) < 0) std::swap(a, b);
    const VertexId ghost = all_.ghost;
    const TriId inner = makeTriangle(a, b, c);
    const TriId outer[3] = {makeTriangle(ghost, c, b), makeTriangle(ghost, a, c), makeTriangle(ghost, b, a)};
    for (unsigned i = 0; i < 3; ++i) setTwins(triangles_, edgeRef(inner, i), edgeRef(outer[i], 0));
    for (unsigned i = 0; i < 3; ++i) setTwins(triangles_, edgeRef(outer[i], 1), edgeRef(outer[prev3(i)], 2));
    return true;
  }

  TriId makeTriangle(VertexId a, VertexId b, VertexId c) {
    triangles_[next_] = unlinked({a, b, c});
    return next_++;
  }

  // True if inserting x removes the triangle: its circumcircle contains x. For a ghost: x is beyond its edge or on it.
  bool isInConflict(TriId t, const Point& x) const {
    const auto& v = triangles_[t].v;
    if (!all_.isGhost(t)) return inCircle(points_[v[0]], points_[v[1]], points_[v[2]], x) > 0;
    const unsigned i = all_.mesh.cornerOf(t, all_.ghost);
    const Point &a = points_[v[next3(i)]], &b = points_[v[prev3(i)]];
    const int side = orient2d(a, b, x);
    return side > 0 || (side == 0 && dot(a - x, b - x) < 0.0);
  }

  // Bowyer-Watson: a fan around the point replaces the triangles in conflict.
  void insertPoint(VertexId v) {
    const LinkedTriangles& mesh = all_.mesh;
    const Point x = points_[v];
    const TriId start = walkTo(all_, x, next_ - 1);
    for (const VertexId corner : triangles_[start].v)
      if (corner != all_.ghost && points_[corner] == x) throw Clash(Clash::Kind::PointsCoincide, v, kNone);
    cavity_.assign(1, start);
    cavity_edges_.clear();
    stack_.assign({edgeRef(start, 2), edgeRef(start, 1), edgeRef(start, 0)});
    while (!stack_.empty()) {
      const EdgeRef e = stack_.back();
      stack_.pop_back();
      const EdgeRef beyond = mesh.twin(e);
      if (isInConflict(triOf(beyond), x)) {
        cavity_.push_back(triOf(beyond));
        stack_.push_back(edgeRef(triOf(beyond), prev3(indexOf(beyond))));
        stack_.push_back(edgeRef(triOf(beyond), next3(indexOf(beyond))));
      } else {
        cavity_edges_.push_back({mesh.origin(e), mesh.target(e), beyond});
      }
    }
    // The fan has two triangles more than the cavity. The next walk starts at the last one made.
    TriId last = kNone, first = kNone;
    for (std::size_t i = 0; i < cavity_edges_.size(); ++i) {
      const CavityEdge& r = cavity_edges_[i];
      TriId t;
      if (i < cavity_.size()) {
        t = cavity_[i];
        triangles_[t].v = {v, r.a, r.b};
      } else {
        t = makeTriangle(v, r.a, r.b);
      }
      setTwins(triangles_, edgeRef(t, 0), r.beyond);
      if (last == kNone) {
        first = t;
      } else {
        setTwins(triangles_, edgeRef(t, 2), edgeRef(last, 1));
      }
      last = t;
    }
    setTwins(triangles_, edgeRef(first, 2), edgeRef(last, 1));
  }

  struct CavityEdge {
    VertexId a, b;
    EdgeRef beyond;
  };

  Triangulation& all_;
  std::span<const Point> points_;
  std::span<Triangle> triangles_;
  TriId first_, next_;
  // Scratch.
  std::vector<EdgeRef> stack_;
  std::vector<TriId> cavity_;
  std::vector<CavityEdge> cavity_edges_;
};

}  // namespace

TriId insertPoints(Triangulation& triangulation, std::span<const VertexId> points, TriId first) {
  return PointInserter(triangulation, first).run(insertionOrder(points));
}

}  // namespace coastmesh
