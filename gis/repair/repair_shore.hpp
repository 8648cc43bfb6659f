#pragma once

#include <optional>

#include "gis/geometry/box_tree.hpp"
#include "gis/repair/repair_patch.hpp"

namespace coastmesh {

// Edits that move nodes of a grid's boundary, or remove them.

// The boundary edges of a grid, to keep shores from getting too close to one another.
class ShoreIndex {
 public:
  explicit ShoreIndex(const RepairView& view);

  // True if the boundary edges that the edit makes or moves stay at least half of their lengths away from all others,
  // or get no closer to them. Of the next edge but one it is enough to stay nearly as far as the edge between is long.
  bool keepsApart(const RepairView& view, const PatchEdit& edit) const;

 private:
  std::vector<NodePair> edges_;
  BoxTree tree_;
};

// Collapses the node `gone` into its neighbour `kept`, which moves `share` of the way towards it. Returns nullopt if
// one of them would have to move but may not, or the mesh would become invalid.
std::optional<PatchEdit> collapseOf(const RepairView& view, std::uint32_t gone, std::uint32_t kept, double share);

// Removes a triangle with two boundary edges, open or shore; likewise the next one if that too would then have an open
// boundary edge besides the new one, or any for FESOM2, and so on. The new edge is shore if the triangle has any.
// Returns nullopt if there is no such corner, a node or edge that must stay would go, or many triangles would.
std::optional<PatchEdit> cornerCutOf(const RepairView& view, std::uint32_t t);

}  // namespace coastmesh
