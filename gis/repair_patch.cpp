#include "gis/repair_patch.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "core/predicates.hpp"
#include "core/quality.hpp"
#include "gis/local_plane.hpp"
#include "gis/target_limits.hpp"

namespace coastmesh {
namespace {

std::uint32_t featureOf(const Grid& grid, std::uint32_t t) { return grid.feature_of.empty() ? 0 : grid.feature_of[t]; }

std::optional<std::size_t> findEdge(const Patch& patch, std::uint32_t a, std::uint32_t b) {
  for (std::size_t k = 0; k < patch.triangles.size(); ++k)
    for (unsigned i = 0; i < 3; ++i)
      if (patch.triangles[k].v[i] == a && patch.triangles[k].v[next3(i)] == b) return k;
  return std::nullopt;
}

std::uint32_t apexOf(const PatchTriangle& triangle, std::uint32_t a, std::uint32_t b) {
  return *std::ranges::find_if(triangle.v, [&](std::uint32_t node) { return node != a && node != b; });
}

}  // namespace

bool PatchSearch::isFor(Target target) const { return std::ranges::count(targets_, target) > 0; }

// An inner edge that has to stay: it is part of a line, or features meet there.
bool PatchSearch::isFixed(std::uint32_t a, std::uint32_t b, std::uint32_t left, std::uint32_t right) const {
  return links_.line_edges.contains(edgeKey(a, b)) || featureOf(grid_, left) != featureOf(grid_, right);
}

std::set<std::uint32_t> PatchSearch::fixedNeighbours(std::uint32_t node) const {
  std::set<std::uint32_t> fixed;
  std::map<std::uint32_t, std::uint32_t> triangle_at;  // one with the edge to a neighbour
  for (const std::uint32_t t : links_.triangles_at[node]) {
    for (const std::uint32_t other : grid_.triangles[t]) {
      if (other == node) continue;
      const std::uint32_t seen = triangle_at.try_emplace(other, t).first->second;
      if (isFixed(node, other, t, seen)) fixed.insert(other);
    }
  }
  return fixed;
}

std::vector<Point> PatchSearch::planeOf(const Patch& patch, std::span<const std::uint32_t> nodes) const {
  std::vector<Point> places;
  for (const std::uint32_t node : nodes) places.push_back(node < grid_.nodes.size() ? grid_.nodes[node] : patch.fresh);
  return localPlane(grid_.crs, places);
}

Patch PatchSearch::patchRound(const std::vector<std::uint32_t>& middle) const {
  std::set<std::uint32_t> members;
  for (const std::uint32_t t : middle)
    for (const std::uint32_t node : grid_.triangles[t])
      members.insert(links_.triangles_at[node].begin(), links_.triangles_at[node].end());
  Patch patch;
  for (const std::uint32_t t : members) patch.triangles.push_back({grid_.triangles[t], t, t});
  return patch;
}

const RimKind* PatchSearch::kindOf(const Patch& patch, std::uint32_t a, std::uint32_t b) const {
  const NodePair key = edgeKey(a, b);
  if (const auto half = patch.halves.find(key); half != patch.halves.end()) return &half->second;
  if (std::ranges::count(patch.gone, key) > 0) return nullptr;
  const auto at = links_.kinds.find(key);
  return at == links_.kinds.end() ? nullptr : &at->second;
}

// Whether an edge of the rim starts or ends there.
bool PatchSearch::isOnRim(std::uint32_t node) const {
  for (const std::uint32_t t : links_.triangles_at[node])
    for (const std::uint32_t other : grid_.triangles[t])
      if (other != node && links_.kinds.contains(edgeKey(node, other))) return true;
  return false;
}

PatchSearch::Score PatchSearch::scoreOf(const Patch& patch, const Patch& before) const {
  Score score{0, 180.0};
  std::map<NodePair, std::vector<std::uint32_t>> apexes;
  for (const PatchTriangle& triangle : patch.triangles) {
    const std::vector<Point> p = planeOf(patch, triangle.v);
    if (orient2d(p[0], p[1], p[2]) <= 0) return {std::numeric_limits<int>::max(), 0.0};
    const auto angles = anglesDeg(p[0], p[1], p[2]);
    score.min_angle = std::min(score.min_angle, std::ranges::min(angles));
    if (isFor(Target::Swan)) score.defects += std::ranges::max(angles) > kSwanLargestAngleDeg;
    int open = 0, solid = 0;
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle.v[next3(i)], b = triangle.v[prev3(i)];
      apexes[edgeKey(a, b)].push_back(triangle.v[i]);
      const RimKind* const kind = kindOf(patch, a, b);
      if (kind != nullptr) ++(kind->role == BoundaryRole::Open ? open : solid);
    }
    if (isFor(Target::Fvcom)) score.defects += (open > 1 ? 1 : 0) + (open > 0 && solid > 0 ? 1 : 0);
    score.defects += open + solid == 3;
  }
  if (isFor(Target::Dflowfm)) {
    for (const auto& [edge, ends] : apexes) {
      if (ends.size() != 2) continue;
      const std::array<std::uint32_t, 4> nodes{edge[0], edge[1], ends[0], ends[1]};
      std::vector<Point> p = planeOf(patch, nodes);
      if (orient2d(p[0], p[1], p[2]) < 0) std::swap(p[0], p[1]);
      score.defects += orthogonality(p[0], p[1], p[2], p[3]) > kDflowfmLargestCosine;
    }
  }
  if (isFor(Target::Swan)) score.defects += badValences(patch, before);
  return score;
}

int PatchSearch::badValences(const Patch& patch, const Patch& before) const {
  std::map<std::uint32_t, int> cells;
  const auto globalCells = [&](std::uint32_t node) {
    return node < links_.triangles_at.size() ? static_cast<int>(links_.triangles_at[node].size()) : 0;
  };
  for (const PatchTriangle& triangle : before.triangles)
    for (const std::uint32_t node : triangle.v) --cells.try_emplace(node, globalCells(node)).first->second;
  for (const PatchTriangle& triangle : patch.triangles)
    for (const std::uint32_t node : triangle.v) ++cells.try_emplace(node, globalCells(node)).first->second;
  std::set<std::uint32_t> on_rim;
  for (const PatchTriangle& triangle : patch.triangles)
    for (unsigned i = 0; i < 3; ++i)
      if (kindOf(patch, triangle.v[i], triangle.v[next3(i)]) != nullptr)
        on_rim.insert({triangle.v[i], triangle.v[next3(i)]});
  int bad = 0;
  for (const auto& [node, count] : cells) {
    const bool inner = !on_rim.contains(node) && (node >= links_.triangles_at.size() || !isOnRim(node));
    if (inner && count > 0) bad += std::max({0, kSwanFewestCells - count, count - kSwanMostCells});
  }
  return bad;
}

std::optional<Patch> PatchSearch::flipped(Patch patch, std::uint32_t a, std::uint32_t b) const {
  const auto left = findEdge(patch, a, b), right = findEdge(patch, b, a);
  if (!left || !right) return std::nullopt;
  if (isFixed(a, b, patch.triangles[*left].source, patch.triangles[*right].source)) return std::nullopt;
  const std::uint32_t c = apexOf(patch.triangles[*left], a, b), d = apexOf(patch.triangles[*right], a, b);
  patch.triangles[*left].v = {a, d, c};
  patch.triangles[*right].v = {d, b, c};
  return patch;
}

// The patch with a new node on the edge.
Patch PatchSearch::split(Patch patch, std::uint32_t a, std::uint32_t b, double share) const {
  const auto middle = static_cast<std::uint32_t>(grid_.nodes.size());
  patch.fresh = placeBetween(grid_.crs, grid_.nodes[a], grid_.nodes[b], share);
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
    const auto side = findEdge(patch, from, to);
    if (!side) continue;
    const std::uint32_t apex = apexOf(patch.triangles[*side], from, to);
    patch.triangles.push_back({{middle, to, apex}, kNone, patch.triangles[*side].source});
    patch.triangles[*side].v = {from, middle, apex};
  }
  if (const RimKind* const kind = kindOf(patch, a, b)) {
    const RimKind half = *kind;
    patch.halves[edgeKey(a, middle)] = patch.halves[edgeKey(middle, b)] = half;
    patch.gone.push_back(edgeKey(a, b));
  }
  return patch;
}

// The nodes round an inner node, counter-clockwise; empty where they do not close.
std::vector<std::uint32_t> PatchSearch::ringRound(std::uint32_t node) const {
  std::map<std::uint32_t, std::uint32_t> next;
  for (const std::uint32_t t : links_.triangles_at[node]) {
    const GridCorners& v = grid_.triangles[t];
    const auto k = static_cast<unsigned>(std::ranges::find(v, node) - v.begin());
    next[v[next3(k)]] = v[prev3(k)];
  }
  std::vector<std::uint32_t> ring{next.begin()->first};
  while (ring.size() < next.size() && next.contains(ring.back())) ring.push_back(next[ring.back()]);
  const bool closes = next.contains(ring.back()) && next[ring.back()] == ring.front();
  return closes ? ring : std::vector<std::uint32_t>();
}

std::optional<Reshaping> PatchSearch::bestReshaping(const std::vector<std::uint32_t>& inside,
                                                    const Patch& before) const {
  std::set<NodePair> edges;
  for (const std::uint32_t t : inside)
    for (unsigned i = 0; i < 3; ++i) edges.insert(edgeKey(grid_.triangles[t][i], grid_.triangles[t][next3(i)]));
  Score best = scoreOf(before, before);
  const int defects_before = best.defects;
  std::optional<Reshaping> chosen;
  const auto consider = [&](Reshaping&& tried) {
    const Score score = scoreOf(tried.patch, before);
    if (score.defects >= defects_before || (chosen && !score.betterThan(best))) return;
    best = score;
    chosen = std::move(tried);
  };
  for (const auto& [a, b] : edges) {
    if (auto patch = flipped(before, a, b)) consider({std::move(*patch), {a, b}, std::nullopt});
    for (const double share : {0.5, 0.4, 0.6, 0.3, 0.7}) consider({split(before, a, b, share), {a, b}, share});
  }
  return chosen;
}

std::optional<Patch> PatchSearch::bestNodeSplit(std::uint32_t node, const Patch& before) const {
  const std::vector<std::uint32_t> ring = ringRound(node);
  if (ring.size() < 8) return std::nullopt;
  const std::size_t n = ring.size(), half = n / 2;
  const auto fresh = static_cast<std::uint32_t>(grid_.nodes.size());
  const Point place = grid_.nodes[node];
  Score best = scoreOf(before, before);
  const int defects_before = best.defects;
  std::optional<Patch> chosen;
  const std::set<std::uint32_t> fixed = fixedNeighbours(node);
  for (std::size_t first = 0; first < n; ++first) {
    // From `first` on, `half` triangles go to the new node.
    std::vector<Point> places;
    std::set<NodePair> moved;
    bool moves_fixed = false;
    for (std::size_t k = 0; k <= half; ++k) {
      const std::uint32_t from = ring[(first + k) % n];
      places.push_back(grid_.nodes[from]);
      if (k < half) moved.insert({from, ring[(first + k + 1) % n]});
      moves_fixed = moves_fixed || (k > 0 && k < half && fixed.contains(from));
    }
    if (moves_fixed) continue;
    const Point middle = meanPlace(grid_.crs, places);
    Patch patch = before;
    std::uint32_t source = kNone;
    for (PatchTriangle& triangle : patch.triangles) {
      const auto at = std::ranges::find(triangle.v, node);
      if (at == triangle.v.end()) continue;
      const auto k = static_cast<unsigned>(at - triangle.v.begin());
      if (!moved.contains({triangle.v[next3(k)], triangle.v[prev3(k)]})) continue;
      *at = fresh;
      source = triangle.source;
    }
    patch.triangles.push_back({{node, ring[first], fresh}, kNone, source});
    patch.triangles.push_back({{node, fresh, ring[(first + half) % n]}, kNone, source});
    for (const double share : {0.3, 0.5, 0.7}) {
      patch.fresh = placeBetween(grid_.crs, place, middle, share);
      const Score score = scoreOf(patch, before);
      if (score.defects >= defects_before || (chosen && !score.betterThan(best))) continue;
      best = score;
      chosen = patch;
    }
  }
  return chosen;
}

}  // namespace coastmesh
