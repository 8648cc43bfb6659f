#pragma once

#include <optional>
#include <span>

#include "gis/repair_patch.hpp"

namespace coastmesh {

// An edge flipped, or split at a share of it.
struct Reshaping {
  PatchEdit edit;
  NodePair edge{};
  std::optional<double> split_at;
};

// The flip or split of an edge of `inside` that leaves the fewest defects in `patch`, that round it; among these the
// largest smallest angle. None where no edge leaves fewer.
std::optional<Reshaping> bestReshaping(const RepairView& view, std::span<const std::uint32_t> inside,
                                       const Patch& patch);

// The same of splitting an inner node in two: half of its triangles get a node of their own, between it and their
// other ends.
std::optional<PatchEdit> bestNodeSplit(const RepairView& view, std::uint32_t node, const Patch& patch);

}  // namespace coastmesh
