#pragma once

#include <array>
#include <cstdint>

#include "core/bulk_list.hpp"
#include "core/ids.hpp"

namespace coastmesh {

//            v[2]
//            /  \            Edge i lies opposite vertex i and runs from v[i+1] to v[i+2], counter-clockwise.
//   edge 1  /    \  edge 0
//          /      \          An EdgeRef names edge i of triangle t as 4 t + i. Across an edge lies the
//       v[0]------v[1]       same edge seen from the neighbour: adj[i], or kNone on the boundary of the mesh.
//           edge 2
using EdgeRef = std::uint32_t;

// Most vertices of a mesh: it has twice as many triangles, with four EdgeRefs each.
inline constexpr std::uint64_t kMostVertices = kNone / 16;

constexpr EdgeRef edgeRef(TriId t, unsigned i) { return 4 * t + i; }
constexpr TriId triOf(EdgeRef e) { return e >> 2; }
constexpr unsigned indexOf(EdgeRef e) { return e & 3u; }
constexpr unsigned next3(unsigned i) { return i == 2 ? 0 : i + 1; }
constexpr unsigned prev3(unsigned i) { return i == 0 ? 2 : i - 1; }

// Stands for a segment on a boundary edge of a patch that must not change while the patch is worked on.
inline constexpr SegmentId kFrozen = kNone - 1;

struct Triangle {
  std::array<VertexId, 3> v{kNone, kNone, kNone};     // counter-clockwise
  std::array<EdgeRef, 3> adj{kNone, kNone, kNone};    // the same edge seen from the other side
  std::array<SegmentId, 3> seg{kNone, kNone, kNone};  // the input segment that contains edge i
};

// Triangles with links to their neighbours. Only core/links.hpp changes the links.
struct LinkedTriangles {
  BulkList<Triangle> triangles;

  const Triangle& triangle(TriId t) const { return triangles[t]; }
  VertexId origin(EdgeRef e) const { return triangles[triOf(e)].v[next3(indexOf(e))]; }
  VertexId target(EdgeRef e) const { return triangles[triOf(e)].v[prev3(indexOf(e))]; }
  VertexId apex(EdgeRef e) const { return triangles[triOf(e)].v[indexOf(e)]; }
  EdgeRef twin(EdgeRef e) const { return triangles[triOf(e)].adj[indexOf(e)]; }
  SegmentId segment(EdgeRef e) const { return triangles[triOf(e)].seg[indexOf(e)]; }

  // The index of v in t. REQUIRES: v is a corner of t.
  unsigned cornerOf(TriId t, VertexId v) const {
    const auto& c = triangles[t].v;
    return (c[1] == v ? 1u : 0u) | (c[2] == v ? 2u : 0u);  // without a branch, which could not be predicted
  }
};

}  // namespace coastmesh
