#include "gis/repair/repair_shore.hpp"

#include <cmath>
#include <iterator>
#include <limits>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "gis/grid/local_plane.hpp"

namespace coastmesh {
namespace {

constexpr double kApart = 0.5;        // share of an edge's length
constexpr double kAlong = 0.9;        // share of the length of the edge between two along the shore
constexpr double kSame = 1.0 - 1e-6;  // share of an unchanged distance: local planes round it

// Edges that touch or are in line do not cross: the least distance of an end is right for them.
bool crosses(const std::array<Point, 4>& p) {
  return orient2d(p[0], p[1], p[2]) * orient2d(p[0], p[1], p[3]) < 0 &&
         orient2d(p[2], p[3], p[0]) * orient2d(p[2], p[3], p[1]) < 0;
}

// The distance between two edges, p[0] to p[1] and p[2] to p[3], in a plane; 0 if they cross.
double apart(const std::array<Point, 4>& p) {
  if (crosses(p)) return 0.0;
  return std::sqrt(std::min({squaredDistanceToSegment(p[0], p[2], p[3]), squaredDistanceToSegment(p[1], p[2], p[3]),
                             squaredDistanceToSegment(p[2], p[0], p[1]), squaredDistanceToSegment(p[3], p[0], p[1])}));
}

}  // namespace

ShoreIndex::ShoreIndex(const RepairView& view) {
  std::vector<Box> boxes;
  for (const auto& [edge, kind] : view.links.kinds) {
    edges_.push_back(edge);
    boxes.push_back(Box::of(view.grid.nodes[edge[0]], view.grid.nodes[edge[1]]));
  }
  if (!boxes.empty()) tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
}

bool ShoreIndex::keepsApart(const RepairView& view, const PatchEdit& edit) const {
  const Grid& grid = view.grid;
  if (edit.placed == kNone || edit.placed >= grid.nodes.size()) return true;
  // The boundary edges after the edit that are new, or end at the node that moves.
  std::vector<NodePair> changed;
  for (const auto& [edge, kind] : edit.made) changed.push_back(edge);
  std::set<std::uint32_t> before{edit.placed};  // nodes whose edges these replace
  for (const NodePair& edge : edit.gone) before.insert(edge.begin(), edge.end());
  const std::vector<std::uint32_t> next_ones = boundaryNeighbours(view, edit.placed);
  for (const std::uint32_t node : next_ones) {
    const NodePair edge = edgeKey(edit.placed, node);
    if (std::ranges::count(edit.gone, edge) == 0) changed.push_back(edge);
  }
  const auto placeOf = [&](std::uint32_t node, bool moved) {
    return moved && node == edit.placed ? edit.place : grid.nodes[node];
  };
  const auto between = [&](const NodePair& edge, const NodePair& other, bool moved) {
    std::array p{placeOf(edge[0], moved), placeOf(edge[1], moved), grid.nodes[other[0]], grid.nodes[other[1]]};
    flattenLocally(grid.crs, p);
    double wanted = kApart * distance(p[0], p[1]);
    // The edge between the two, along the shore, may be short.
    for (unsigned k = 0; k < 2; ++k)
      if (std::ranges::count(next_ones, other[k]) > 0)
        wanted = std::min(wanted, kAlong * distance(p[edge[0] == edit.placed ? 0 : 1], p[2 + k]));
    return std::pair(apart(p), wanted);
  };
  for (const NodePair& edge : changed) {
    Box box = Box::of(placeOf(edge[0], true), placeOf(edge[1], true));
    box.add(grid.nodes[edit.placed]);
    // Degrees of longitude are shorter than those of latitude.
    const double cosine = grid.crs.geographic ? std::max(0.01, std::cos(box.ymax * 3.14159 / 180.0)) : 1.0;
    const double reach = std::max(box.ymax - box.ymin, box.xmax - box.xmin) / cosine;
    bool keeps = true;
    tree_.visit(box.grownBy(reach), [&](std::uint32_t i) {
      const NodePair& other = edges_[i];
      if (!keeps || before.contains(other[0]) || before.contains(other[1])) return;
      if (std::ranges::any_of(edge, [&](std::uint32_t node) { return node == other[0] || node == other[1]; })) return;
      const auto [now, wanted] = between(edge, other, true);
      if (now >= wanted) return;
      double was = std::numeric_limits<double>::infinity();
      for (const std::uint32_t node : before)
        for (const std::uint32_t next : boundaryNeighbours(view, node))
          if (next != other[0] && next != other[1]) was = std::min(was, between({node, next}, other, false).first);
      keeps = now >= kSame * was;
    });
    if (!keeps) return false;
  }
  return true;
}

std::optional<PatchEdit> collapseOf(const RepairView& view, std::uint32_t gone, std::uint32_t kept, double share) {
  const Grid& grid = view.grid;
  const bool by_shore = view.links.kinds.contains(edgeKey(gone, kept));
  const auto mayMove = [&](std::uint32_t node) {
    if (!view.links.on_boundary[node]) return isMovable(view, node);
    return by_shore && slideNeighbours(view, node).size() == 2;
  };
  if (!mayMove(gone) || (share > 0.0 && !mayMove(kept))) return std::nullopt;
  PatchEdit edit{.kind = PatchEditKind::EdgeCollapse, .nodes = {kept, gone}, .share = share, .placed = kept};
  edit.place = placeBetween(grid.crs, grid.nodes[kept], grid.nodes[gone], share);
  edit.z = zBetween(grid, kept, gone, share);
  std::set<std::uint32_t> apexes;
  for (const std::uint32_t t : view.links.triangles_at[gone]) {
    GridCorners v = grid.triangles[t];
    if (std::ranges::count(v, kept) > 0) {
      edit.removed.push_back(t);
      for (const std::uint32_t node : v)
        if (node != gone && node != kept) apexes.insert(node);
      continue;
    }
    std::ranges::replace(v, gone, kept);
    edit.triangles.push_back({v, t, t});
  }
  // If the ends had other common neighbours, two triangles would coincide.
  const std::set<std::uint32_t> of_gone = neighboursOf(view, gone), of_kept = neighboursOf(view, kept);
  std::set<std::uint32_t> common;
  std::ranges::set_intersection(of_gone, of_kept, std::inserter(common, common.end()));
  if (common != apexes || edit.triangles.empty() || edit.removed.size() != (by_shore ? 1u : 2u)) return std::nullopt;
  if (share > 0.0)
    for (const std::uint32_t t : view.links.triangles_at[kept])
      if (std::ranges::count(edit.removed, t) == 0) edit.triangles.push_back({grid.triangles[t], t, t});
  if (!by_shore) return edit;
  edit.gone.push_back(edgeKey(gone, kept));
  for (const std::uint32_t other : boundaryNeighbours(view, gone)) {
    if (other == kept) continue;
    edit.gone.push_back(edgeKey(gone, other));
    edit.made[edgeKey(kept, other)] = view.links.kinds.at(edgeKey(gone, other));
  }
  return edit;
}

std::optional<PatchEdit> cornerCutOf(const RepairView& view, std::uint32_t t) {
  const std::size_t most = view.isFor(Target::Fesom) ? 6 : 3;  // triangles: the end of a water one element wide
  PatchEdit edit{.kind = PatchEditKind::CornerCut};
  std::optional<BoundaryKind> exposed;
  for (std::uint32_t next = t;;) {
    const GridCorners& v = view.grid.triangles[next];
    // The edge that stays, opposite the node that goes; the others are on the boundary.
    unsigned tip = 3;
    int inner = 0;
    for (unsigned i = 0; i < 3; ++i) {
      if (view.links.line_edges.contains(edgeKey(v[next3(i)], v[prev3(i)]))) return std::nullopt;
      if (kindOf(view, edit, v[next3(i)], v[prev3(i)]) != nullptr) continue;
      tip = i;
      ++inner;
    }
    if (inner != 1 || view.links.isAsked(v[tip])) return std::nullopt;
    edit.removed.push_back(next);
    const auto isKept = [&](std::uint32_t other) { return std::ranges::count(edit.removed, other) == 0; };
    if (std::ranges::any_of(view.links.triangles_at[v[tip]], isKept)) return std::nullopt;
    const std::array sides{edgeKey(v[tip], v[next3(tip)]), edgeKey(v[tip], v[prev3(tip)])};
    for (const NodePair& side : sides) {
      const BoundaryKind kind = *kindOf(view, edit, side[0], side[1]);
      if (kind.role != BoundaryRole::Open && !isShore(kind)) return std::nullopt;
      if (!exposed || isShore(kind)) exposed = kind;
    }
    for (const NodePair& side : sides)
      if (edit.made.erase(side) == 0) edit.gone.push_back(side);
    const std::uint32_t a = v[next3(tip)], b = v[prev3(tip)];
    edit.made[edgeKey(a, b)] = *exposed;
    // The triangle beyond: part of the cut if it has an open edge besides the exposed one.
    const EdgeRef twin = view.links.mesh.triangles[next].adj[tip];
    if (twin == kNone) return std::nullopt;
    const std::uint32_t beyond = triOf(twin);
    const GridCorners& w = view.grid.triangles[beyond];
    bool goes_on = false;
    for (unsigned i = 0; i < 3; ++i) {
      const BoundaryKind* const kind = kindOf(view, edit, w[next3(i)], w[prev3(i)]);
      if (kind == nullptr || edgeKey(w[next3(i)], w[prev3(i)]) == edgeKey(a, b)) continue;
      if (kind->role == BoundaryRole::Open || view.isFor(Target::Fesom)) goes_on = true;
    }
    if (!goes_on) {
      edit.triangles.push_back({w, beyond, beyond});
      return edit;
    }
    if (edit.removed.size() == most) return std::nullopt;
    next = beyond;
  }
}

}  // namespace coastmesh
