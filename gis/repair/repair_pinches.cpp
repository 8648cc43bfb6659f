#include "gis/repair/repair_pinches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <set>

#include "gis/elements/quads.hpp"
#include "gis/grid/local_plane.hpp"

namespace coastmesh {
namespace {

constexpr double kMoveApart = 0.05;  // share of the way to the mean of the fan's corners

using Fan = std::vector<std::uint32_t>;

// The triangles around a node as fans connected by edges, the largest first.
std::vector<Fan> fansAt(const GridLinks& links, std::uint32_t node) {
  std::vector<Fan> fans;
  std::set<std::uint32_t> left(links.triangles_at[node].begin(), links.triangles_at[node].end());
  while (!left.empty()) {
    Fan& fan = fans.emplace_back();
    fan.push_back(*left.begin());
    left.erase(left.begin());
    for (std::size_t k = 0; k < fan.size(); ++k) {
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef twin = links.mesh.triangles[fan[k]].adj[i];
        if (twin == kNone || links.mesh.triangles[fan[k]].v[i] == node) continue;
        if (left.erase(triOf(twin)) > 0) fan.push_back(triOf(twin));
      }
    }
  }
  std::ranges::stable_sort(fans, std::greater(), [](const Fan& fan) { return fan.size(); });
  return fans;
}

// Moves the kinds of the fan's boundary edges at `node` to those at `twin`.
void moveKinds(GridLinks& links, const Fan& fan, std::uint32_t node, std::uint32_t twin) {
  for (const std::uint32_t t : fan) {
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t a = links.mesh.origin(edgeRef(t, i)), b = links.mesh.target(edgeRef(t, i));
      if (links.mesh.triangles[t].adj[i] != kNone || (a != node && b != node)) continue;
      const std::uint32_t other = a == node ? b : a;
      links.kinds[edgeKey(twin, other)] = links.kinds[edgeKey(node, other)];
      links.kinds.erase(edgeKey(node, other));
    }
  }
}

std::string distanceText(const Crs& crs, const Point& from, const Point& to) {
  const std::vector<Point> plane = localPlane(crs, std::array{from, to});
  char text[40];
  std::snprintf(text, sizeof text, "%.3g", std::hypot(plane[1].x - plane[0].x, plane[1].y - plane[0].y));
  return std::string(text) + (crs.geographic ? " m" : "");
}

}  // namespace

void doublePinchedNode(RepairState& state, const FoundDefect& found) {
  const auto node = static_cast<std::uint32_t>(found.defect.node);
  Grid& grid = state.grid;
  if (state.anyTaken(state.links.triangles_at[node])) return;
  const std::vector<Fan> fans = fansAt(state.links, node);
  for (std::size_t f = 1; f < fans.size(); ++f) {
    const Point place = grid.nodes[node];
    std::vector<Point> corners;
    for (const std::uint32_t t : fans[f])
      for (const std::uint32_t corner : grid.triangles[t]) corners.push_back(grid.nodes[corner]);
    const Point apart = placeBetween(grid.crs, place, meanPlace(grid.crs, corners), kMoveApart);
    const std::uint32_t twin = detachTriangles(grid, node, fans[f], apart);
    moveKinds(state.links, fans[f], node, twin);
    addRepair(state, found, place,
              "node duplicated and moved apart by " + distanceText(grid.crs, place, grid.nodes[twin]));
  }
  for (const std::uint32_t t : state.links.triangles_at[node])
    state.touched[t] = state.changed[t] = state.disturbed[t] = true;
}

void takeOutOrphan(RepairState& state, const FoundDefect& found) {
  const auto t = static_cast<std::uint32_t>(found.defect.triangle);
  std::vector<std::uint32_t> halves{t};
  const bool may_be_half = !state.grid.quad_of.empty() && state.grid.quad_of[t] != kNone;
  for (const Quad& quad : may_be_half ? quadsOf(state.grid) : std::vector<Quad>())
    if (std::ranges::count(quad.halves, t) > 0) halves.assign(quad.halves.begin(), quad.halves.end());
  if (state.anyTaken(halves) || state.grid.triangles.size() <= halves.size()) return;
  for (const std::uint32_t half : halves) {
    state.touched[half] = state.dead[half] = true;
    const GridCorners& v = state.grid.triangles[half];
    for (unsigned i = 0; i < 3; ++i) state.links.kinds.erase(edgeKey(v[i], v[next3(i)]));
  }
  addRepair(state, found, state.grid.nodes[state.grid.triangles[t][0]],
            halves.size() == 1 ? "triangle removed" : "quadrilateral removed");
}

}  // namespace coastmesh
