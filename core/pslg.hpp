#pragma once

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

// A planar straight-line graph: the only input of the core.
// REQUIRES (`constrainedDelaunay` tells what is broken, and where): finite coordinates, no two equal points, no segment of zero length, no two segments
// that meet anywhere but in a common end point, no point inside a segment.
struct Pslg {
  std::vector<Point> points;
  std::vector<Segment> segments;
  // The domain is what segments label as a region (>= 0). Where no segment is labelled, it is what the segments
  // enclose, less every face that holds one of `holes`; where there are no segments, it is the convex hull of the
  // points.
  std::vector<Point> holes;
};

}  // namespace coastmesh
