#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/ids.hpp"
#include "core/item_loop.hpp"
#include "core/point.hpp"

namespace coastmesh {

//            v[2]
//            /  \            Edge i lies opposite vertex i and runs from v[i+1] to v[i+2], counter-clockwise.
//   edge 1  /    \  edge 0
//          /      \          An EdgeRef names edge i of triangle t as 4 t + i. Across an edge lies the
//       v[0]------v[1]       same edge seen from the neighbour: adj[i], or kNone on the rim of the mesh.
//           edge 2
using EdgeRef = std::uint32_t;

constexpr EdgeRef edgeRef(TriId t, unsigned i) { return 4 * t + i; }
constexpr TriId triOf(EdgeRef e) { return e >> 2; }
constexpr unsigned indexOf(EdgeRef e) { return e & 3u; }
constexpr unsigned next3(unsigned i) { return i == 2 ? 0 : i + 1; }
constexpr unsigned prev3(unsigned i) { return i == 0 ? 2 : i - 1; }

// In place of a segment: an edge of a patch's rim, which is not to be changed while the patch is worked on.
inline constexpr SegmentId kFrozen = kNone - 1;

struct Triangle {
  std::array<VertexId, 3> v{kNone, kNone, kNone};     // counter-clockwise
  std::array<EdgeRef, 3> adj{kNone, kNone, kNone};    // the same edge seen from the other side
  std::array<SegmentId, 3> seg{kNone, kNone, kNone};  // the input segment that edge i is a piece of
};

// Triangles that know their neighbours. core/links.hpp writes what links them.
struct LinkedTriangles {
  std::vector<Triangle> triangles;

  const Triangle& triangle(TriId t) const { return triangles[t]; }
  VertexId origin(EdgeRef e) const { return triangles[triOf(e)].v[next3(indexOf(e))]; }
  VertexId target(EdgeRef e) const { return triangles[triOf(e)].v[prev3(indexOf(e))]; }
  VertexId apex(EdgeRef e) const { return triangles[triOf(e)].v[indexOf(e)]; }
  EdgeRef twin(EdgeRef e) const { return triangles[triOf(e)].adj[indexOf(e)]; }
  SegmentId segment(EdgeRef e) const { return triangles[triOf(e)].seg[indexOf(e)]; }

  // The index of v in t. REQUIRES: v is a corner of t.
  unsigned cornerOf(TriId t, VertexId v) const {
    const auto& c = triangles[t].v;
    return (c[1] == v ? 1u : 0u) | (c[2] == v ? 2u : 0u);  // no branch: there is nothing to predict
  }
};

// A triangle mesh that is compact: every triangle is live; points may be unused where the input had points off the
// domain.
struct TriMesh : LinkedTriangles {
  // The first `input_vertices` points are the PSLG's, in its order, bit for bit; Steiner points follow.
  std::vector<Point> points;
  std::vector<RegionId> regions;  // one a triangle: the feature it belongs to
  VertexId input_vertices = 0;

  const Point& point(VertexId v) const { return points[v]; }
};

// An edge that more than two triangles, or two triangles of opposite orientation, claim.
struct EdgeConflict {
  VertexId a = kNone;
  VertexId b = kNone;
};

// Links triangles given by their corners (any rotation, counter-clockwise) into a mesh without constraints, all of
// region 0. Edges that cannot be linked are left as rim and listed in `conflicts`.
TriMesh linkTriangles(std::vector<Point> points, std::span<const std::array<VertexId, 3>> corners,
                      std::vector<EdgeConflict>& conflicts);

// One triangle around each vertex as the edge that starts there; a rim edge where there is one. kNone for an unused
// vertex.
std::vector<EdgeRef> outgoingEdges(const TriMesh& mesh);

// The rim as closed loops of vertices with the mesh to the left: outer loops counter-clockwise, holes clockwise.
// Every loop starts at its lexicographically least vertex; loops are sorted by that vertex. A loop passes a pinched
// vertex once for every fan of triangles there.
std::vector<std::vector<VertexId>> rimLoops(const TriMesh& mesh, const ItemLoop& loop = inOrder);

// One a vertex: 1 where a triangle has it as a corner.
std::vector<std::uint8_t> usedVertices(const TriMesh& mesh, const ItemLoop& loop = inOrder);

// A hash of coordinates and corners, in order. Equal meshes, bit for bit, give equal digests on every machine.
std::uint64_t digestOf(const TriMesh& mesh, std::uint64_t seed = 0, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
