#pragma once

#include <optional>

#include "gis/geometry/box_tree.hpp"
#include "gis/repair/repair_patch.hpp"

namespace coastmesh {

// Edits that move the shore of a grid, or remove nodes of it.

// The shores, to keep them from getting too close to one another.
class ShoreIndex {
 public:
  explicit ShoreIndex(const RepairView& view);

  // Whether the boundary edges that the edit makes or moves keep half of their lengths from all others, or are no
  // closer to them than before.
  bool keepsApart(const RepairView& view, const PatchEdit& edit) const;

 private:
  std::vector<NodePair> edges_;
  BoxTree tree_;
};

// Collapses the node `gone` into its neighbour `kept`, which moves `share` of the way towards it. None if an end may
// not move, or the mesh would become invalid.
std::optional<PatchEdit> collapseOf(const RepairView& view, std::uint32_t gone, std::uint32_t kept, double share);

}  // namespace coastmesh
