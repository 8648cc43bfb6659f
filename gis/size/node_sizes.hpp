#pragma once

#include <functional>
#include <vector>

#include "core/item_loop.hpp"
#include "core/size_function.hpp"
#include "core/surface.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// The sizes wanted at a mesh's vertices, in metres: no two at the ends of an edge differ by more than `gradation` times
// its length, which takes away the last of what rounding and interpolation left. `measure` is length on `surface`, that
// the plane stands for, over metres at a vertex; it is called by several threads.
std::vector<double> nodeSizes(const TriMesh& mesh, const SizeFunction& size, double gradation,
                              const std::function<double(VertexId)>& measure, const Surface& surface = {},
                              const ItemLoop& loop = inOrder);

}  // namespace coastmesh
