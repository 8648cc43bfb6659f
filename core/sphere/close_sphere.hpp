#pragma once

#include <cstdint>
#include <vector>

#include "core/point.hpp"
#include "core/surface.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// The part of a whole sphere that a mesh omits while it is made: the point at infinity of the plane, and the triangles
// between it and the edges of a ring.
struct SphereCap {
  Point apex;               // so far from the origin that it cannot be distinguished from that point
  std::vector<Point> ring;  // counter-clockwise around the origin, convex; the mesh is to its left

  bool empty() const { return ring.empty(); }
};

// The place of that apex. REQUIRES: the surface is curved.
Point antipodeOf(const Surface& surface);

// A regular ring whose corners are at this distance from the apex, along chords of the surface. REQUIRES: the surface
// is curved, the distance is above 0 and less than its diameter, and there are at least three corners.
SphereCap sphereCap(const Surface& surface, double distance, unsigned corners);
// A ring with the corners of a lattice around its pole.
SphereCap sphereCap(const Surface& surface, std::vector<Point> ring);

// Freezes the edges of the ring, which bound the mesh. REQUIRES: the ring's corners are the mesh's vertices from
// `first` on, in its order.
void freezeRing(TriMesh& mesh, VertexId first, const SphereCap& cap);

// Inserts the apex and its triangles, each with the region of the triangle beyond the ring. The apex is the last
// vertex; no edge is frozen afterwards. The orientation of the new triangles in the plane has no meaning: they are
// counter-clockwise on the sphere. REQUIRES: as above, and edges as `freezeRing` left them.
void closeSphere(TriMesh& mesh, VertexId first, const SphereCap& cap);

// True if the mesh is not empty and every edge has two triangles.
bool isClosed(const TriMesh& mesh);

// Vertices in use minus edges plus triangles: 2 for a whole sphere.
std::int64_t eulerNumber(const TriMesh& mesh);

}  // namespace coastmesh
