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

// The boundary loops of the mesh: the counter-clockwise loop around each connected piece is land, the others are
// islands.
std::vector<Boundary> findBoundaries(const TriMesh& mesh, const ItemLoop& loop = inOrder);

// Gives a grid without boundaries the boundary loops of its mesh.
void findMissingBoundaries(Grid& grid);

// The edges of a boundary, in its direction.
std::vector<NodePair> edgesOf(const Boundary& boundary);

// Keeps edges on the boundary (with one triangle) and directs them so that the triangle lies to the left. Returns edges
// with triangles on both sides, group by group, unchanged.
std::vector<std::vector<NodePair>> keepBoundaryEdges(std::span<const std::array<std::uint32_t, 3>> triangles,
                                                     std::vector<std::vector<NodePair>>& edge_groups);

// Joins directed edges end to end into boundaries of role Open; edges that follow one another in `edges` stay together.
// Open chains come first.
std::vector<Boundary> chainEdges(std::span<const NodePair> edges);

// The number of a boundary in formats that have a single one: ten times its number, counted from 1, plus 1 for land, 2
// for an island, 3 for open water, 4 for a river.
std::int64_t boundaryMarker(std::size_t index, BoundaryRole role);
std::optional<BoundaryRole> roleOfMarker(std::int64_t marker, std::size_t index);  // nullopt: not its marker

// The same for a line: plus 5 for a constraint, 6 for a weir, 7 for a region's border. The numbers of lines continue
// those of the boundaries.
std::int64_t lineMarker(std::size_t index, LineKind kind);
std::optional<LineKind> lineKindOfMarker(std::int64_t marker, std::size_t index);

}  // namespace coastmesh
