#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/ids.hpp"
#include "core/item_loop.hpp"
#include "core/linked_triangles.hpp"
#include "core/point.hpp"

namespace coastmesh {
// A compact triangle mesh: every triangle is valid; points may be unused if the input has points outside the domain.
struct TriMesh : LinkedTriangles {
  // The first `input_vertices` points are the PSLG's, in its order, bit for bit; Steiner points follow.
  BulkList<Point> points;
  BulkList<RegionId> regions;  // for each triangle: its feature
  VertexId input_vertices = 0;

  const Point& point(VertexId v) const { return points[v]; }
};

// An edge claimed by more than two triangles, or by two of opposite orientation.
struct EdgeConflict {
  VertexId a = kNone;
  VertexId b = kNone;
};

// Links triangles given by their corners (in any rotation, counter-clockwise) into a mesh without constraints, all in
// region 0. Edges that cannot be linked become boundary and are listed in `conflicts`.
TriMesh linkTriangles(BulkList<Point> points, std::span<const std::array<VertexId, 3>> corners,
                      std::vector<EdgeConflict>& conflicts, const ItemLoop& loop = inOrder);

// For each vertex one edge that starts there; a boundary edge if there is one. kNone for an unused vertex.
std::vector<EdgeRef> outgoingEdges(const TriMesh& mesh);

// The boundary as closed loops of vertices with the mesh to the left: outer loops counter-clockwise, holes clockwise.
// Every loop starts at its lexicographically least vertex; loops are sorted by that vertex. A loop passes a pinched
// vertex once for every fan of triangles there.
std::vector<std::vector<VertexId>> boundaryLoops(const TriMesh& mesh, const ItemLoop& loop = inOrder);

// For each vertex: 1 if it is the corner of a triangle.
BulkList<std::uint8_t> usedVertices(const TriMesh& mesh, const ItemLoop& loop = inOrder);

// A hash of coordinates and corners, in order. Equal meshes, bit for bit, give equal digests on every machine.
std::uint64_t digestOf(const TriMesh& mesh, std::uint64_t seed = 0, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
