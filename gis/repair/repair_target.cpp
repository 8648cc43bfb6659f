#include "gis/repair/repair_target.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <span>

#include "core/quality.hpp"
#include "core/run_control.hpp"
#include "gis/check/triangle_overlaps.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/grid/linked_grid.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/grid/one_turn.hpp"
#include "gis/repair/repair_boundaries.hpp"
#include "gis/repair/repair_depths.hpp"
#include "gis/repair/repair_pinches.hpp"
#include "gis/repair/repair_shape.hpp"
#include "gis/repair/repair_state.hpp"
#include "gis/repair/repair_winding.hpp"

namespace coastmesh {
namespace {

constexpr int kMostRounds = 40;
constexpr int kRelaxRounds = 12;
constexpr double kRelaxFrom = 0.9;  // share of the progress when all rounds are done
// Triangles: each takes milliseconds, among many small angles tenths of a second.
constexpr std::size_t kMostShared = 100;

// A round takes about half the time of the one before.
RunControl roundOf(const RunControl& control, int round) {
  const auto at = [](int of) { return kRelaxFrom * (1.0 - std::exp2(-of)); };
  return stageControl(control, {at(round), at(round + 1)});
}

// Advice that repairs heed.
bool isRepairedThough(const TargetDefect& advice) { return advice.kind == TargetDefectKind::OneNeighbour; }

// Crests and beds are made to fit one another when all else is done: see `fitWeirsToBeds`.
bool isLeftToWeirs(const TargetDefect& defect) { return defect.kind == TargetDefectKind::BedAboveCrest; }

std::vector<FoundDefect> findDefects(const Grid& grid, const LinkedGrid& linked, std::span<const Target> targets,
                                     const RepairOptions& options, const ItemLoop& loop) {
  std::vector<FoundDefect> found;
  for (const Target target : targets)
    for (TargetDefect& defect : checkTarget(grid, linked, target, {.overlaps = false}, loop))
      if (!isLeftToWeirs(defect) && (!defect.advice || isRepairedThough(defect)))
        found.push_back({target, std::move(defect)});
  if (options.time_step_s > 0.0 && !grid.z.empty())
    for (TargetDefect& defect : checkTimeStep(grid, options.time_step_s, loop))
      found.push_back({{}, std::move(defect)});
  std::ranges::stable_partition(found, [](const FoundDefect& one) { return !one.defect.advice; });
  return found;
}

// No repair removes overlaps, so they are searched for once, not in every round.
std::vector<FoundDefect> findOverlaps(const Grid& grid, const LinkedGrid& linked, std::span<const Target> targets,
                                      const ItemLoop& loop) {
  std::vector<FoundDefect> found;
  if (targets.empty()) return found;
  const std::vector<TriangleOverlap> overlaps = triangleOverlaps(grid, linked.mesh, loop);
  for (const Target target : targets)
    for (const auto& [t, other] : overlaps)
      found.push_back({target, {TargetDefectKind::Overlap, middleOf(grid, t), t, -1, 0.0, {}}});
  return found;
}

// Each defect once: several models may reject the same.
std::vector<FoundDefect> withoutRepeats(const std::vector<FoundDefect>& defects) {
  std::vector<FoundDefect> once;
  std::set<std::pair<TargetDefectKind, std::int64_t>> seen;
  for (const FoundDefect& found : defects) {
    const auto& [kind, place, triangle, node, value, text, advice] = found.defect;
    const bool has_place = node >= 0 || triangle >= 0;
    if (!has_place || seen.emplace(kind, triangle >= 0 ? triangle : node).second) once.push_back(found);
  }
  return once;
}

bool hasWeirs(const Grid& grid) {
  return std::ranges::any_of(grid.boundaries, [](const Boundary& boundary) { return !boundary.weir.empty(); });
}

// Wrong counts need no repair: they are right once the mesh is written again.
void refuseWeirs(const std::vector<FoundDefect>& defects) {
  const auto wanting = [](const FoundDefect& found) { return found.defect.kind != TargetDefectKind::WrongCount; };
  const auto first = std::ranges::find_if(defects, wanting);
  if (first == defects.end()) return;
  const auto& [kind, place, triangle, node, value, text, advice] = first->defect;
  char at[80];
  std::snprintf(at, sizeof at, "%.10g, %.10g", place.x, place.y);
  throw InputError("the mesh has weirs, so its defects cannot be repaired, " +
                   std::to_string(std::ranges::count_if(defects, wanting)) + " in all, the first at " + at + ": " +
                   std::string(toString(kind)) + (text.empty() ? "" : ", " + text) +
                   "; check lists them; repair them by hand, or remove the weirs");
}

void requireTriangles(const Grid& grid, std::span<const Target> targets) {
  if (!grid.triangles.empty() || targets.empty()) return;
  throw InputError(std::string("no triangle is left once those that ") +
                   kTargetNames[static_cast<std::size_t>(targets.front())] +
                   " refuses are taken out: each stood alone; a smaller --size-max makes more of them");
}

bool isOfBoundaries(TargetDefectKind kind) {
  switch (kind) {
    case TargetDefectKind::NoBoundary:
    case TargetDefectKind::StrayBoundary:
    case TargetDefectKind::BoundaryTwice:
    case TargetDefectKind::BoundaryTurned:
    case TargetDefectKind::LoopedBoundary:
    case TargetDefectKind::WrongShore:
      return true;
    default:
      return false;
  }
}

// Repairs a defect. Boundaries are rebuilt at the end of a round instead.
void mend(RepairState& state, const FoundDefect& found) {
  switch (found.defect.kind) {
    case TargetDefectKind::WrongCount:
      return addRepair(state, found, found.defect.place, "counted anew: " + found.defect.text);
    case TargetDefectKind::UnusedNode:  // removed by `compact`
      return addRepair(state, found, found.defect.place, "node removed");
    case TargetDefectKind::PinchedNode:
      return doublePinchedNode(state, found);
    case TargetDefectKind::OrphanCell:
      return takeOutOrphan(state, found);
    case TargetDefectKind::LoneWall:
      return openLoneWall(state, found);
    case TargetDefectKind::DryOpening:
      return lowerDryOpening(state, found);
    case TargetDefectKind::TwoOpenEdges:
    case TargetDefectKind::OpenAndSolid:
    case TargetDefectKind::OpenBridge:
    case TargetDefectKind::OneNeighbour:
    case TargetDefectKind::LargeAngle:
    case TargetDefectKind::NotOrthogonal:
      return reshapeTriangle(state, found);
    case TargetDefectKind::SmallFlowLink:
      return lengthenFlowLink(state, found);
    case TargetDefectKind::Valence:
      return mendValence(state, found);
    case TargetDefectKind::Courant:
      return lengthenEdges(state, found);
    case TargetDefectKind::Clockwise:  // repaired before all others
    case TargetDefectKind::NoBoundary:
    case TargetDefectKind::StrayBoundary:
    case TargetDefectKind::BoundaryTwice:
    case TargetDefectKind::BoundaryTurned:
    case TargetDefectKind::LoopedBoundary:
    case TargetDefectKind::WrongShore:
    case TargetDefectKind::BrokenEdge:
    case TargetDefectKind::Overlap:
    case TargetDefectKind::RepeatedNode:
    case TargetDefectKind::HangingNode:
    case TargetDefectKind::UnknownDepth:
    case TargetDefectKind::RoundTheGlobe:  // longitudes are already unwrapped if they can be
    case TargetDefectKind::Quadrilateral:  // split at first
    case TargetDefectKind::BedAboveCrest:  // see `findDefects`
      return;
  }
}

// True if no repair changes a boundary edge; boundaries are then rebuilt once, at the end.
bool keepsBoundaries(const RepairState& state) { return state.targets.empty() && !state.options.shore_moves; }

// True if a round repaired so many of the defects that another one is worth its time.
bool isWorthwhile(std::size_t repaired, std::size_t defects) {
  constexpr std::size_t kLeast = 1000;  // one in so many
  return repaired > 0 && repaired >= defects / kLeast;
}

// `mesh` is that in which the defects were found. Returns whether another round may find more to do. Defects of
// boundaries alone warrant one more round only, since those that `cutLoops` cannot repair remain.
bool mendRound(RepairState& state, TriMesh mesh, const std::vector<FoundDefect>& defects, bool& boundaries_done,
               const RunControl& control) {
  constexpr std::size_t kStride = 1024;  // between checkpoints
  startRound(state, std::move(mesh));
  const std::size_t repairs_before = state.report.repairs.size();
  std::vector<FoundDefect> of_boundaries;
  const std::vector<FoundDefect> once = withoutRepeats(defects);
  mendClockwise(state, once);
  // The other defects were found while these triangles were not linked to their neighbours: search again.
  if (state.report.repairs.size() > repairs_before) return true;
  for (std::size_t i = 0; i < once.size(); ++i) {
    if (i % kStride == 0) control.checkpoint(static_cast<double>(i) / static_cast<double>(once.size()));
    if (isOfBoundaries(once[i].defect.kind)) of_boundaries.push_back(once[i]);
    mend(state, once[i]);
  }
  const std::size_t repaired = state.report.repairs.size() - repairs_before;
  const bool changed = repaired > 0;
  state.grid.notes.clear();
  if (!changed && of_boundaries.empty()) return false;
  if (changed) compact(state);
  const std::size_t boundaries_before = state.grid.boundaries.size();
  if (!keepsBoundaries(state)) rebuildBoundaries(state);
  reportRebuilt(state, of_boundaries, boundaries_before);
  const bool again = isWorthwhile(repaired, once.size()) || !boundaries_done;
  boundaries_done = true;
  return again;
}

double smallestAngle(const Grid& grid, std::size_t t, EarthShape shape) {
  const auto p = localPlane(grid, grid.triangles[t], shape);
  return leastAngleDeg(p[0], p[1], p[2]);
}

void measureChanged(Grid& grid, const std::vector<bool>& changed, EarthShape shape) {
  std::vector<GridCorners> corners;
  std::vector<std::size_t> which;
  for (std::size_t t = 0; t < changed.size(); ++t) {
    if (!changed[t]) continue;
    which.push_back(t);
    corners.push_back(grid.triangles[t]);
    if (!grid.min_angle_deg.empty()) grid.min_angle_deg[t] = smallestAngle(grid, t, shape);
  }
  if (grid.area_m2.empty() || which.empty()) return;
  const std::vector<double> areas = areasOfFew(grid.nodes, corners, grid.crs);
  for (std::size_t k = 0; k < which.size(); ++k) grid.area_m2[which[k]] = areas[k];
}

std::vector<std::uint32_t> sharpened(const RepairState& state) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t t = 0; t < state.grid.triangles.size(); ++t)
    if (state.changed[t] && smallestAngle(state.grid, t, state.shape()) < state.options.min_angle_deg - kAngleSlackDeg)
      found.push_back(t);
  return found;
}

// Repairs may leave small angles; this pass changes the triangles and nodes around to enlarge them. Returns whether it
// changed any.
bool relax(RepairState& state, const RunControl& control) {
  bool changed = false;
  for (int round = 0; round < kRelaxRounds; ++round) {
    control.checkpoint(static_cast<double>(round) / kRelaxRounds);
    const std::vector<std::uint32_t> small = sharpened(state);
    if (small.empty()) return changed;
    startRound(state);
    bool any = false;
    for (const std::uint32_t t : small)
      if (relaxTriangle(state, t)) any = true;
    if (!any) break;
    changed = true;
    if (std::ranges::count(state.dead, true) == 0) continue;
    compact(state);
    if (!keepsBoundaries(state)) rebuildBoundaries(state);
  }
  const std::vector<std::uint32_t> small = sharpened(state);
  if (small.empty() || small.size() > kMostShared) return changed;
  startRound(state);
  for (const std::uint32_t t : small) {
    control.checkpoint(1.0);
    if (shareSmallAngle(state, t)) changed = true;
  }
  return changed;
}

void reportLeft(std::vector<FoundDefect> defects, RepairReport& report) {
  for (FoundDefect& found : defects)
    if (found.target && !found.defect.advice) report.left.emplace_back(*found.target, std::move(found.defect));
}

// A flag for each node: true at one of these places.
std::vector<bool> nodesAt(std::span<const Point> nodes, std::vector<Point> places) {
  std::vector<bool> flags;
  if (places.empty()) return flags;
  std::ranges::sort(places, lexLess);
  for (const Point& node : nodes) flags.push_back(std::ranges::binary_search(places, node, lexLess));
  return flags;
}

// Makes triangles of quadrilaterals if a model has only these. Otherwise edits leave them as they are (`startRound`).
void splitUnacceptedQuads(RepairState& state) {
  const auto refusing = std::ranges::find_if_not(state.targets, acceptsQuads);
  const std::vector<Quad> quads = quadsOf(state.grid);
  if (refusing == state.targets.end() || quads.empty()) return;
  const auto& [a, b, c, d] = quads.front().nodes;
  const Point place = placeBetween(state.grid.crs, state.grid.nodes[a], state.grid.nodes[c], 0.5);
  state.grid.quad_of.clear();
  addRepair(state, {*refusing, {TargetDefectKind::Quadrilateral, place, quads.front().halves[0], -1, 0.0, {}}}, place,
            quads.size() == 1 ? std::string("split into two triangles")
                              : std::to_string(quads.size()) + " split into two triangles each, this is the first");
}

// `asked` has a flag for each node, as in GridLinks.
RepairReport repairInOneTurn(Grid& grid, std::span<const Target> targets, const RepairOptions& options,
                             std::vector<bool> asked, RepairMemory* memory, const RunControl& control,
                             const ItemLoop& loop) {
  RepairState state{.grid = grid, .targets = targets, .options = options, .loop = loop};
  splitUnacceptedQuads(state);
  state.links.asked = std::move(asked);
  LinkedGrid linked;
  const auto search = [&] {
    if (!targets.empty()) linked = linkGrid(grid, loop);  // time steps need no links
    return findDefects(grid, linked, targets, options, loop);
  };
  std::vector<FoundDefect> defects = search();
  if (defects.empty()) {
    reportLeft(findOverlaps(grid, linked, targets, loop), state.report);
    return std::move(state.report);
  }
  if (hasWeirs(grid)) {
    refuseWeirs(defects);
    return std::move(state.report);
  }
  if (dropCopies(state, defects)) defects = search();
  startRepairs(state, memory);
  state.links.kinds = takeBoundaryKinds(grid, targets.empty() ? linkGrid(grid, loop).mesh : linked.mesh);
  bool again = true, boundaries_done = false;
  for (int round = 0; round < kMostRounds && again && !defects.empty(); ++round) {
    again = mendRound(state, std::move(linked.mesh), defects, boundaries_done, roundOf(control, round));
    defects = search();
  }
  requireTriangles(grid, targets);
  if (relax(state, stageControl(control, {kRelaxFrom, 1.0})) && !targets.empty()) defects = search();
  reportLeft(std::move(defects), state.report);
  reportLeft(findOverlaps(grid, linked, targets, loop), state.report);
  if (keepsBoundaries(state) && std::ranges::count(state.changed, true) > 0) rebuildBoundaries(state);
  if (memory != nullptr) *memory = memoryOf(state);
  measureChanged(grid, state.changed, state.shape());
  requireConsistent(grid, loop);
  return std::move(state.report);
}

}  // namespace

RepairReport repairForTargets(Grid& grid, std::span<const Target> targets, const RepairOptions& options,
                              RepairMemory* memory, const RunControl& control, const ItemLoop& loop) {
  // Longitudes are unwrapped as in the files that models read: across a jump of 360°, shapes in degrees would be wrong.
  std::vector<bool> asked = nodesAt(grid.nodes, options.asked);
  const TurnedNodes turned(grid, loop);
  RepairReport report = repairInOneTurn(grid, targets, options, std::move(asked), memory, control, loop);
  turned.putBack(grid);
  for (Repair& repair : report.repairs) repair.place = turned.putBack(repair.place);
  for (auto& [target, defect] : report.left) defect.place = turned.putBack(defect.place);
  return report;
}

}  // namespace coastmesh
