#include "gis/model/repair_score.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/predicates.hpp"
#include "core/quality.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/model/flow_links.hpp"
#include "gis/model/target_limits.hpp"

namespace coastmesh {
namespace {

template <std::size_t N>
std::array<Point, N> placesOf(const RepairView& view, const PatchEdit& edit,
                              const std::array<std::uint32_t, N>& nodes) {
  std::array<Point, N> places;
  for (std::size_t i = 0; i < N; ++i) places[i] = nodes[i] == edit.placed ? edit.place : view.grid.nodes[nodes[i]];
  return places;
}

template <std::size_t N>
std::array<Point, N> planeOf(const RepairView& view, const PatchEdit& edit, const std::array<std::uint32_t, N>& nodes) {
  std::array<Point, N> places = placesOf(view, edit, nodes);
  flattenLocally(view.grid.crs, places);
  return places;
}

struct TriangleScore {
  int defects = 0;
  double min_angle = 0.0;
};

// None for a triangle that is clockwise, or without area.
std::optional<TriangleScore> scoreTriangle(const RepairView& view, const PatchEdit& edit, const GridCorners& v) {
  const auto p = planeOf(view, edit, v);
  if (orient2d(p[0], p[1], p[2]) <= 0) return std::nullopt;
  // The plane is rounded: what is flat to within that is asked of the places themselves, as the report does.
  const auto on_ground = placesOf(view, edit, v);
  if (orientationOnGround(on_ground[0], on_ground[1], on_ground[2], view.grid.crs) <= 0) return std::nullopt;
  const auto angles = anglesDeg(p[0], p[1], p[2]);
  TriangleScore score{0, std::ranges::min(angles)};
  if (view.isFor(Target::Swan)) {
    const auto q = placesOf(view, edit, v);
    score.defects += largestFileAngle(q[0], q[1], q[2]) > kSwanLargestAngleDeg;
  }
  int open = 0, solid = 0;
  for (unsigned i = 0; i < 3; ++i) {
    const BoundaryKind* const kind = kindOf(view, edit, v[i], v[next3(i)]);
    if (kind == nullptr) continue;
    if (kind->role == BoundaryRole::Open)
      ++open;
    else
      ++solid;
  }
  if (view.isFor(Target::Fvcom)) score.defects += (open > 1 ? 1 : 0) + (open > 0 && solid > 0 ? 1 : 0);
  score.defects += open + solid == 3;
  return score;
}

// The triangles that are no more as they were, ascending.
std::vector<std::uint32_t> replacedBy(const PatchEdit& edit) {
  std::vector<std::uint32_t> replaced;
  for (const EditedTriangle& triangle : edit.triangles)
    if (triangle.slot != kNone) replaced.push_back(triangle.slot);
  std::ranges::sort(replaced);
  return replaced;
}

int edgeDefects(const RepairView& view, const PatchEdit& edit, const NodePair& edge,
                std::span<const std::uint32_t> apexes) {
  if (apexes.size() != 2) return 0;
  auto p = planeOf(view, edit, std::array{edge[0], edge[1], apexes[0], apexes[1]});
  if (orient2d(p[0], p[1], p[2]) < 0) std::swap(p[0], p[1]);
  const FlowLink link = flowLinkAcross(p[0], p[1], p[2], p[3]);
  return (link.cosine > kDflowfmLargestCosine ? 1 : 0) + (link.length < kDflowfmSmallestLink ? 1 : 0);
}

// Of the edges that have another triangle beside them after the edit than before.
int edgeDefectsAdded(const RepairView& view, const Patch& patch, const PatchEdit& edit,
                     std::span<const std::uint32_t> replaced) {
  std::vector<PatchEdge> made;
  std::vector<NodePair> keys;
  for (const EditedTriangle& triangle : edit.triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      const NodePair key = edgeKey(triangle.v[next3(i)], triangle.v[prev3(i)]);
      made.push_back({key, triangle.slot, triangle.v[i]});
      keys.push_back(key);
      if (triangle.slot == kNone) continue;
      const GridCorners& old = view.grid.triangles[triangle.slot];
      keys.push_back(edgeKey(old[next3(i)], old[prev3(i)]));
    }
  }
  std::ranges::sort(keys);
  keys.erase(std::ranges::unique(keys).begin(), keys.end());
  std::ranges::sort(made, {}, &PatchEdge::key);
  int added = 0;
  std::vector<std::uint32_t> before, after;
  for (const NodePair& key : keys) {
    before.clear();
    after.clear();
    for (const PatchEdge& edge : patch.edgesAt(view, key)) {
      before.push_back(edge.apex);
      if (!std::ranges::binary_search(replaced, edge.triangle)) after.push_back(edge.apex);
    }
    for (const PatchEdge& edge : std::ranges::equal_range(made, key, {}, &PatchEdge::key)) after.push_back(edge.apex);
    added += edgeDefects(view, edit, key, after) - edgeDefects(view, {}, key, before);
  }
  return added;
}

// Triangles too many or too few round the nodes that get more or fewer.
int badValencesAdded(const RepairView& view, const PatchEdit& edit) {
  std::vector<std::pair<std::uint32_t, int>> changes;
  for (const EditedTriangle& triangle : edit.triangles) {
    for (const std::uint32_t node : triangle.v) changes.emplace_back(node, 1);
    if (triangle.slot == kNone) continue;
    for (const std::uint32_t node : view.grid.triangles[triangle.slot]) changes.emplace_back(node, -1);
  }
  std::ranges::sort(changes);
  const auto bad = [](int count) {
    return count > 0 ? std::max({0, kSwanFewestCells - count, count - kSwanMostCells}) : 0;
  };
  int added = 0;
  for (std::size_t i = 0; i < changes.size();) {
    const std::uint32_t node = changes[i].first;
    int change = 0;
    for (; i < changes.size() && changes[i].first == node; ++i) change += changes[i].second;
    const bool is_new = node >= view.links.triangles_at.size();
    if (is_new ? !edit.halves.empty() : view.links.on_boundary[node]) continue;
    const int count = is_new ? 0 : static_cast<int>(view.links.triangles_at[node].size());
    added += bad(count + change) - bad(count);
  }
  return added;
}

}  // namespace

PatchScale scaleOf(const RepairView& view, const Patch& patch) {
  PatchScale scale;
  for (const std::uint32_t t : patch.triangles) {
    double& angle = view.smallest_angle[t];
    if (std::isnan(angle)) {
      const auto score = scoreTriangle(view, {}, view.grid.triangles[t]);
      angle = score ? score->min_angle : -1.0;
    }
    if (angle < 0.0) {
      scale.turned.push_back(t);
    } else {
      scale.angles.emplace_back(angle, t);
    }
  }
  std::ranges::sort(scale.angles);
  return scale;
}

EditScore scoreOf(const PatchScale& scale) {
  if (!scale.turned.empty()) return {kTurnedOver, 0.0};
  return {0, scale.angles.empty() ? 180.0 : scale.angles.front().first};
}

EditScore scoreOf(const RepairView& view, const Patch& patch, const PatchScale& scale, const PatchEdit& edit) {
  const EditScore worst{kTurnedOver, 0.0};
  EditScore score{0, 180.0};
  const std::vector<std::uint32_t> replaced = replacedBy(edit);
  const auto isKept = [&replaced](std::uint32_t t) { return !std::ranges::binary_search(replaced, t); };
  if (std::ranges::any_of(scale.turned, isKept)) return worst;
  for (const EditedTriangle& triangle : edit.triangles) {
    const auto made = scoreTriangle(view, edit, triangle.v);
    if (!made) return worst;
    score.defects += made->defects;
    score.min_angle = std::min(score.min_angle, made->min_angle);
    if (triangle.slot == kNone) continue;
    if (const auto old = scoreTriangle(view, {}, view.grid.triangles[triangle.slot])) score.defects -= old->defects;
  }
  const auto kept = std::ranges::find_if(scale.angles, isKept, &std::pair<double, std::uint32_t>::second);
  if (kept != scale.angles.end()) score.min_angle = std::min(score.min_angle, kept->first);
  if (view.isFor(Target::Dflowfm)) score.defects += edgeDefectsAdded(view, patch, edit, replaced);
  if (view.isFor(Target::Swan)) score.defects += badValencesAdded(view, edit);
  return score;
}

}  // namespace coastmesh
