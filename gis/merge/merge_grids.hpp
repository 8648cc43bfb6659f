#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"
#include "gis/merge/lost_water.hpp"
#include "gis/merge/lost_weirs.hpp"

namespace coastmesh {

// Where a node or triangle of a merged grid comes from.
struct MergeSource {
  std::uint32_t mesh = kNone;    // 0: the grid, 1: the one that was put in; kNone: neither, it is new
  std::uint32_t number = kNone;  // there, from 0
};

// Where a land boundary of the inserted mesh stays closed, although it is hardly a shore (`frameSides`).
struct ClosedSides {
  double length_m = 0.0;  // plane units in a plane
  Point place;            // in the middle of one of its edges
};

struct MergeReport {
  std::vector<MergeSource> nodes, triangles;  // of each of the merged grid
  std::vector<std::uint8_t> of_both;          // 1 for each node of the merged grid that was one of both
  std::size_t covered = 0;                    // triangles of the grid that the other one replaces
  std::size_t cut_off = 0;                    // triangles of waters that only those connected to the rest: left out
  std::size_t gap = 0;                        // triangles between the two, the last of the merged grid
  std::size_t united = 0;                     // nodes of the grid that are nodes of the other one too
  std::size_t joined = 0;                     // edges of the other one's boundary with the grid's water beyond
  std::size_t joined_land = 0;                // of these, those of land boundaries: sides of a frame across land
  ClosedSides closed;
  std::vector<WeirGap> weir_gaps;  // in weirs of the grid
  std::size_t walls = 0;           // edges of its open boundaries that became land, without water beyond
  bool has_open = true;            // false: it has no open boundary, and joins all around
  bool partition_dropped = false;  // the assignment to processes
  LostWater lost;                  // of the grid
  Grid gone;  // the grid's triangles that are not in the merged one, with the depths of their nodes
};

// Puts another mesh into a grid, in place of the triangles that it covers. Its outer outline with all that is inside
// belongs to it, islands included; it joins the grid along its open boundaries and sides of its frame across land
// (`frameSides`), or all around if it has no open ones. The gap between both is filled with triangles between their
// nodes, as far as the grid has water there: they are to be meshed anew (`remeshGrid`). All others stay bit for bit;
// nodes of the grid within a hundredth of an edge of nodes of the outline become these. Boundaries keep their types:
// those of the grid where it is left, those of the other one but for open ones that are joined. New ones beside an open
// boundary are open, all others are land. `inserted` is in the grid's CRS. Throws InputError if the two do not meet, or
// nothing of the grid is left; for clockwise triangles where they meet.
MergeReport mergeGrids(Grid& grid, Grid&& inserted, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
