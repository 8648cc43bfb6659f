#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

using NodePair = std::array<std::uint32_t, 2>;

// Loops as boundaries: the loop that goes counter-clockwise round each connected piece is land, the others islands.
std::vector<Boundary> findBoundaries(const TriMesh& mesh, const ItemLoop& loop = inOrder);

// Where a grid has no boundaries: those that its mesh has.
void findMissingBoundaries(Grid& grid);

// The edges of a boundary, in its direction.
std::vector<NodePair> edgesOf(const Boundary& boundary);

// Keeps what lies on the boundary (has a triangle on one side only) and turns it so that the triangle lies to the left.
// What has triangles on both sides is returned, group by group as it was.
std::vector<std::vector<NodePair>> keepBoundaryEdges(std::span<const std::array<std::uint32_t, 3>> triangles,
                                                     std::vector<std::vector<NodePair>>& edge_groups);

// Directed edges end to end as boundaries of role Open; `edges` that follow one another there stay together. Open
// chains come first.
std::vector<Boundary> chainEdges(std::span<const NodePair> edges);

// One number for a boundary in formats that have room for one: ten times its number, counted from 1, plus 1 for land,
// 2 for an island, 3 for open water, 4 for a river.
std::int64_t boundaryMarker(std::size_t index, BoundaryRole role);
std::optional<BoundaryRole> roleOfMarker(std::int64_t marker, std::size_t index);  // none: not that boundary's marker

// The same for a line: plus 5 for a constraint, 6 for a weir, 7 for a region's border. Lines are counted on after the
// boundaries.
std::int64_t lineMarker(std::size_t index, LineKind kind);
std::optional<LineKind> lineKindOfMarker(std::int64_t marker, std::size_t index);

}  // namespace coastmesh
