#pragma once

#include <functional>
#include <vector>

#include "core/item_loop.hpp"
#include "core/size_function.hpp"
#include "core/surface.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// The sizes at a mesh's vertices, in metres: those at the ends of an edge differ by at most `gradation` times its
// length, which removes the remaining errors of rounding and interpolation. `measure` is length on `surface`,
// represented by the plane, over metres at a vertex; it is called by several threads.
std::vector<double> nodeSizes(const TriMesh& mesh, const SizeFunction& size, double gradation,
                              const std::function<double(VertexId)>& measure, const Surface& surface = {},
                              const ItemLoop& loop = inOrder);

}  // namespace coastmesh
