#include "gis/repair/repair_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/metric.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/elements/quads.hpp"
#include "gis/grid/linked_grid.hpp"
#include "gis/grid/local_plane.hpp"

namespace coastmesh {
namespace {

constexpr double kUnmeasured = std::numeric_limits<double>::quiet_NaN();

// Forgets the failed attempts whose search would reach a changed triangle.
void forgetNear(RepairState& state) {
  const Grid& grid = state.grid;
  std::vector<bool> is_near(grid.nodes.size(), false);
  std::vector<std::uint32_t> near;
  const auto addCorners = [&](std::uint32_t t) {
    for (const std::uint32_t node : grid.triangles[t]) {
      if (is_near[node]) continue;
      is_near[node] = true;
      near.push_back(node);
    }
  };
  for (std::uint32_t t = 0; t < state.disturbed.size(); ++t)
    if (state.disturbed[t]) addCorners(t);
  std::size_t grown = 0;
  const auto grow = [&] {
    const std::size_t end = near.size();
    for (; grown < end; ++grown)
      for (const std::uint32_t t : state.links.triangles_at[near[grown]]) addCorners(t);
  };
  const auto forget = [&](std::vector<bool>& flags) {
    for (const std::uint32_t node : near)
      for (const std::uint32_t t : state.links.triangles_at[node]) flags[t] = false;
  };
  forget(state.stuck);
  grow();
  grow();
  forget(state.hopeless_triangles);
  forget(state.hopeless_advice);
  grow();
  for (const std::uint32_t node : near) state.hopeless_nodes[node] = false;
}

// Computes `metres_per_unit` of new and changed triangles, from their shortest edge.
void measureGround(RepairState& state) {
  const Grid& grid = state.grid;
  state.metres_per_unit.resize(grid.triangles.size(), kUnmeasured);
  std::vector<std::size_t> which;
  std::vector<GridCorners> corners;  // by `nodes`
  std::vector<Point> nodes;
  std::vector<std::uint32_t> index(grid.nodes.size(), kNone);
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    if (!std::isnan(state.metres_per_unit[t]) && !state.disturbed[t]) continue;
    which.push_back(t);
    GridCorners& v = corners.emplace_back(grid.triangles[t]);
    for (std::uint32_t& node : v) {
      if (index[node] == kNone) {
        index[node] = static_cast<std::uint32_t>(nodes.size());
        nodes.push_back(grid.nodes[node]);
      }
      node = index[node];
    }
  }
  const std::vector<std::array<double, 3>> lengths = edgeLengths(nodes, corners, grid.crs);
  for (std::size_t k = 0; k < which.size(); ++k) {
    std::array<Point, 3> p;
    for (unsigned i = 0; i < 3; ++i) p[i] = nodes[corners[k][i]];
    flattenLocally(grid.crs, p, state.shape());
    const auto shortest = std::ranges::min_element(lengths[k]);
    const auto i = static_cast<unsigned>(shortest - lengths[k].begin());
    state.metres_per_unit[which[k]] = *shortest / distance(p[i], p[next3(i)]);
  }
}

// Takes over the failed attempts of `memory` if the mesh has the same size. Those at nodes whose depth has changed
// since are to be repeated.
void recall(const RepairMemory& memory, RepairState& state) {
  const Grid& grid = state.grid;
  if (memory.stuck.size() != grid.triangles.size() || memory.z.size() != grid.z.size()) return;
  state.stuck = memory.stuck;
  const auto isOther = [&](std::uint32_t node) {
    return !(memory.z[node] == grid.z[node] || (std::isnan(memory.z[node]) && std::isnan(grid.z[node])));
  };
  for (std::size_t t = 0; t < grid.triangles.size(); ++t)
    state.disturbed[t] = !grid.z.empty() && std::ranges::any_of(grid.triangles[t], isOther);
}

// The values by new index; `none` for items added since.
template <typename T>
std::vector<T> renumbered(const std::vector<T>& values, const std::vector<std::uint32_t>& index_of, std::size_t count,
                          T none) {
  std::vector<T> kept(count, none);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (index_of[i] != kNone) kept[index_of[i]] = values[i];
  return kept;
}

}  // namespace

bool RepairState::anyTaken(std::span<const std::uint32_t> triangles) const {
  return std::ranges::any_of(triangles, [this](std::uint32_t t) { return isTaken(t); });
}

void addRepair(RepairState& state, const FoundDefect& found, const Point& place, std::string what, bool splits_edge) {
  state.report.repairs.push_back({found.defect.kind, found.target, place, std::move(what), splits_edge});
}

void startRepairs(RepairState& state, const RepairMemory* memory) {
  state.changed.assign(state.grid.triangles.size(), false);
  state.hopeless_triangles = state.hopeless_advice = state.disturbed = state.stuck = state.changed;
  state.hopeless_nodes.assign(state.grid.nodes.size(), false);
  const Crs& crs = state.grid.crs;
  if (std::ranges::count(state.targets, Target::Mpas) > 0 && isProjectedForMpas(crs))
    state.to_earth.emplace(toOgr(crs), toOgr(wgs84()));
  if (memory != nullptr) recall(*memory, state);
}

RepairMemory memoryOf(const RepairState& state) {
  const Grid& grid = state.grid;
  RepairMemory memory{state.stuck, grid.z};
  std::vector<bool> near(grid.nodes.size(), false);
  for (std::size_t t = 0; t < grid.triangles.size(); ++t)
    if (state.disturbed[t])
      for (const std::uint32_t node : grid.triangles[t]) near[node] = true;
  for (std::size_t t = 0; t < grid.triangles.size(); ++t)
    if (std::ranges::any_of(grid.triangles[t], [&near](std::uint32_t node) { return near[node]; }))
      memory.stuck[t] = false;
  return memory;
}

void startRound(RepairState& state, TriMesh mesh) {
  const Grid& grid = state.grid;
  GridLinks& links = state.links;
  links.mesh = std::move(mesh);
  for (std::vector<std::uint32_t>& triangles : links.triangles_at) triangles.clear();  // they keep their memory
  links.triangles_at.resize(grid.nodes.size());
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t)
    for (const std::uint32_t node : grid.triangles[t]) links.triangles_at[node].push_back(t);
  flagBoundaryNodes(links, grid.nodes.size());
  links.line_edges.clear();
  for (const GridLine& line : grid.lines)
    for (const auto& [a, b] : edgesOf({BoundaryRole::Land, line.closed, line.nodes}))
      links.line_edges.insert(edgeKey(a, b));
  links.quad_edges = edgesOfQuads(grid);
  links.line_edges.insert(links.quad_edges.begin(), links.quad_edges.end());
  forgetNear(state);
  if (state.options.time_step_s > 0.0 || state.options.least_edge_m > 0.0) measureGround(state);
  for (std::vector<bool>* flags : {&state.touched, &state.dead, &state.disturbed})
    flags->assign(grid.triangles.size(), false);
  state.smallest_angle.assign(grid.triangles.size(), std::numeric_limits<double>::quiet_NaN());
  if (grid.crs.geographic)
    state.in_space.assign(grid.nodes.size(), SphereVector{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
  if (state.to_earth) state.on_earth.assign(grid.nodes.size(), Point{kUnmeasured, kUnmeasured});
  if (state.options.shore_moves) state.shores.emplace(state.view());
}

void startRound(RepairState& state) {
  startRound(state, state.targets.empty() ? TriMesh{} : linkGrid(state.grid, state.loop).mesh);
}

void compact(RepairState& state) {
  const std::vector<std::uint32_t> triangle_index = removeTriangles(state.grid, state.dead);
  for (std::vector<bool>* flags :
       {&state.changed, &state.disturbed, &state.hopeless_triangles, &state.hopeless_advice, &state.stuck})
    *flags = renumbered(*flags, triangle_index, state.grid.triangles.size(), false);
  state.metres_per_unit = renumbered(state.metres_per_unit, triangle_index, state.grid.triangles.size(), kUnmeasured);
  const std::vector<std::uint32_t> index = removeUnusedNodes(state.grid);
  state.hopeless_nodes = renumbered(state.hopeless_nodes, index, state.grid.nodes.size(), false);
  state.links.asked = renumbered(state.links.asked, index, state.grid.nodes.size(), false);
  BoundaryKinds kinds;
  for (const auto& [edge, kind] : state.links.kinds)
    if (index[edge[0]] != kNone && index[edge[1]] != kNone) kinds[edgeKey(index[edge[0]], index[edge[1]])] = kind;
  state.links.kinds = std::move(kinds);
}

}  // namespace coastmesh
