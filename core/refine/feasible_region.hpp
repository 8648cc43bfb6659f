#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/metric.hpp"
#include "core/point.hpp"
#include "core/refine/look_edges.hpp"

namespace coastmesh {

// An edge of a vertex's link; the vertex is to the left of x -> y.
struct LinkEdge {
  Point x;
  Point y;
};

// The disk whose boundary sees an edge of length 1 under the minimum angle.
struct PetalShape {
  double radius;
  double height;  // height of its centre above the edge

  explicit PetalShape(const AngleBound& bound) : radius(0.5 / bound.sin_min), height(radius * bound.cos_min) {}
};

// A box around the intersection of several petals. An empty box proves that the region is empty; most empty regions
// show this way. Minima and maxima by value compile without branches.
struct PetalBox {
  Point low{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  Point high{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

  void cut(const PetalBox& by) {
    low = {larger(low.x, by.low.x), larger(low.y, by.low.y)};
    high = {smaller(high.x, by.high.x), smaller(high.y, by.high.y)};
  }
  bool isEmpty() const { return low.x >= high.x || low.y >= high.y; }
};

// The part of a line from a to b that is feasible so far, as shares of the way.
struct LinePart {
  Point from, along;
  double low = 0.0, high = 1.0;

  LinePart(const Point& a, const Point& b) : from(a), along(b - a) {}
  bool isEmpty() const { return low >= high; }
};

// The places of a vertex at which, its link fixed, all triangles of its star meet the bounds (Erten & Üngör 2007,
// Section 5). They are an intersection of convex sets: for every link edge the petal (the angle at the vertex), two
// half-planes (the angles at the ends), and disks around the ends if edges have a maximum length. The petals are cut
// off by tangents, one at a time, where needed. We differ from the paper, which samples points between two petals. Only
// a bound on the largest angle at the vertex itself is not convex: the caller tests it.
class FeasibleRegion {
 public:
  explicit FeasibleRegion(const TriangleBound& bound) : bound_(bound), petal_(bound) {}

  // A point inside the region; nullopt if the region is empty (or thinner than rounding).
  std::optional<Point> findPoint(std::span<const LinkEdge> link);

  struct Look {
    std::optional<Point> point;  // of the region
    bool is_empty = false;       // certain; if no point is found either, the region is thin and undecided
  };
  // A quick test for minimum angles alone. It also applies to a part of a link: if the region of a part is empty, so is
  // that of the whole.
  Look look(std::span<const LinkEdge> link);

  // The same in two steps, for links that share edges: `ready` prepares an edge and returns its petal's box; `look`
  // takes edges and the intersection of their boxes. REQUIRES, of all: the smallest angle is above 0.
  PetalBox ready(const Point& x, const Point& y, LookEdge& edge) const {
    const Point d = y - x;
    const double squared = squaredLength(d);
    const double radius = petal_.radius * std::sqrt(squared);
    const Point mid = midpoint(x, y);
    const Point centre{mid.x - petal_.height * d.y, mid.y + petal_.height * d.x};
    edge = {x, y, d, squared};
    return {{centre.x - radius, centre.y - radius}, {centre.x + radius, centre.y + radius}};
  }
  Look look(LookEdges& edges, const PetalBox& box);

  // The boxes of the petals of some edges, at least one: their intersection, or each.
  PetalBox boxOf(LookEdges& edges) const;
  void boxesOf(LookEdges& edges, std::vector<PetalBox>& boxes) const;

  // Like findPoint on the line from a to b: the midpoint of its feasible part.
  std::optional<Point> findPointBetween(const Point& a, const Point& b, std::span<const LinkEdge> link) const;

  // Cuts a part of a line by the constraints of one link edge. Returns whether anything is left.
  bool cut(LinePart& part, const LinkEdge& edge) const;

 private:
  struct BoxPair;

  bool isForSmallestAnglesAlone() const;
  void makeRoom(std::size_t corners);

  TriangleBound bound_;
  PetalShape petal_;

  // Scratch.
  LookEdges edges_;
  std::vector<DoublePair> shares_;
  std::vector<Point> polygon_;
  std::vector<Point> clipped_;
  std::vector<double> sides_;
};

}  // namespace coastmesh
