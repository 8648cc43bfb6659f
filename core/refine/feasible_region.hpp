#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/metric.hpp"
#include "core/point.hpp"

namespace coastmesh {

// An edge of a vertex's link; the vertex lies to the left of x -> y.
struct LinkEdge {
  Point x;
  Point y;
};

// The disk whose boundary sees an edge under the smallest angle, the edge being of length 1.
struct PetalShape {
  double radius;
  double height;  // of its centre above the edge

  explicit PetalShape(const AngleBound& bound) : radius(0.5 / bound.sin_min), height(radius * bound.cos_min) {}
};

// Where a vertex may lie so that, its link fixed, all triangles of its star hold the bounds (Erten & Üngör 2007,
// Section 5). That set is an intersection of convex ones: for every link edge the petal (the angle at the vertex), two
// half-planes (the angles at the ends), and disks round the ends where edges may not be longer than a size. The petals
// are cut off by tangents, one at a time, where they matter. We differ from the paper, which samples points between two
// petals. Only a bound on the largest angle at the vertex itself is not convex: it is for the caller to test.
class FeasibleRegion {
 public:
  explicit FeasibleRegion(const TriangleBound& bound) : bound_(bound), petal_(bound) {}

  // A point inside the region, or nothing where there is none (or one thinner than rounding).
  std::optional<Point> findPoint(std::span<const LinkEdge> link);

  struct Look {
    std::optional<Point> point;  // of the region
    bool is_empty = false;       // certainly; where there is no point either it is thin, and not known
  };
  // The same for smallest angles alone, quickly. Of a part of a link, too: where the region of that is empty, so is
  // that of the whole.
  Look look(std::span<const LinkEdge> link);

  // As findPoint on the line from a to b: the point in the middle of what is feasible there.
  std::optional<Point> findPointBetween(const Point& a, const Point& b, std::span<const LinkEdge> link) const;

 private:
  bool isForSmallestAnglesAlone() const;
  void makeRoom(std::size_t corners);

  TriangleBound bound_;
  PetalShape petal_;

  struct Edge {  // of the link, from one end along it
    Point from, along;
    double squared;        // length
    double inverse = 0.0;  // of that
  };

  // Scratch.
  std::vector<Edge> edges_;
  std::vector<Point> polygon_;
  std::vector<Point> clipped_;
  std::vector<double> sides_;
};

}  // namespace coastmesh
