#include "gis/repair/repair_state.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "core/metric.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/grid/local_plane.hpp"

namespace coastmesh {
namespace {

// What was tried in vain as near to a change as an attempt looks is worth another.
void forgetNear(RepairState& state) {
  const Grid& grid = state.grid;
  if (std::ranges::count(state.disturbed, true) == 0) return;
  std::vector<bool> near(grid.nodes.size(), false);
  for (std::size_t t = 0; t < state.disturbed.size(); ++t)
    if (state.disturbed[t])
      for (const std::uint32_t node : grid.triangles[t]) near[node] = true;
  const auto isNear = [&near](const GridCorners& corners) {
    return std::ranges::any_of(corners, [&near](std::uint32_t node) { return near[node]; });
  };
  const auto grow = [&] {
    std::vector<bool> wider = near;
    for (const GridCorners& corners : grid.triangles)
      if (isNear(corners))
        for (const std::uint32_t node : corners) wider[node] = true;
    near = std::move(wider);
  };
  grow();
  grow();
  for (std::size_t t = 0; t < grid.triangles.size(); ++t)
    if (isNear(grid.triangles[t])) state.hopeless_triangles[t] = false;
  grow();
  for (std::size_t node = 0; node < near.size(); ++node)
    if (near[node]) state.hopeless_nodes[node] = false;
}

// Lengths on the ground over those of planes that are flat at each triangle.
void measureGround(RepairState& state) {
  const Grid& grid = state.grid;
  const std::vector<std::array<double, 3>> lengths = edgeLengths(grid.nodes, grid.triangles, grid.crs);
  state.metres_per_unit.clear();
  for (std::size_t t = 0; t < lengths.size(); ++t) {
    const std::vector<Point> p = localPlane(grid, grid.triangles[t]);
    const auto shortest = std::ranges::min_element(lengths[t]);
    const auto i = static_cast<unsigned>(shortest - lengths[t].begin());
    state.metres_per_unit.push_back(*shortest / distance(p[i], p[next3(i)]));
  }
}

// Flags of what got another index; of what was added since, they are not set.
std::vector<bool> renumbered(const std::vector<bool>& flags, const std::vector<std::uint32_t>& index_of,
                             std::size_t count) {
  std::vector<bool> kept(count, false);
  for (std::size_t i = 0; i < flags.size(); ++i)
    if (index_of[i] != kNone) kept[index_of[i]] = flags[i];
  return kept;
}

}  // namespace

bool RepairState::anyTaken(std::span<const std::uint32_t> triangles) const {
  return std::ranges::any_of(triangles, [this](std::uint32_t t) { return isTaken(t); });
}

void addRepair(RepairState& state, const FoundDefect& found, const Point& place, std::string what) {
  state.report.repairs.push_back({found.defect.kind, found.target, place, std::move(what)});
}

void startRound(RepairState& state) {
  const Grid& grid = state.grid;
  GridLinks& links = state.links;
  std::vector<EdgeConflict> conflicts;
  links.mesh = linkTriangles(grid.nodes, grid.triangles, conflicts);
  links.triangles_at.assign(grid.nodes.size(), {});
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t)
    for (const std::uint32_t node : grid.triangles[t]) links.triangles_at[node].push_back(t);
  links.on_boundary.assign(grid.nodes.size(), false);
  for (const auto& [edge, kind] : links.kinds) links.on_boundary[edge[0]] = links.on_boundary[edge[1]] = true;
  links.line_edges.clear();
  for (const GridLine& line : grid.lines)
    for (const auto& [a, b] : edgesOf({BoundaryRole::Land, line.closed, line.nodes}))
      links.line_edges.insert(edgeKey(a, b));
  forgetNear(state);
  for (std::vector<bool>* flags : {&state.touched, &state.dead, &state.disturbed})
    flags->assign(grid.triangles.size(), false);
  state.smallest_angle.assign(grid.triangles.size(), std::numeric_limits<double>::quiet_NaN());
  if (state.options.time_step_s > 0.0) measureGround(state);
  if (state.options.shore_moves) state.shores.emplace(state.view());
}

void compact(RepairState& state) {
  const std::vector<std::uint32_t> triangle_index = removeTriangles(state.grid, state.dead);
  for (std::vector<bool>* flags : {&state.changed, &state.disturbed, &state.hopeless_triangles})
    *flags = renumbered(*flags, triangle_index, state.grid.triangles.size());
  const std::vector<std::uint32_t> index = removeUnusedNodes(state.grid);
  state.hopeless_nodes = renumbered(state.hopeless_nodes, index, state.grid.nodes.size());
  BoundaryKinds kinds;
  for (const auto& [edge, kind] : state.links.kinds)
    if (index[edge[0]] != kNone && index[edge[1]] != kNone) kinds[edgeKey(index[edge[0]], index[edge[1]])] = kind;
  state.links.kinds = std::move(kinds);
}

}  // namespace coastmesh
