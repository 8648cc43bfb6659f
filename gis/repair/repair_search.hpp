#pragma once

#include <optional>
#include <span>

#include "gis/repair/repair_patch.hpp"

namespace coastmesh {

// The best edit is that which leaves the fewest defects in `patch`; among these the largest smallest angle. None where
// each leaves as many as there are.

// What is tried.
struct SearchReach {
  std::span<const double> shares;          // at which edges are split
  std::span<const std::uint32_t> movable;  // nodes that are moved a little
};

// A node moved, or an edge of `inside` flipped or split. REQUIRES: the patch is that round `inside` and the triangles
// of the movable nodes.
std::optional<PatchEdit> bestReshaping(const RepairView& view, std::span<const std::uint32_t> inside,
                                       const SearchReach& reach, const GridPatch& patch);

// For a triangle that leaves too short a time step: a node moved, or one of its edges collapsed. REQUIRES: the patch is
// that round the triangles at the movable nodes and at the triangle's own.
std::optional<PatchEdit> bestLengthening(const RepairView& view, std::uint32_t t,
                                         std::span<const std::uint32_t> movable, const GridPatch& patch);

// Whether nothing but the triangles at its corners says if there is a lengthening of a triangle: not where shores,
// edges or nodes count that other triangles share, or where triangles of the patch have turned over.
bool mendsByCornersAlone(const RepairView& view, const GridPatch& patch);

// For a triangle with a small angle: the move, flip or collapse that leaves the largest smallest angle in what it
// changes, and no defect more. REQUIRES: as above.
std::optional<PatchEdit> bestRelaxing(const RepairView& view, std::uint32_t t, std::span<const std::uint32_t> movable,
                                      const GridPatch& patch);

// An inner node split in two: half of its triangles get a node of their own, between it and their
// other ends.
std::optional<PatchEdit> bestNodeSplit(const RepairView& view, std::uint32_t node, const GridPatch& patch);

}  // namespace coastmesh
