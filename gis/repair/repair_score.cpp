#include "gis/repair/repair_score.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "core/quality.hpp"
#include "gis/check/flow_links.hpp"
#include "gis/check/target_limits.hpp"
#include "gis/crs/crs_map.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/long_wave.hpp"

namespace coastmesh {
namespace {

// The grid after an edit; as it is, for `kNoEdit`.
class EditedView {
 public:
  EditedView(const RepairView& of, const PatchEdit& by) : view(of), edit(by) {
    if (view.grid.crs.geographic && edit.placed != kNone) placed_ = inSpace(edit.place);
  }

  template <std::size_t N>
  std::array<Point, N> placesOf(const std::array<std::uint32_t, N>& nodes) const {
    std::array<Point, N> places;
    for (std::size_t i = 0; i < N; ++i) places[i] = nodes[i] == edit.placed ? edit.place : view.grid.nodes[nodes[i]];
    return places;
  }

  template <std::size_t N>
  std::array<Point, N> planeOf(const std::array<std::uint32_t, N>& nodes) const {
    if (!view.grid.crs.geographic) return placesOf(nodes);
    std::array<SphereVector, N> in_space;
    for (std::size_t i = 0; i < N; ++i) in_space[i] = inSpaceOf(nodes[i]);
    std::array<Point, N> places;
    flattenLocally(view.grid.crs, in_space, places);
    return places;
  }

  // The same on the sphere of models, whatever the view's shape of the Earth.
  template <std::size_t N>
  std::array<Point, N> spherePlaneOf(const std::array<std::uint32_t, N>& nodes) const {
    if (!view.grid.crs.geographic || view.shape == EarthShape::Sphere) return planeOf(nodes);
    std::array<SphereVector, N> on_sphere;
    for (std::size_t i = 0; i < N; ++i) on_sphere[i] = fromEllipsoid(inSpaceOf(nodes[i]), view.grid.crs);
    std::array<Point, N> places;
    flattenLocally(view.grid.crs, on_sphere, places);
    return places;
  }

  SphereVector inSpaceOf(std::uint32_t node) const {
    if (node == edit.placed) return placed_;
    if (node >= view.in_space.size()) return inSpace(view.grid.nodes[node]);
    SphereVector& known = view.in_space[node];
    if (std::isnan(known[0])) known = inSpace(view.grid.nodes[node]);
    return known;
  }

  // The largest angle of the triangle in MPAS' file.
  double mpasAngleDeg(const GridCorners& v) const {
    if (view.grid.crs.isPlane()) {
      const auto p = placesOf(v);
      return largestFileAngle(p[0], p[1], p[2]);
    }
    return largestSphereAngle(lonLatOf(v[0]), lonLatOf(v[1]), lonLatOf(v[2]));
  }

  const RepairView& view;
  const PatchEdit& edit;

 private:
  Point lonLatOf(std::uint32_t node) const {
    const Point& place = node == edit.placed ? edit.place : view.grid.nodes[node];
    if (view.to_earth == nullptr) return place;
    Point& known = node == edit.placed ? placed_on_earth_ : view.on_earth[node];
    if (std::isnan(known.x)) known = view.to_earth->forward(place);
    return known;
  }

  SphereVector inSpace(const Point& place) const {
    return coastmesh::inSpace(asLonLat(place), view.grid.crs, view.shape);
  }

  SphereVector placed_{};
  mutable Point placed_on_earth_{std::numeric_limits<double>::quiet_NaN(), 0.0};
};

const PatchEdit kNoEdit;

// A margin for the depths of nodes that an edit places: they are sampled from rasters later.
constexpr double kStepMargin = 1.02;

// The length in metres that edges between these nodes need for the time step; 0 if any will do.
double neededLength(const EditedView& edited, std::span<const std::uint32_t> nodes) {
  const RepairView& view = edited.view;
  if (view.step.time_step_s <= 0.0 || view.grid.z.empty()) return 0.0;
  double deepest = std::numeric_limits<double>::quiet_NaN();
  for (const std::uint32_t node : nodes)
    deepest = std::fmax(deepest, -(node == edited.edit.placed ? edited.edit.z : view.grid.z[node]));
  return deepest > 0.0 ? kStepMargin * view.step.time_step_s * longWaveSpeed(deepest) : 0.0;
}

// True if the triangle, with corners `p` in its plane, allows only a shorter time step than required. It is cut from
// triangle `source`.
bool missesStep(const EditedView& edited, const GridCorners& v, std::uint32_t source, const std::array<Point, 3>& p) {
  const double needed = neededLength(edited, v);
  if (needed <= 0.0) return false;
  const double shortest = std::min({distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0])});
  return shortest * edited.view.step.metres_per_unit[source] < needed;
}

// True if the triangle, with corners `p` in its plane, has an edge below the bound. It is cut from triangle `source`.
bool isShort(const RepairView& view, std::uint32_t source, const std::array<Point, 3>& p) {
  if (view.step.least_edge_m <= 0.0) return false;
  const double shortest = std::min({distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0])});
  return shortest * view.step.metres_per_unit[source] < view.step.least_edge_m;
}

// The local plane of a triangle shorter than `kLittle` distorts its lengths and angles by less than `kBent` and
// `kBentDeg`.
constexpr double kLittle = 1e5;  // metres
constexpr double kBent = 1e-3;   // relative
constexpr double kBentDeg = 0.1;

// Bounds on a triangle from chords through the sphere, at a fraction of the cost of its local plane.
class RoughTriangle {
 public:
  RoughTriangle(const EditedView& edited, const GridCorners& v) {
    std::array<SphereVector, 3> p;
    for (unsigned i = 0; i < 3; ++i) p[i] = edited.inSpaceOf(v[i]);
    for (unsigned i = 0; i < 3; ++i) {
      const SphereVector side = minus(p[prev3(i)], p[next3(i)]);
      squared_[i] = dot(side, side);
    }
    radius_m_ = edited.view.grid.crs.semi_major_m;
  }

  bool isSmall() const { return radius_m_ * radius_m_ * std::ranges::max(squared_) < kLittle * kLittle; }

  // True if an edge is certainly shorter than `length`, in units of the local plane.
  bool hasEdgeBelow(double length) const {
    const double bound = length * (1.0 - kBent);
    return radius_m_ * radius_m_ * std::ranges::min(squared_) < bound * bound;
  }

  // True if an angle is certainly smaller than a limit; `squared_cosine` is that of the limit less `kBentDeg`.
  bool hasAngleBelow(double squared_cosine) const {
    for (unsigned i = 0; i < 3; ++i) {
      const double one = squared_[next3(i)], other = squared_[prev3(i)];
      const double twice = one + other - squared_[i];  // twice the product of both sides and the cosine between them
      if (twice > 0.0 && twice * twice > 4.0 * squared_cosine * one * other) return true;
    }
    return false;
  }

 private:
  std::array<double, 3> squared_{};  // squared lengths of the edges opposite the corners, in semi-major axes
  double radius_m_ = 0.0;
};

// True if a triangle that is counter-clockwise in its local plane certainly is so on the ground. Metres: places in the
// plane are rounded to some nanometres, and it distorts less than a hundred kilometres by little.
bool isClearOfRounding(const std::array<Point, 3>& p) {
  constexpr double kShort = 1.0, kLong = 1e5, kClear = 1e-3;
  const double longest =
      std::max({squaredDistance(p[0], p[1]), squaredDistance(p[1], p[2]), squaredDistance(p[2], p[0])});
  return longest > kShort * kShort && longest < kLong * kLong && cross(p[1] - p[0], p[2] - p[0]) > kClear * longest;
}

// True if the triangle, with corners `p` in its plane, is counter-clockwise there and on the ground.
bool isUpright(const EditedView& edited, const GridCorners& v, const std::array<Point, 3>& p) {
  if (orient2d(p[0], p[1], p[2]) <= 0) return false;
  const Crs& crs = edited.view.grid.crs;
  if (crs.geographic && isClearOfRounding(p)) return true;
  // The plane is rounded, so nearly flat triangles are tested by the nodes' own places, as `turnedTriangles` does.
  const auto on_ground = edited.placesOf(v);
  return orientationOnGround(on_ground[0], on_ground[1], on_ground[2], crs) > 0;
}

// What FVCOM rejects of a triangle with these boundary edges; see `checkTarget`.
int fvcomDefects(const EditedView& edited, const GridCorners& v, int open, int solid) {
  int defects = open > 1 ? 1 : 0;
  std::array<NodeMark, 3> marks{};
  for (unsigned i = 0; i < 3; ++i) marks[i] = markOf(edited.view, edited.edit, v[i]);
  const bool has_shore = std::ranges::count(marks, NodeMark::Shore) > 0;
  defects += open > 0 && (solid > 0 || has_shore) ? 1 : 0;
  bool has_bridge = false;
  for (unsigned i = 0; i < 3; ++i)
    has_bridge |= marks[i] == NodeMark::Open && marks[next3(i)] == NodeMark::Open &&
                  kindOf(edited.view, edited.edit, v[i], v[next3(i)]) == nullptr;
  return defects + (has_bridge ? 1 : 0);
}

int triangleDefects(const EditedView& edited, const GridCorners& v, std::uint32_t source,
                    const std::array<Point, 3>& p) {
  const RepairView& view = edited.view;
  int defects = missesStep(edited, v, source, p) ? 1 : 0;
  if (view.isFor(Target::Swan)) {
    const auto q = edited.placesOf(v);
    defects += largestFileAngle(q[0], q[1], q[2]) > kSwanLargestAngleDeg;
  }
  if (view.isFor(Target::Mpas)) defects += edited.mpasAngleDeg(v) > kMpasLargestAngleDeg;
  int open = 0, solid = 0;
  for (unsigned i = 0; i < 3; ++i) {
    const BoundaryKind* const kind = kindOf(view, edited.edit, v[i], v[next3(i)]);
    if (kind == nullptr) continue;
    if (kind->role == BoundaryRole::Open)
      ++open;
    else
      ++solid;
  }
  int advice = 0;
  if (view.isFor(Target::Fvcom)) {
    defects += fvcomDefects(edited, v, open, solid);
    advice = open == 0 && solid == 2 ? 1 : 0;
  }
  const int neighbours = 3 - open - solid;
  if (view.isFor(Target::Fesom)) defects += neighbours > 0 && neighbours < kFesomFewestNeighbours;
  return kDefectWeight * (defects + (neighbours == 0 ? 1 : 0)) + advice;
}

std::ranges::minmax_result<double> anglesOf(const std::array<Point, 3>& p) {
  return std::ranges::minmax(anglesDeg(p[0], p[1], p[2]));
}

// The score of a triangle as it is; nullopt if it is clockwise or without area.
std::optional<TriangleScore> scoreTriangle(const RepairView& view, std::uint32_t t) {
  const EditedView now(view, kNoEdit);
  const GridCorners& v = view.grid.triangles[t];
  const auto p = now.planeOf(v);
  if (!isUpright(now, v, p)) return std::nullopt;
  const auto [least, largest] = anglesOf(p);
  return TriangleScore{triangleDefects(now, v, t, p), least, largest, isShort(view, t, p)};
}

// The same, cached in `scale`.
const std::optional<TriangleScore>& scoreBefore(const RepairView& view, const PatchScale& scale, std::uint32_t t) {
  const auto known = std::ranges::find(scale.replaced, t, [](const auto& entry) { return entry.first; });
  if (known != scale.replaced.end()) return known->second;
  return scale.replaced.emplace_back(t, scoreTriangle(view, t)).second;
}

// The triangles that the edit changes or removes, ascending.
std::vector<std::uint32_t> replacedBy(const PatchEdit& edit) {
  std::vector<std::uint32_t> replaced;
  for (const EditedTriangle& triangle : edit.triangles)
    if (triangle.slot != kNone) replaced.push_back(triangle.slot);
  replaced.insert(replaced.end(), edit.removed.begin(), edit.removed.end());
  std::ranges::sort(replaced);
  return replaced;
}

int edgeDefects(const EditedView& edited, const NodePair& edge, std::span<const std::uint32_t> apexes) {
  if (apexes.size() != 2) return 0;
  auto p = edited.spherePlaneOf(std::array{edge[0], edge[1], apexes[0], apexes[1]});
  if (orient2d(p[0], p[1], p[2]) < 0) std::swap(p[0], p[1]);
  const FlowLink link = flowLinkAcross(p[0], p[1], p[2], p[3]);
  return (link.cosine > kDflowfmLargestCosine ? 1 : 0) + (link.length < kDflowfmSmallestLink ? 1 : 0);
}

// The change in defects of the edges of triangles that the edit makes or replaces.
int edgeDefectsAdded(const EditedView& edited, const GridPatch& patch, std::span<const std::uint32_t> replaced) {
  const auto& [view, edit] = std::tie(edited.view, edited.edit);
  const EditedView now(view, kNoEdit);
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
    added += edgeDefects(edited, key, after) - edgeDefects(now, key, before);
  }
  return added;
}

// The change in the number of triangles too many or too few around nodes.
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

// True if the edit is certainly below the bar. `score` leaves out the triangles that the edit makes; `may_mend_more` is
// true if defects of edges or nodes, counted later, may still decrease.
bool isRoughlyBelow(const EditedView& edited, const EditScore& score, const ScoreBar& bar, bool may_mend_more) {
  const RepairView& view = edited.view;
  if (!view.grid.crs.geographic) return false;
  const double least_angle_deg = std::min(bar.least_angle_deg, score.replaced_angle) - kBentDeg;
  const double cosine = std::cos(std::max(0.0, least_angle_deg) * std::numbers::pi / 180.0);
  int defects = score.defects;
  for (const EditedTriangle& triangle : edited.edit.triangles) {
    const RoughTriangle rough(edited, triangle.v);
    if (!rough.isSmall()) return false;
    if (least_angle_deg > 0.0 && rough.hasAngleBelow(cosine * cosine)) return true;
    if (may_mend_more) continue;
    const double needed = neededLength(edited, triangle.v);
    if (needed > 0.0 && rough.hasEdgeBelow(needed / view.step.metres_per_unit[triangle.source]))
      defects += kDefectWeight;
    if (defects >= bar.defects) return true;
  }
  return false;
}

}  // namespace

PatchScale scaleOf(const RepairView& view, const GridPatch& patch) {
  PatchScale scale;
  for (const std::uint32_t t : patch.triangles) {
    double& angle = view.smallest_angle[t];
    if (std::isnan(angle)) {
      const auto score = scoreTriangle(view, t);
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

EditScore scoreOf(const RepairView& view, const GridPatch& patch, const PatchScale& scale, const PatchEdit& edit) {
  return scoreAbove(view, patch, scale, edit, {}).value_or(EditScore{kTurnedOver, 0.0});
}

std::optional<EditScore> scoreAbove(const RepairView& view, const GridPatch& patch, const PatchScale& scale,
                                    const PatchEdit& edit, const ScoreBar& bar) {
  EditScore score{0, 180.0};
  const std::vector<std::uint32_t> replaced = replacedBy(edit);
  const auto isKept = [&replaced](std::uint32_t t) { return !std::ranges::binary_search(replaced, t); };
  if (std::ranges::any_of(scale.turned, isKept)) return std::nullopt;
  for (const std::uint32_t t : replaced) {
    const auto& old = scoreBefore(view, scale, t);
    score.defects -= old ? old->defects : 0;
    score.replaced_angle = std::min(score.replaced_angle, old ? old->min_angle : 0.0);
    score.replaced_largest = std::max(score.replaced_largest, old ? old->max_angle : 180.0);
    score.short_added -= old && old->is_short;
  }
  const auto kept = std::ranges::find_if(scale.angles, isKept, &std::pair<double, std::uint32_t>::second);
  if (kept != scale.angles.end()) score.min_angle = std::min(score.min_angle, kept->first);

  // A further triangle can only add defects and make angles worse, so a score below the bar stays below it. Defects of
  // edges and nodes are counted last, and may decrease: if models limit these, only angles can rule out an edit early.
  const bool of_edges = view.isFor(Target::Dflowfm), of_nodes = view.isFor(Target::Swan) || view.isFor(Target::Fesom);
  const auto mayReach = [&] {
    EditScore hoped = score;
    if (of_edges || of_nodes) hoped.defects = std::numeric_limits<int>::min();
    return bar.isReachedBy(hoped);
  };
  const EditedView edited(view, edit);
  if (isRoughlyBelow(edited, score, bar, of_edges || of_nodes)) return std::nullopt;
  std::vector<std::array<Point, 3>> shapes;
  shapes.reserve(edit.triangles.size());
  for (const EditedTriangle& triangle : edit.triangles) {
    const std::array<Point, 3>& p = shapes.emplace_back(edited.planeOf(triangle.v));
    if (!isUpright(edited, triangle.v, p)) return std::nullopt;
    score.defects += triangleDefects(edited, triangle.v, triangle.source, p);
    score.short_added += isShort(view, triangle.source, p);
    if (!mayReach()) return std::nullopt;
  }
  for (const std::array<Point, 3>& p : shapes) {
    const auto [least, largest] = anglesOf(p);
    score.made_angle = std::min(score.made_angle, least);
    score.made_largest = std::max(score.made_largest, largest);
    score.min_angle = std::min(score.min_angle, score.made_angle);
    if (!mayReach()) return std::nullopt;
  }
  if (of_edges) score.defects += kDefectWeight * edgeDefectsAdded(edited, patch, replaced);
  if (of_nodes) score.defects += kDefectWeight * badValencesAdded(view, edit, replaced);
  return bar.isReachedBy(score) ? std::optional(score) : std::nullopt;
}

bool moveMayMend(const RepairView& view, const PatchScale& scale, std::uint32_t node) {
  if (view.isFor(Target::Dflowfm) || !scale.turned.empty()) return true;
  const EditedView now(view, kNoEdit);
  int to_mend = 0;
  for (const std::uint32_t t : view.links.triangles_at[node]) {
    const auto& score = scoreBefore(view, scale, t);
    if (!score) return true;
    to_mend += score->defects;
    if (score->defects == 0) continue;
    const GridCorners& v = view.grid.triangles[t];
    const auto p = now.planeOf(v);
    const auto k = static_cast<unsigned>(std::ranges::find(v, node) - v.begin());
    const double across = distance(p[next3(k)], p[prev3(k)]);
    const double longest = std::max({across, distance(p[k], p[next3(k)]), distance(p[k], p[prev3(k)])});
    const double needed = neededLength(now, std::array{v[next3(k)], v[prev3(k)]});
    if (needed > 0.0 && longest < kLittle && across * view.step.metres_per_unit[t] < needed * (1.0 - kBent))
      to_mend -= kDefectWeight;
  }
  return to_mend > 0;
}

}  // namespace coastmesh
