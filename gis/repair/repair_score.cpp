#include "gis/repair/repair_score.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "core/quality.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/long_wave.hpp"
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

// Depths of nodes that an edit places come from rasters later on: a little is left for what these say.
constexpr double kStepMargin = 1.02;

// Whether the triangle, in a plane, leaves a shorter time step than is asked for. `source` is what it is cut from.
bool missesStep(const RepairView& view, const PatchEdit& edit, const GridCorners& v, std::uint32_t source,
                const std::array<Point, 3>& p) {
  const StepBound& step = view.step;
  if (step.time_step_s <= 0.0 || view.grid.z.empty()) return false;
  double deepest = std::numeric_limits<double>::quiet_NaN();
  for (const std::uint32_t node : v) deepest = std::fmax(deepest, -(node == edit.placed ? edit.z : view.grid.z[node]));
  if (!(deepest > 0.0)) return false;
  const double shortest = std::min({distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0])});
  return shortest * step.metres_per_unit[source] < kStepMargin * step.time_step_s * longWaveSpeed(deepest);
}

// Whether a triangle that runs counter-clockwise in its local plane certainly does so on the ground: lengths in metres,
// places there are rounded to some nanometres, and the plane bends those of less than a hundred kilometres by little.
bool isClearOfRounding(const std::array<Point, 3>& p) {
  constexpr double kShort = 1.0, kLong = 1e5, kClear = 1e-3;
  const double longest =
      std::max({squaredDistance(p[0], p[1]), squaredDistance(p[1], p[2]), squaredDistance(p[2], p[0])});
  return longest > kShort * kShort && longest < kLong * kLong && cross(p[1] - p[0], p[2] - p[0]) > kClear * longest;
}

// None for a triangle that is clockwise, or without area.
std::optional<TriangleScore> scoreTriangle(const RepairView& view, const PatchEdit& edit, const GridCorners& v,
                                           std::uint32_t source) {
  const auto p = planeOf(view, edit, v);
  if (orient2d(p[0], p[1], p[2]) <= 0) return std::nullopt;
  // The plane is rounded: what is flat to within that is asked of the places themselves, as the report does.
  if (!view.grid.crs.geographic || !isClearOfRounding(p)) {
    const auto on_ground = placesOf(view, edit, v);
    if (orientationOnGround(on_ground[0], on_ground[1], on_ground[2], view.grid.crs) <= 0) return std::nullopt;
  }
  const auto angles = anglesDeg(p[0], p[1], p[2]);
  TriangleScore score{missesStep(view, edit, v, source, p) ? 1 : 0, std::ranges::min(angles)};
  if (view.isFor(Target::Swan)) {
    const auto q = placesOf(view, edit, v);
    score.defects += largestFileAngle(q[0], q[1], q[2]) > kSwanLargestAngleDeg;
  }
  if (view.isFor(Target::Mpas)) {
    const auto q = placesOf(view, edit, v);
    score.defects += largestSphereAngle(view.grid.crs, q[0], q[1], q[2]) > kMpasLargestAngleDeg;
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
  const int neighbours = 3 - open - solid;
  if (view.isFor(Target::Fesom)) score.defects += neighbours > 0 && neighbours < kFesomFewestNeighbours;
  score.defects += neighbours == 0;
  return score;
}

// As the triangle is now.
const std::optional<TriangleScore>& scoreBefore(const RepairView& view, const PatchScale& scale, std::uint32_t t) {
  const auto known = std::ranges::find(scale.replaced, t, [](const auto& entry) { return entry.first; });
  if (known != scale.replaced.end()) return known->second;
  return scale.replaced.emplace_back(t, scoreTriangle(view, {}, view.grid.triangles[t], t)).second;
}

// The triangles that are no more as they were, ascending.
std::vector<std::uint32_t> replacedBy(const PatchEdit& edit) {
  std::vector<std::uint32_t> replaced;
  for (const EditedTriangle& triangle : edit.triangles)
    if (triangle.slot != kNone) replaced.push_back(triangle.slot);
  replaced.insert(replaced.end(), edit.removed.begin(), edit.removed.end());
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
    }
  }
  for (const std::uint32_t t : replaced) {
    const GridCorners& old = view.grid.triangles[t];
    for (unsigned i = 0; i < 3; ++i) keys.push_back(edgeKey(old[next3(i)], old[prev3(i)]));
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
int badValencesAdded(const RepairView& view, const PatchEdit& edit, std::span<const std::uint32_t> replaced) {
  std::vector<std::pair<std::uint32_t, int>> changes;
  for (const EditedTriangle& triangle : edit.triangles)
    for (const std::uint32_t node : triangle.v) changes.emplace_back(node, 1);
  for (const std::uint32_t t : replaced)
    for (const std::uint32_t node : view.grid.triangles[t]) changes.emplace_back(node, -1);
  std::ranges::sort(changes);
  const auto bad = [&view](int count, bool inner) {
    if (count == 0) return 0;
    const int for_swan =
        view.isFor(Target::Swan) && inner ? std::max({0, kSwanFewestCells - count, count - kSwanMostCells}) : 0;
    return for_swan + (view.isFor(Target::Fesom) ? std::max(0, count - kFesomMostCells) : 0);
  };
  int added = 0;
  for (std::size_t i = 0; i < changes.size();) {
    const std::uint32_t node = changes[i].first;
    int change = 0;
    for (; i < changes.size() && changes[i].first == node; ++i) change += changes[i].second;
    const bool is_new = node >= view.links.triangles_at.size();
    const bool inner = is_new ? edit.made.empty() : !view.links.on_boundary[node];
    const int count = is_new ? 0 : static_cast<int>(view.links.triangles_at[node].size());
    added += bad(count + change, inner) - bad(count, inner);
  }
  return added;
}

}  // namespace

PatchScale scaleOf(const RepairView& view, const Patch& patch) {
  PatchScale scale;
  for (const std::uint32_t t : patch.triangles) {
    double& angle = view.smallest_angle[t];
    if (std::isnan(angle)) {
      const auto score = scoreTriangle(view, {}, view.grid.triangles[t], t);
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
    const auto made = scoreTriangle(view, edit, triangle.v, triangle.source);
    if (!made) return worst;
    score.defects += made->defects;
    score.made_angle = std::min(score.made_angle, made->min_angle);
  }
  score.min_angle = score.made_angle;
  for (const std::uint32_t t : replaced) {
    const auto& old = scoreBefore(view, scale, t);
    score.defects -= old ? old->defects : 0;
    score.replaced_angle = std::min(score.replaced_angle, old ? old->min_angle : 0.0);
  }
  const auto kept = std::ranges::find_if(scale.angles, isKept, &std::pair<double, std::uint32_t>::second);
  if (kept != scale.angles.end()) score.min_angle = std::min(score.min_angle, kept->first);
  if (view.isFor(Target::Dflowfm)) score.defects += edgeDefectsAdded(view, patch, edit, replaced);
  if (view.isFor(Target::Swan) || view.isFor(Target::Fesom)) score.defects += badValencesAdded(view, edit, replaced);
  return score;
}

}  // namespace coastmesh
