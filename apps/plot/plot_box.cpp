#include "apps/plot/plot_box.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace coastmesh {

namespace {

constexpr double kTurnDeg = 360.0;

// The extent of a triangle. In degrees, its nodes are taken within half a turn of the first one.
PlotBox extentOf(const Grid& grid, std::uint32_t t) {
  const auto& corners = grid.triangles[t];
  const Point& first = grid.nodes[corners[0]];
  PlotBox extent{first.x, first.y, first.x, first.y};
  for (const std::uint32_t node : corners) {
    Point p = grid.nodes[node];
    if (grid.crs.geographic) p.x -= kTurnDeg * std::round((p.x - first.x) / kTurnDeg);
    extent = {std::min(extent[0], p.x), std::min(extent[1], p.y), std::max(extent[2], p.x), std::max(extent[3], p.y)};
  }
  return extent;
}

// True if the extents overlap; in degrees, after any number of turns.
bool overlap(const PlotBox& extent, const PlotBox& box, bool in_degrees) {
  // The smallest number of turns that puts the extent's east beyond the box's west.
  const double turned = in_degrees ? kTurnDeg * std::ceil((box[0] - extent[2]) / kTurnDeg) : 0.0;
  return extent[2] + turned >= box[0] && extent[0] + turned <= box[2] && extent[3] >= box[1] && extent[1] <= box[3];
}

}  // namespace

std::vector<std::uint32_t> trianglesIn(const Grid& grid, const std::optional<PlotBox>& box) {
  std::vector<std::uint32_t> shown;
  if (!box) {
    shown.resize(grid.triangles.size());
    std::iota(shown.begin(), shown.end(), 0u);
    return shown;
  }
  constexpr double kReach = 0.3;  // of the box's sides
  const auto& [west, south, east, north] = *box;
  const double reach_x = kReach * (east - west), reach_y = kReach * (north - south);
  const PlotBox around{west - reach_x, south - reach_y, east + reach_x, north + reach_y};
  bool any = false;  // in the box itself
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) {
    const PlotBox extent = extentOf(grid, t);
    if (!overlap(extent, around, grid.crs.geographic)) continue;
    any = any || overlap(extent, *box, grid.crs.geographic);
    shown.push_back(t);
  }
  if (!any) shown.clear();
  return shown;
}

}  // namespace coastmesh
