#pragma once

#include <optional>

#include "gis/geometry/box_tree.hpp"
#include "gis/repair/repair_patch.hpp"

namespace coastmesh {

// Edits that move the shore of a grid, or take nodes out of it.

// Where shores lie, so that they do not come too near to one another.
class ShoreIndex {
 public:
  explicit ShoreIndex(const RepairView& view);

  // Whether the edges of the boundary that the edit makes or moves keep away from all others by half of their lengths,
  // or are no nearer to them than before.
  bool keepsApart(const RepairView& view, const PatchEdit& edit) const;

 private:
  std::vector<NodePair> edges_;
  BoxTree tree_;
};

// The node `gone` taken to its neighbour `kept`, which goes `share` of the way towards it. None where an end may not
// move, or the mesh would not stay one.
std::optional<PatchEdit> collapseOf(const RepairView& view, std::uint32_t gone, std::uint32_t kept, double share);

}  // namespace coastmesh
