#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// The boundaries of a part of a grid, in the numbers of the whole.
struct CutBoundaries {
  std::vector<Boundary> kept;   // what remains of the grid's, in their order and with their types
  std::vector<Boundary> walls;  // shores of weirs that lost the shore across: land
  std::vector<Boundary> cuts;   // where triangles were cut from one another
  std::size_t stray_edges = 0;  // edges of the grid's boundaries that its mesh does not end at: left out
};

// A part of a closed island is no island: it becomes land, of the mainland's type.
void asPartOfShore(Boundary& piece);

// Boundaries keep their direction and, if they are whole, all else. One that loses edges is divided there; an island
// then becomes land. Weirs keep what both shores are left of. `cut_role` is Open or Land; land all around is an island
// if its shape says so. `taken` has one flag for each triangle; `mesh` is the grid's, from `linkGrid`.
CutBoundaries boundariesOfPart(const Grid& grid, const TriMesh& mesh, const std::vector<std::uint8_t>& taken,
                               BoundaryRole cut_role, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
