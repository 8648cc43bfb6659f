#pragma once

#include <algorithm>
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

// The key of an edge in either direction: its lesser node first.
inline NodePair edgeKey(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

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

}  // namespace coastmesh
