#include "gis/repair/repair_depths.hpp"

#include <cstdio>

namespace coastmesh {

void lowerDryOpening(RepairState& state, const FoundDefect& found) {
  const auto node = static_cast<std::uint32_t>(found.defect.node);
  Grid& grid = state.grid;
  double highest = 0.0;  // z of the shallowest neighbour below water; 0 if there is none yet
  for (const std::uint32_t t : state.links.triangles_at[node])
    for (const std::uint32_t other : grid.triangles[t])
      if (grid.z[other] < 0.0 && (highest == 0.0 || grid.z[other] > highest)) highest = grid.z[other];
  if (highest == 0.0) return;
  char text[80];
  std::snprintf(text, sizeof text, "node lowered from %.4g m above the water to %.4g m below", grid.z[node], -highest);
  grid.z[node] = highest;
  addRepair(state, found, grid.nodes[node], text);
}

}  // namespace coastmesh
