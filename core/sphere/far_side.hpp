#pragma once

#include <vector>

#include "core/point.hpp"
#include "core/surface.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Initial vertices, as points in the plane, for a mesh whose input lies within one hemisphere while its domain holds
// the opposite one: a triangle larger than a hemisphere has short edges, and would be taken for a small one. They are
// on that side, and there is no such triangle with them. Empty for other meshes. REQUIRES: the surface is curved, and
// the mesh has no vertices but those of the input.
std::vector<Point> farSideVertices(const TriMesh& mesh, const Surface& surface);

}  // namespace coastmesh
