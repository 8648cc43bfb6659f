#pragma once

#include <cassert>
#include <span>

#include "core/linked_triangles.hpp"

namespace coastmesh {

// Links between triangles: all writes of `Triangle::adj` and `Triangle::seg` in core and parallel are here. Each
// function writes both sides of an edge, or one whole triangle, so that the two sides always agree.

// Links the two sides of an edge. REQUIRES: they run between the same vertices, in opposite directions.
inline void setTwins(std::span<Triangle> triangles, EdgeRef e, EdgeRef f) {
  Triangle &one = triangles[triOf(e)], &other = triangles[triOf(f)];
  assert(one.v[next3(indexOf(e))] == other.v[prev3(indexOf(f))]);
  assert(one.v[prev3(indexOf(e))] == other.v[next3(indexOf(f))]);
  one.adj[indexOf(e)] = f;
  other.adj[indexOf(f)] = e;
}

// Makes both sides of an edge part of segment `seg`, or of none (kNone).
inline void setSegment(std::span<Triangle> triangles, EdgeRef e, SegmentId seg) {
  Triangle& own = triangles[triOf(e)];
  own.seg[indexOf(e)] = seg;
  if (const EdgeRef f = own.adj[indexOf(e)]; f != kNone) triangles[triOf(f)].seg[indexOf(f)] = seg;
}

// Sets twins and segment at once; `f` is kNone if `e` is on the boundary of the mesh.
inline void link(std::span<Triangle> triangles, EdgeRef e, EdgeRef f, SegmentId seg) {
  assert(e != kNone);
  if (f == kNone) {
    triangles[triOf(e)].adj[indexOf(e)] = kNone;
  } else {
    setTwins(triangles, e, f);
    triangles[triOf(f)].seg[indexOf(f)] = seg;
  }
  triangles[triOf(e)].seg[indexOf(e)] = seg;
}

// A new triangle, with edges still to be linked.
inline Triangle unlinked(const std::array<VertexId, 3>& corners) { return {.v = corners}; }

// A copy of a triangle with renumbered triangles and vertices. `triangle(t)` is the new number of a neighbour, or kNone
// if it is not included: that edge is then on the boundary, with `bare` in place of its segment unless that is kNone.
template <typename NewTriangle, typename NewVertex>
Triangle renumbered(const Triangle& from, const NewTriangle& triangle, const NewVertex& vertex,
                    SegmentId bare = kNone) {
  Triangle to;
  for (unsigned i = 0; i < 3; ++i) {
    to.v[i] = vertex(from.v[i]);
    to.seg[i] = from.seg[i];
    if (from.adj[i] == kNone) continue;
    const TriId t = triangle(triOf(from.adj[i]));
    if (t != kNone) {
      to.adj[i] = edgeRef(t, indexOf(from.adj[i]));
    } else if (bare != kNone) {
      to.seg[i] = bare;
    }
  }
  return to;
}

// An edge whose two sides disagree: different ends, different segments, or not each other's twin. kNone if there is
// none. Triangles whose first corner is kNone are skipped. For asserts: visits all triangles.
EdgeRef findBrokenLink(std::span<const Triangle> triangles);

}  // namespace coastmesh
