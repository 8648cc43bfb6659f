#pragma once

#include <span>
#include <vector>

#include "core/pslg.hpp"
#include "core/tri_mesh.hpp"
#include "gis/clean/domain.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"
#include "gis/size/size_source.hpp"

namespace coastmesh {

// The shore of a grid: the edges where its mesh ends and is not open, with the mesh to the left. `mesh` is the grid's,
// from `linkGrid`.
std::vector<NodePair> shoreEdges(const Grid& grid, const TriMesh& mesh);

// The shore in the plane of a part of the grid, as far from the part as sizes at the shore reach. Sizes in the part
// follow from it even if the part itself has no shore.
Pslg shoreNear(const Grid& grid, std::span<const NodePair> shore, const Domain& part, const SizeOptions& sizes);

}  // namespace coastmesh
