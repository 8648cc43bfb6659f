#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/ids.hpp"
#include "core/point.hpp"

namespace coastmesh {

// Whether new vertices may divide a segment. One of `Never` is an edge of the mesh: for a part of a larger mesh, whose
// rest keeps its edges.
enum class Divide : std::uint32_t { Freely, Never };

// A straight constraint from `a` to `b`.
struct Segment {
  VertexId a = kNone;
  VertexId b = kNone;
  std::int32_t tag = 0;         // boundary marker; carried to the output, never interpreted
  RegionId left = kUnlabelled;  // the region on the left when going from a to b
  RegionId right = kUnlabelled;
  Divide divide = Divide::Freely;
};

// The range of coordinates. Within it products of four lengths, as in circumcentres and bounds on angles, neither
// overflow nor lose digits.
inline constexpr double kLargestCoordinate = 1e70;  // in absolute value
inline constexpr double kLeastDistance = 1e-70;     // between two points, along x or y

// False for NaN as well.
inline bool isInRange(const Point& p) {
  return std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate;
}

// A planar straight-line graph: the only input of the core. REQUIRES (`constrainedDelaunay` reports violations and
// their places): coordinates in the range above, no two points equal or closer than allowed, no segment of zero length,
// no two segments that meet other than in a common end point, no point inside a segment, labels that agree with one
// another.
struct Pslg {
  std::vector<Point> points;
  std::vector<Segment> segments;
  // The domain is what segments label as a region (>= 0). If no segment is labelled, it is what the segments enclose,
  // without every face that contains one of `holes`; if there are no segments, it is the convex hull of the points.
  std::vector<Point> holes;
};

// True if an edge that carries the number `s` may be divided: it belongs to a segment (not kNone or kFrozen), and that
// allows it.
inline bool mayDivide(const Pslg& pslg, SegmentId s) {
  return s < pslg.segments.size() && pslg.segments[s].divide == Divide::Freely;
}

// The part of a PSLG that is in its domain; the rest is not in the mesh.
struct PslgCover {
  std::vector<bool> vertices;
  std::vector<bool> segments;
  double area = 0.0;
};

}  // namespace coastmesh
