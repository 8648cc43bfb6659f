#pragma once

#include <span>
#include <vector>

#include "core/tri_mesh.hpp"

namespace coastmesh {

// Replaces an edge by the other diagonal of its two triangles, which keep their slots. The edge must have a triangle on both sides.
// Answers false where these make no convex quadrilateral.
bool flipEdge(std::span<const Point> points, std::span<Triangle> triangles, EdgeRef e);

// The same where that makes the edge Delaunay; answers false where it is so already.
bool flipToDelaunay(std::span<const Point> points, std::span<Triangle> triangles, EdgeRef e);

// Lawson's flips from the given edges on. Answers the triangles that changed, some of them several times.
std::vector<TriId> restoreDelaunay(TriMesh& mesh, std::vector<EdgeRef> edges);

}  // namespace coastmesh
