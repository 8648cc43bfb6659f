#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/ids.hpp"
#include "core/point.hpp"

namespace coastmesh {

// A straight constraint from `a` to `b`.
struct Segment {
  VertexId a = kNone;
  VertexId b = kNone;
  std::int32_t tag = 0;         // boundary marker; carried to the output, never interpreted
  RegionId left = kUnlabelled;  // what lies to the left on the way from a to b
  RegionId right = kUnlabelled;
};

// The range of coordinates: products of four lengths, which circumcentres and bounds on angles take, neither overflow
// nor lose their digits in it.
inline constexpr double kLargestCoordinate = 1e70;  // in absolute value
inline constexpr double kLeastDistance = 1e-70;     // between two points, along x or y

// False for NaN as well.
inline bool isInRange(const Point& p) {
  return std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate;
}

// A planar straight-line graph: the only input of the core.
// REQUIRES (`constrainedDelaunay` reports what is broken, and where): coordinates in the range above, no two points
// equal or nearer than it allows, no segment of zero length, no two segments that meet anywhere but in a common end
// point, no point inside a segment, labels that agree with one another.
struct Pslg {
  std::vector<Point> points;
  std::vector<Segment> segments;
  // The domain is what segments label as a region (>= 0). Where no segment is labelled, it is what the segments
  // enclose, less every face that holds one of `holes`; where there are no segments, it is the convex hull of the
  // points.
  std::vector<Point> holes;
};

// What of a PSLG its domain has: the rest is not in a mesh of it.
struct PslgCover {
  std::vector<bool> vertices;
  std::vector<bool> segments;
  double area = 0.0;
};

}  // namespace coastmesh
