#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/cut/even_cut.hpp"
#include "gis/cut/tidy_cut.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

struct CutOptions {
  BoundaryRole cut_role = BoundaryRole::Open;  // of boundaries along the cut: Open or Land
  bool largest_water = false;                  // of the waters that the cut leaves, only the largest by area is kept
};

struct CutReport {
  std::vector<std::uint32_t> nodes, triangles;  // of each node and triangle: its number in the grid before, from 0
  std::size_t nodes_before = 0, triangles_before = 0;
  EvenedCut evened;
  TidiedCut tidied;
  std::size_t waters = 0;           // not connected with one another, among what was wanted
  std::size_t left_out = 0;         // of them, the waters left out
  std::size_t boundaries_kept = 0;  // boundaries of the grid, or parts of them
  std::size_t boundaries_cut = 0;   // along the cut
  std::size_t walls = 0;            // shores of weirs without the shore across: land
  std::size_t stray_edges = 0;      // edges of boundaries that were not on the mesh's: left out
  bool partition_dropped = false;   // the assignment to processes, which is of the whole mesh
};

// Keeps the triangles with a flag in `taken`, and their nodes, in their order and with all their values bit for bit.
// The edge of the cut is made even first, so that models reject neither them nor the rest (`evenCut`): a part and the
// rest fit, wherever the cut is. If that leaves one of them nothing, the part is tidied alone (`tidyCut`). Boundaries
// are divided where they lose edges (`boundariesOfPart`); those along the cut come last. REQUIRES: one flag for each
// triangle, at least one of them set.
CutReport cutGrid(Grid& grid, std::vector<std::uint8_t> taken, const CutOptions& options = {},
                  const ItemLoop& loop = inOrder);

}  // namespace coastmesh
