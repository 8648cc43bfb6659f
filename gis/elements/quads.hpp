#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// A quadrilateral of a grid: two triangles with one number in `Grid::quad_of` that share an edge, its diagonal.
struct Quad {
  std::array<std::uint32_t, 2> halves;  // triangles, ascending
  // Around it, in the direction of the halves; the first is the first corner of the first half.
  std::array<std::uint32_t, 4> nodes;
};

// All of them, by their first halves.
std::vector<Quad> quadsOf(const Grid& grid);

// Appends a triangle, or a quadrilateral as two triangles, with `nodes` around it in either direction. Of the two
// diagonals, that with the larger smallest angle on the ground is taken, if both halves have one direction with it;
// equal ones start at the first node, so that the element is written as it was read. A fourth node that repeats the
// third or the first is left out. REQUIRES: three or four nodes, which the grid has.
void addElement(Grid& grid, std::span<const std::uint32_t> nodes);

// For each triangle the side that is a diagonal of a quadrilateral, numbered by the corner opposite to it as in
// `edgeRef`; kNoDiagonal if it has none. Empty if the grid has no quadrilateral.
inline constexpr std::uint8_t kNoDiagonal = 3;
std::vector<std::uint8_t> diagonalsOf(const Grid& grid);

// The diagonals of all quadrilaterals, by `edgeKey`, ascending.
std::vector<NodePair> diagonalEdges(const Grid& grid);

// The four sides and the diagonal of each quadrilateral, by `edgeKey`, ascending, each once.
std::vector<NodePair> edgesOfQuads(const Grid& grid);

// Degrees: the angles at the nodes of a quadrilateral, more than 180 at a reflex one.
std::array<double, 4> anglesOf(const Grid& grid, const Quad& quad);

// For each triangle the other half of its quadrilateral, kNone if it is none. Empty if the grid has no quadrilateral.
std::vector<std::uint32_t> otherHalves(const Grid& grid);

// Flags of triangles: each is set for both halves of a quadrilateral if it is set for one.
void includeOtherHalves(const Grid& grid, std::vector<std::uint8_t>& chosen);

// The nodes of a grid, and its triangles that are no halves; nothing else.
Grid trianglesOnly(const Grid& grid);

}  // namespace coastmesh
