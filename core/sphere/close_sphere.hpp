#pragma once

#include <cstdint>
#include <vector>

#include "core/point.hpp"
#include "core/surface.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// What a mesh of a whole sphere leaves out while it is made: the place that lies beyond all of the plane, and triangles
// from there to the edges of a ring.
struct SphereCap {
  Point apex;               // as far from the origin as not to be told from that place
  std::vector<Point> ring;  // counter-clockwise round the origin, convex; the mesh lies to its left

  bool empty() const { return ring.empty(); }
};

// A regular ring whose corners lie at this distance from the apex, along chords of the surface. REQUIRES: the surface
// is curved, the distance above 0 and less than its diameter, three corners or more.
SphereCap sphereCap(const Surface& surface, double distance, unsigned corners);
// One with the corners of a lattice round its pole.
SphereCap sphereCap(const Surface& surface, std::vector<Point> ring);

// Makes the edges of the ring, which bound the mesh, edges that nothing may change. REQUIRES: the ring's corners are
// the mesh's vertices from `first` on, in its order.
void freezeRing(TriMesh& mesh, VertexId first, const SphereCap& cap);

// Puts the apex and its triangles in, each with the region of the triangle beyond the ring. The apex is the last
// vertex; no edge is frozen any more. What the plane says of the new triangles' orientation means nothing: they are
// counter-clockwise on the sphere. REQUIRES: as above, and edges as `freezeRing` left them.
void closeSphere(TriMesh& mesh, VertexId first, const SphereCap& cap);

// Whether no edge has one triangle alone.
bool isClosed(const TriMesh& mesh);

// Vertices that triangles use, less edges, and triangles: 2 of all of a sphere.
std::int64_t eulerNumber(const TriMesh& mesh);

}  // namespace coastmesh
