#include "gis/repair/repair_winding.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <span>

#include "core/predicates.hpp"
#include "core/quality.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/repair/repair_shape.hpp"

namespace coastmesh {
namespace {

int orientationOf(const Grid& grid, const GridCorners& corners) {
  const auto p = localPlane(grid, corners);
  return orient2d(p[0], p[1], p[2]);
}

// The other triangles with both ends of the edge, in either direction.
std::vector<std::uint32_t> othersAt(const RepairState& state, std::uint32_t t, std::uint32_t a, std::uint32_t b) {
  std::vector<std::uint32_t> others;
  for (const std::uint32_t other : state.links.triangles_at[a])
    if (other != t && !state.dead[other] && std::ranges::count(state.grid.triangles[other], b) > 0)
      others.push_back(other);
  return others;
}

// True if two triangles at an edge lie on the same side of it.
bool liesOver(const Grid& grid, std::uint32_t t, std::uint32_t other, std::uint32_t a, std::uint32_t b) {
  std::array<std::uint32_t, 4> nodes{a, b, a, a};
  for (const std::uint32_t node : grid.triangles[t])
    if (node != a && node != b) nodes[2] = node;
  for (const std::uint32_t node : grid.triangles[other])
    if (node != a && node != b) nodes[3] = node;
  const auto p = localPlane(grid, nodes);
  return orient2d(p[0], p[1], p[2]) * orient2d(p[0], p[1], p[3]) > 0;
}

// Clockwise triangles connected by edges.
struct Piece {
  std::vector<std::uint32_t> triangles;
  bool folded = false;  // a neighbour overlaps one of them
};

Piece pieceFrom(const RepairState& state, std::uint32_t first, std::vector<bool>& waiting) {
  Piece piece{{first}};
  waiting[first] = false;
  for (std::size_t k = 0; k < piece.triangles.size(); ++k) {
    const std::uint32_t t = piece.triangles[k];
    const GridCorners& v = state.grid.triangles[t];
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t a = v[i], b = v[next3(i)];
      for (const std::uint32_t other : othersAt(state, t, a, b)) {
        piece.folded = piece.folded || liesOver(state.grid, t, other, a, b);
        if (!waiting[other]) continue;
        waiting[other] = false;
        piece.triangles.push_back(other);
      }
    }
  }
  return piece;
}

}  // namespace

void mendClockwise(RepairState& state, std::span<const FoundDefect> defects) {
  std::vector<bool> waiting(state.grid.triangles.size(), false);
  std::vector<const FoundDefect*> clockwise;
  for (const FoundDefect& found : defects) {
    if (found.defect.kind != TargetDefectKind::Clockwise) continue;
    const auto t = static_cast<std::uint32_t>(found.defect.triangle);
    if (orientationOf(state.grid, state.grid.triangles[t]) == 0) continue;
    waiting[t] = true;
    clockwise.push_back(&found);
  }
  std::vector<bool> turns(waiting.size(), false);
  for (const FoundDefect* found : clockwise) {
    const auto t = static_cast<std::uint32_t>(found->defect.triangle);
    if (!waiting[t]) continue;
    const Piece piece = pieceFrom(state, t, waiting);
    for (const std::uint32_t of_piece : piece.triangles) turns[of_piece] = !piece.folded;
  }
  for (const FoundDefect* found : clockwise) {
    const auto t = static_cast<std::uint32_t>(found->defect.triangle);
    if (!turns[t]) {
      unfoldTriangle(state, *found);
      continue;
    }
    GridCorners& corners = state.grid.triangles[t];
    std::swap(corners[1], corners[2]);
    state.changed[t] = state.disturbed[t] = true;
    addRepair(state, *found, state.grid.nodes[corners[0]], "triangle turned");
  }
}

bool dropCopies(RepairState& state, std::span<const FoundDefect> defects) {
  const std::span<const GridCorners> triangles = state.grid.triangles;
  std::vector<GridCorners> key(triangles.begin(), triangles.end());
  for (GridCorners& corners : key) std::ranges::sort(corners);
  std::vector<std::uint32_t> order(key.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t t) { return key[t]; });
  std::vector<bool> gone(key.size(), false);
  bool any = false;
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && key[order[end]] == key[order[first]]) ++end;
    if (end - first == 1) continue;
    const auto copies = std::span(order).subspan(first, end - first);
    const auto stands = [&](std::uint32_t t) { return orientationOf(state.grid, triangles[t]) > 0; };
    const auto standing = std::ranges::find_if(copies, stands);
    const std::uint32_t kept = standing == copies.end() ? copies.front() : *standing;
    for (const std::uint32_t t : copies) gone[t] = t != kept;
    FoundDefect found = defects.front();
    found.defect.kind = TargetDefectKind::BrokenEdge;
    for (std::size_t k = 1; k < copies.size(); ++k)
      addRepair(state, found, state.grid.nodes[triangles[kept][0]], "copy of a triangle removed");
    any = true;
  }
  if (any) removeTriangles(state.grid, gone);
  return any;
}

}  // namespace coastmesh
