#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "gis/check/target_defect.hpp"
#include "gis/grid/grid.hpp"
#include "gis/model/target.hpp"

namespace coastmesh {

// The edges of the mesh with a triangle on one side, ascending.
std::vector<EdgeRef> boundaryEdges(const TriMesh& mesh, const ItemLoop& loop = inOrder);

// Compares the grid's boundaries with the boundary edges of its mesh: StrayBoundary, BoundaryTwice and NoBoundary; for
// ADCIRC and SCHISM, which read segments of nodes, also BoundaryTurned, WrongShore and LoopedBoundary.
std::vector<TargetDefect> checkSegments(const Grid& grid, const TriMesh& mesh, std::span<const EdgeRef> boundary_edges,
                                        std::optional<Target> target, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
