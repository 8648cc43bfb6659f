#include "gis/repair/repair_patch.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "core/metric.hpp"
#include "gis/rounded_depth.hpp"

namespace coastmesh {
namespace {

std::uint32_t featureOf(const Grid& grid, std::uint32_t t) { return grid.feature_of.empty() ? 0 : grid.feature_of[t]; }

// True if an inner edge must stay: it is part of a line, or features meet there.
bool isFixed(const RepairView& view, std::uint32_t a, std::uint32_t b, std::uint32_t left, std::uint32_t right) {
  return view.links.line_edges.contains(edgeKey(a, b)) || featureOf(view.grid, left) != featureOf(view.grid, right);
}

// The triangle to the left of the edge from `a` to `b`.
std::optional<PatchEdge> findSide(const RepairView& view, const GridPatch& patch, std::uint32_t a, std::uint32_t b) {
  for (const PatchEdge& edge : patch.edgesAt(view, edgeKey(a, b))) {
    const GridCorners& v = view.grid.triangles[edge.triangle];
    for (unsigned i = 0; i < 3; ++i)
      if (v[i] == a && v[next3(i)] == b) return edge;
  }
  return std::nullopt;
}

// True if the way from `a` by `node` to `b` turns by hardly more than a degree in the grid's CRS, in which sides of the
// frame are straight.
bool goesStraight(const RepairView& view, std::uint32_t a, std::uint32_t node, std::uint32_t b) {
  constexpr double kSineOfTurn = 0.02;
  const Point &middle = view.grid.nodes[node], &first = view.grid.nodes[a], &last = view.grid.nodes[b];
  const Point to{middle.x - first.x, middle.y - first.y}, from{last.x - middle.x, last.y - middle.y};
  return dot(to, from) > 0.0 &&
         std::abs(cross(to, from)) <= kSineOfTurn * std::hypot(to.x, to.y) * std::hypot(from.x, from.y);
}

}  // namespace

std::vector<PatchEdge> GridPatch::edgesAt(const RepairView& view, const NodePair& key) const {
  std::vector<PatchEdge> edges;
  const auto& at = view.links.triangles_at;
  if (key[1] >= at.size()) return edges;  // a node that the edit adds
  for (const std::uint32_t t : at[key[0]].size() <= at[key[1]].size() ? at[key[0]] : at[key[1]]) {
    if (!std::ranges::binary_search(triangles, t)) continue;
    const GridCorners& v = view.grid.triangles[t];
    for (unsigned i = 0; i < 3; ++i)
      if (edgeKey(v[next3(i)], v[prev3(i)]) == key) edges.push_back({key, t, v[i]});
  }
  return edges;
}

std::vector<std::uint32_t> nodesOf(const Grid& grid, std::span<const std::uint32_t> triangles) {
  std::vector<std::uint32_t> nodes;
  for (const std::uint32_t t : triangles) nodes.insert(nodes.end(), grid.triangles[t].begin(), grid.triangles[t].end());
  std::ranges::sort(nodes);
  nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
  return nodes;
}

GridPatch patchRound(const RepairView& view, std::span<const std::uint32_t> middle) {
  GridPatch patch;
  for (const std::uint32_t node : nodesOf(view.grid, middle))
    patch.triangles.insert(patch.triangles.end(), view.links.triangles_at[node].begin(),
                           view.links.triangles_at[node].end());
  std::ranges::sort(patch.triangles);
  patch.triangles.erase(std::ranges::unique(patch.triangles).begin(), patch.triangles.end());
  return patch;
}

const BoundaryKind* kindOf(const RepairView& view, const PatchEdit& edit, std::uint32_t a, std::uint32_t b) {
  const NodePair key = edgeKey(a, b);
  if (const auto made = edit.made.find(key); made != edit.made.end()) return &made->second;
  if (std::ranges::count(edit.gone, key) > 0) return nullptr;
  const auto isInner = [&](std::uint32_t node) {
    return node < view.links.on_boundary.size() && !view.links.on_boundary[node];
  };
  if (isInner(a) || isInner(b)) return nullptr;
  const auto at = view.links.kinds.find(key);
  return at == view.links.kinds.end() ? nullptr : &at->second;
}

void flagBoundaryNodes(GridLinks& links, std::size_t nodes) {
  links.on_boundary.assign(nodes, false);
  links.on_opening.assign(nodes, false);
  for (const auto& [edge, kind] : links.kinds) {
    links.on_boundary[edge[0]] = links.on_boundary[edge[1]] = true;
    if (kind.role == BoundaryRole::Open) links.on_opening[edge[0]] = links.on_opening[edge[1]] = true;
  }
}

NodeMark markOf(const RepairView& view, const PatchEdit& edit, std::uint32_t node) {
  bool on_boundary = node < view.links.on_boundary.size() && view.links.on_boundary[node];
  for (const auto& [edge, kind] : edit.made) {
    if (edge[0] != node && edge[1] != node) continue;
    if (kind.role == BoundaryRole::Open) return NodeMark::Open;
    on_boundary = true;
  }
  if (!on_boundary) return NodeMark::Inner;
  if (node >= view.links.on_opening.size() || !view.links.on_opening[node]) return NodeMark::Shore;
  if (edit.gone.empty()) return NodeMark::Open;
  const auto isOpenStill = [&](std::uint32_t other) {
    const BoundaryKind* const kind = kindOf(view, edit, node, other);
    return kind != nullptr && kind->role == BoundaryRole::Open;
  };
  return std::ranges::any_of(boundaryNeighbours(view, node), isOpenStill) ? NodeMark::Open : NodeMark::Shore;
}

std::optional<PatchEdit> flipOf(const RepairView& view, const GridPatch& patch, std::uint32_t a, std::uint32_t b) {
  const std::optional<PatchEdge> left = findSide(view, patch, a, b), right = findSide(view, patch, b, a);
  if (!left || !right) return std::nullopt;
  if (isFixed(view, a, b, left->triangle, right->triangle)) return std::nullopt;
  PatchEdit edit{.kind = PatchEditKind::EdgeFlip, .nodes = {a, b}};
  edit.triangles.push_back({{a, right->apex, left->apex}, left->triangle, left->triangle});
  edit.triangles.push_back({{right->apex, b, left->apex}, right->triangle, right->triangle});
  return edit;
}

PatchEdit splitOf(const RepairView& view, const GridPatch& patch, std::uint32_t a, std::uint32_t b, double share) {
  const auto middle = static_cast<std::uint32_t>(view.grid.nodes.size());
  PatchEdit edit{.kind = PatchEditKind::EdgeSplit, .nodes = {a, b}, .share = share, .placed = middle};
  edit.place = placeBetween(view.grid.crs, view.grid.nodes[a], view.grid.nodes[b], share);
  edit.z = zBetween(view.grid, a, b, share);
  std::vector<EditedTriangle> added;
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
    const std::optional<PatchEdge> side = findSide(view, patch, from, to);
    if (!side) continue;
    edit.triangles.push_back({{from, middle, side->apex}, side->triangle, side->triangle});
    added.push_back({{middle, to, side->apex}, kNone, side->triangle});
  }
  edit.triangles.insert(edit.triangles.end(), added.begin(), added.end());
  if (const BoundaryKind* const kind = kindOf(view, edit, a, b)) {
    edit.made[edgeKey(a, middle)] = edit.made[edgeKey(middle, b)] = *kind;
    edit.gone = {edgeKey(a, b)};
  }
  return edit;
}

std::vector<std::uint32_t> ringRound(const RepairView& view, std::uint32_t node) {
  std::map<std::uint32_t, std::uint32_t> next;
  for (const std::uint32_t t : view.links.triangles_at[node]) {
    const GridCorners& v = view.grid.triangles[t];
    const auto k = static_cast<unsigned>(std::ranges::find(v, node) - v.begin());
    next[v[next3(k)]] = v[prev3(k)];
  }
  std::vector<std::uint32_t> ring{next.begin()->first};
  while (ring.size() < next.size() && next.contains(ring.back())) ring.push_back(next[ring.back()]);
  const bool closes = next.contains(ring.back()) && next[ring.back()] == ring.front();
  return closes ? ring : std::vector<std::uint32_t>();
}

std::optional<PatchEdit> nodeSplitOf(const RepairView& view, std::uint32_t node, std::span<const std::uint32_t> ring,
                                     const std::set<std::uint32_t>& fixed, std::size_t first, std::size_t count) {
  const std::size_t n = ring.size();
  const auto fresh = static_cast<std::uint32_t>(view.grid.nodes.size());
  std::set<NodePair> moved;
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t from = ring[(first + k) % n];
    if (k > 0 && fixed.contains(from)) return std::nullopt;
    moved.insert({from, ring[(first + k + 1) % n]});
  }
  PatchEdit edit{.kind = PatchEditKind::NodeSplit, .nodes = {node, node}, .placed = fresh};
  edit.z = zBetween(view.grid, node, node, 0.0);
  std::uint32_t source = kNone;
  for (const std::uint32_t t : view.links.triangles_at[node]) {
    GridCorners v = view.grid.triangles[t];
    const auto k = static_cast<unsigned>(std::ranges::find(v, node) - v.begin());
    if (!moved.contains({v[next3(k)], v[prev3(k)]})) continue;
    v[k] = fresh;
    edit.triangles.push_back({v, t, t});
    source = t;
  }
  edit.triangles.push_back({{node, ring[first], fresh}, kNone, source});
  edit.triangles.push_back({{node, fresh, ring[(first + count) % n]}, kNone, source});
  return edit;
}

std::set<std::uint32_t> neighboursOf(const RepairView& view, std::uint32_t node) {
  std::set<std::uint32_t> others;
  for (const std::uint32_t t : view.links.triangles_at[node])
    others.insert(view.grid.triangles[t].begin(), view.grid.triangles[t].end());
  others.erase(node);
  return others;
}

std::vector<std::uint32_t> boundaryNeighbours(const RepairView& view, std::uint32_t node) {
  std::vector<std::uint32_t> others;
  if (!view.links.on_boundary[node]) return others;
  for (const std::uint32_t other : neighboursOf(view, node))
    if (view.links.kinds.contains(edgeKey(node, other))) others.push_back(other);
  return others;
}

std::vector<std::uint32_t> slideNeighbours(const RepairView& view, std::uint32_t node) {
  if (view.shores == nullptr || view.links.isAsked(node)) return {};
  const std::vector<std::uint32_t> others = boundaryNeighbours(view, node);
  if (others.size() != 2 || !fixedNeighbours(view, node).empty()) return {};
  const BoundaryKind &one = view.links.kinds.at(edgeKey(node, others[0])),
                     &other = view.links.kinds.at(edgeKey(node, others[1]));
  if (one == other && (isShore(one) || goesStraight(view, others[0], node, others[1]))) return others;
  if (one.role == BoundaryRole::Open && isShore(other)) return {others[0]};
  if (other.role == BoundaryRole::Open && isShore(one)) return {others[1]};
  return {};
}

bool isMovable(const RepairView& view, std::uint32_t node) {
  if (view.links.on_boundary[node]) return !slideNeighbours(view, node).empty();
  return !view.links.isAsked(node) && fixedNeighbours(view, node).empty();
}

PatchEdit moveOf(const RepairView& view, std::uint32_t node, std::uint32_t a, std::uint32_t b, double share) {
  const Crs& crs = view.grid.crs;
  const std::span<const Point> nodes = view.grid.nodes;
  PatchEdit edit{.kind = PatchEditKind::NodeMove, .nodes = {a, b}, .share = share, .placed = node};
  edit.place = placeBetween(crs, nodes[node], placeBetween(crs, nodes[a], nodes[b], 0.5), share);
  const double here = zBetween(view.grid, node, node, 0.0), there = zBetween(view.grid, a, b, 0.5);
  edit.z = std::isnan(there) ? here : roundedDepth(here + share * (there - here));
  for (const std::uint32_t t : view.links.triangles_at[node]) edit.triangles.push_back({view.grid.triangles[t], t, t});
  return edit;
}

double zBetween(const Grid& grid, std::uint32_t a, std::uint32_t b, double share) {
  if (grid.z.empty()) return std::numeric_limits<double>::quiet_NaN();
  // A copy keeps its bits.
  return a == b ? grid.z[a] : roundedDepth(grid.z[a] + share * (grid.z[b] - grid.z[a]));
}

std::set<std::uint32_t> fixedNeighbours(const RepairView& view, std::uint32_t node) {
  std::set<std::uint32_t> fixed;
  std::map<std::uint32_t, std::uint32_t> triangle_at;  // one with the edge to a neighbour
  for (const std::uint32_t t : view.links.triangles_at[node]) {
    for (const std::uint32_t other : view.grid.triangles[t]) {
      if (other == node) continue;
      const std::uint32_t seen = triangle_at.try_emplace(other, t).first->second;
      if (isFixed(view, node, other, t, seen)) fixed.insert(other);
    }
  }
  return fixed;
}

}  // namespace coastmesh
