#pragma once

#include <optional>
#include <span>

#include "gis/model/repair_patch.hpp"

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
                                       const SearchReach& reach, const Patch& patch);

// An inner node split in two: half of its triangles get a node of their own, between it and their
// other ends.
std::optional<PatchEdit> bestNodeSplit(const RepairView& view, std::uint32_t node, const Patch& patch);

}  // namespace coastmesh
