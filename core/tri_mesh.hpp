#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/ids.hpp"
#include "core/item_loop.hpp"
#include "core/linked_triangles.hpp"
#include "core/point.hpp"

namespace coastmesh {
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
// region 0. Edges that cannot be linked are left as boundary and listed in `conflicts`.
TriMesh linkTriangles(std::vector<Point> points, std::span<const std::array<VertexId, 3>> corners,
                      std::vector<EdgeConflict>& conflicts);

// One triangle around each vertex as the edge that starts there; a boundary edge where there is one. kNone for an
// unused vertex.
std::vector<EdgeRef> outgoingEdges(const TriMesh& mesh);

// The boundary as closed loops of vertices with the mesh to the left: outer loops counter-clockwise, holes clockwise.
// Every loop starts at its lexicographically least vertex; loops are sorted by that vertex. A loop passes a pinched
// vertex once for every fan of triangles there.
std::vector<std::vector<VertexId>> boundaryLoops(const TriMesh& mesh, const ItemLoop& loop = inOrder);

// One a vertex: 1 where a triangle has it as a corner.
std::vector<std::uint8_t> usedVertices(const TriMesh& mesh, const ItemLoop& loop = inOrder);

// A hash of coordinates and corners, in order. Equal meshes, bit for bit, give equal digests on every machine.
std::uint64_t digestOf(const TriMesh& mesh, std::uint64_t seed = 0, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
