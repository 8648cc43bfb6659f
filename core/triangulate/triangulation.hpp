#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>

#include "core/bulk_list.hpp"
#include "core/linked_triangles.hpp"
#include "core/point.hpp"

namespace coastmesh {

// A triangulation under construction. The outside of the convex hull is filled with ghost triangles, whose third corner
// is numbered after all points, so that every edge has two sides.
struct Triangulation {
  std::span<const Point> points;
  VertexId ghost = 0;
  LinkedTriangles mesh;            // including ghosts
  BulkList<TriId> triangle_of;     // one triangle around each vertex
  BulkList<VertexId> along_curve;  // the points in Hilbert's order

  // False if all points are on one line: there is no triangulation.
  bool hasTriangles() const { return !mesh.triangles.empty(); }
  bool isGhost(TriId t) const {
    const auto& v = mesh.triangles[t].v;
    return v[0] == ghost || v[1] == ghost || v[2] == ghost;
  }
};

// Thrown if a point or segment meets another that it must not touch.
struct Clash : std::runtime_error {
  enum class Kind { PointsCoincide, PointOnSegment, SegmentsCross, SegmentsCoincide };
  Clash(Kind k, VertexId v, SegmentId s)
      : std::runtime_error("no planar straight-line graph"), kind(k), at(v), other(s) {}
  Kind kind;
  VertexId at;      // the vertex that was met
  SegmentId other;  // the segment that was met
};

// A triangle that contains x, found by walking from another; a ghost if x is outside the convex hull. Without segments
// the walk always ends; with them it may cycle: kNone after as many steps as there are triangles.
TriId walkTo(const Triangulation& triangulation, const Point& x, TriId from);

// The same, always with a result.
TriId locate(const Triangulation& triangulation, const Point& x, TriId near);

}  // namespace coastmesh
