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

// The edges between the land of a flood plain and the water, where a coast that is no line of edges is, to within a
// triangle. Empty for a mesh without the attribute that tells them apart.
std::vector<NodePair> coastEdges(const Grid& grid, const TriMesh& mesh);

// Edges of the shore or the coast in the plane of a part of the grid, as far from the part as sizes at the shore reach.
// Sizes in the part follow from them even if the part itself has no shore.
Pslg edgesNear(const Grid& grid, std::span<const NodePair> edges, const Domain& part, const SizeOptions& sizes);

}  // namespace coastmesh
