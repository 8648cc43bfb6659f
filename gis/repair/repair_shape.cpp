#include "gis/repair/repair_shape.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <ranges>
#include <set>
#include <string_view>
#include <utility>

#include "core/predicates.hpp"
#include "core/quality.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/repair/repair_score.hpp"
#include "gis/repair/repair_search.hpp"

namespace coastmesh {
namespace {

constexpr std::array kShares{0.5, 0.4, 0.6, 0.3, 0.7};
// Tried if these fail: at a sharp corner of the input, an edge must be split near its end.
constexpr std::array kFarShares{0.2, 0.8, 0.15, 0.85, 0.1, 0.9, 0.05, 0.95};

// The patch around the triangles; nullopt if part of it has changed in this round: a later round tries again.
std::optional<GridPatch> untouchedPatch(const RepairState& state, std::span<const std::uint32_t> middle) {
  if (state.anyTaken(middle)) return std::nullopt;
  // Checked node by node, so that after a change beside a node with many triangles all other attempts there end early.
  const auto isTaken = [&](std::uint32_t node) { return state.anyTaken(state.links.triangles_at[node]); };
  if (std::ranges::any_of(nodesOf(state.grid, middle), isTaken)) return std::nullopt;
  return patchRound(state.view(), middle);
}

void placeNode(RepairState& state, const PatchEdit& edit) {
  const auto [a, b] = edit.nodes;
  switch (edit.kind) {
    case PatchEditKind::EdgeFlip:
      return;
    case PatchEditKind::EdgeSplit:
      addNodeBetween(state.grid, a, b, edit.share);
      if (state.links.line_edges.erase(edgeKey(a, b)) > 0)
        state.links.line_edges.insert({edgeKey(a, edit.placed), edgeKey(edit.placed, b)});
      return;
    case PatchEditKind::NodeSplit:
      copyNode(state.grid, a, edit.place);
      return;
    case PatchEditKind::NodeMove:
      moveNode(state.grid, edit.placed, a, b, edit.share);
      return;
    case PatchEditKind::EdgeCollapse:
      if (edit.share > 0.0) moveNode(state.grid, edit.placed, b, b, edit.share);
      return;
    case PatchEditKind::CornerCut:
      return;
  }
}

std::string_view textOf(PatchEditKind kind) {
  constexpr std::array<std::string_view, 6> kTexts{"edge flipped", "edge split",     "node split in two",
                                                   "node moved",   "edge collapsed", "corner cut off"};
  return kTexts[static_cast<std::size_t>(kind)];
}

void applyEdit(RepairState& state, const GridPatch& patch, const PatchEdit& edit) {
  placeNode(state, edit);
  for (const NodePair& edge : edit.gone) state.links.kinds.erase(edge);
  for (const auto& [edge, kind] : edit.made) state.links.kinds[edge] = kind;
  for (const std::uint32_t t : edit.removed) state.dead[t] = true;
  for (const std::uint32_t t : patch.triangles) state.touched[t] = true;
  for (const EditedTriangle& triangle : edit.triangles) {
    if (triangle.slot == kNone) {
      copyTriangle(state.grid, triangle.source, triangle.v);
      for (std::vector<bool>* flags : {&state.touched, &state.changed, &state.disturbed}) flags->push_back(true);
      state.dead.push_back(false);
      continue;
    }
    state.grid.triangles[triangle.slot] = triangle.v;
    state.changed[triangle.slot] = state.disturbed[triangle.slot] = true;
  }
}

void applyRepair(RepairState& state, const GridPatch& patch, const PatchEdit& edit, const FoundDefect& found) {
  applyEdit(state, patch, edit);
  addRepair(state, found, found.defect.place, std::string(textOf(edit.kind)), edit.kind == PatchEditKind::EdgeSplit);
}

// `made`: edits were searched for; `done`: one was applied.
struct Attempt {
  bool made = false, done = false;
};

Attempt splitNode(RepairState& state, std::uint32_t node, const FoundDefect& found) {
  const auto patch = untouchedPatch(state, state.links.triangles_at[node]);
  if (!patch) return {};
  const std::optional<PatchEdit> chosen = bestNodeSplit(state.view(), node, *patch);
  if (chosen) applyRepair(state, *patch, *chosen, found);
  return {true, chosen.has_value()};
}

// The triangles and those across their edges.
std::vector<std::uint32_t> withNeighbours(const TriMesh& mesh, std::span<const std::uint32_t> triangles) {
  std::set<std::uint32_t> concerned(triangles.begin(), triangles.end());
  for (const std::uint32_t t : triangles)
    for (const EdgeRef twin : mesh.triangles[t].adj)
      if (twin != kNone) concerned.insert(triOf(twin));
  return {concerned.begin(), concerned.end()};
}

Attempt reshape(RepairState& state, std::span<const std::uint32_t> inside, const SearchReach& reach,
                const FoundDefect& found) {
  std::vector<std::uint32_t> middle(inside.begin(), inside.end());
  for (const std::uint32_t node : reach.movable)
    middle.insert(middle.end(), state.links.triangles_at[node].begin(), state.links.triangles_at[node].end());
  const auto patch = untouchedPatch(state, middle);
  if (!patch) return {};
  const std::optional<PatchEdit> chosen = bestReshaping(state.view(), inside, reach, *patch);
  if (chosen) applyRepair(state, *patch, *chosen, found);
  return {true, chosen.has_value()};
}

// Ascending.
std::vector<std::uint32_t> movableNodes(const RepairState& state, std::span<const std::uint32_t> nodes) {
  std::vector<std::uint32_t> movable;
  for (const std::uint32_t node : nodes)
    if (isMovable(state.view(), node)) movable.push_back(node);
  std::ranges::sort(movable);
  return movable;
}

std::vector<std::uint32_t> movableCorners(const RepairState& state, std::span<const std::uint32_t> triangles) {
  std::set<std::uint32_t> nodes;
  for (const std::uint32_t t : triangles)
    nodes.insert(state.links.mesh.triangles[t].v.begin(), state.links.mesh.triangles[t].v.end());
  return movableNodes(state, std::vector<std::uint32_t>(nodes.begin(), nodes.end()));
}

// The triangles at a triangle's corners. REQUIRES: it is not taken, as it may have a node then that has no links yet.
std::vector<std::uint32_t> roundOf(const RepairState& state, std::uint32_t t) {
  std::vector<std::uint32_t> round;
  for (const std::uint32_t node : state.grid.triangles[t])
    round.insert(round.end(), state.links.triangles_at[node].begin(), state.links.triangles_at[node].end());
  return round;
}

// Removes an inner node of three triangles, which become one.
void takeOutNode(RepairState& state, std::uint32_t node, const FoundDefect& found) {
  const std::vector<std::uint32_t>& round = state.links.triangles_at[node];
  if (round.size() < 3 || !isMovable(state.view(), node) || state.anyTaken(round)) return;
  GridCorners corners = state.grid.triangles[round[0]];
  // The corner of the others that the first lacks replaces the node.
  for (const std::uint32_t other : state.grid.triangles[round[1]])
    if (std::ranges::count(corners, other) == 0) std::ranges::replace(corners, node, other);
  state.grid.triangles[round[0]] = corners;
  for (const std::uint32_t t : round) state.touched[t] = state.disturbed[t] = true;
  state.changed[round[0]] = state.dead[round[1]] = state.dead[round[2]] = true;
  addRepair(state, found, found.defect.place, "node removed");
}

// Degrees: the smallest angle of the triangles around an inner node moved to `place`; 0 if one is not
// counter-clockwise.
double leastAngleRound(const RepairView& view, std::span<const std::uint32_t> ring, const Point& place) {
  const Grid& grid = view.grid;
  double least = 180.0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    std::array<Point, 3> p{place, grid.nodes[ring[k]], grid.nodes[ring[(k + 1) % ring.size()]]};
    flattenLocally(grid.crs, p, view.shape);
    if (orient2d(p[0], p[1], p[2]) <= 0) return 0.0;
    least = std::min(least, leastAngleDeg(p[0], p[1], p[2]));
  }
  return least;
}

// The move of an inner node that leaves the largest such angle, if larger than `least`, which is raised to it.
std::optional<PatchEdit> bestUnfolding(const RepairView& view, std::uint32_t node, double& least) {
  constexpr std::size_t kMostNeighbours = 16;
  std::optional<PatchEdit> best;
  const std::vector<std::uint32_t> ring = ringRound(view, node);
  if (ring.size() > kMostNeighbours || !isMovable(view, node)) return best;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    for (std::size_t j = i + 2; j < ring.size(); ++j) {
      PatchEdit edit = moveOf(view, node, ring[i], ring[j], 1.0);
      const double angle = leastAngleRound(view, ring, edit.place);
      if (angle <= least) continue;
      least = angle;
      best = std::move(edit);
    }
  }
  return best;
}

// Moves of nodes that can be undone.
class MovedNodes {
 public:
  explicit MovedNodes(RepairState& state) : state_(state) {}

  void move(std::uint32_t node, const GridPatch& patch, const PatchEdit& edit) {
    remember(node);
    applyEdit(state_, patch, edit);
    forgetMeasures(node);
  }

  // Without marking triangles as changed: for moves that are put back in any case.
  void tryOut(std::uint32_t node, const PatchEdit& edit) {
    remember(node);
    placeNode(state_, edit);
    forgetMeasures(node);
  }

  void putBack() {
    for (const auto& [node, place, z] : std::views::reverse(moves_)) {
      state_.grid.nodes[node] = place;
      if (!state_.grid.z.empty()) state_.grid.z[node] = z;
      forgetMeasures(node);
    }
    moves_.clear();
  }

 private:
  struct Move {
    std::uint32_t node;
    Point place;  // before
    double z;
  };

  void remember(std::uint32_t node) {
    const Grid& grid = state_.grid;
    moves_.push_back({node, grid.nodes[node], grid.z.empty() ? 0.0 : grid.z[node]});
  }

  void forgetMeasures(std::uint32_t node) {
    constexpr double kUnmeasured = std::numeric_limits<double>::quiet_NaN();
    for (const std::uint32_t t : state_.links.triangles_at[node]) state_.smallest_angle[t] = kUnmeasured;
    if (!state_.in_space.empty()) state_.in_space[node][0] = kUnmeasured;
    if (!state_.on_earth.empty()) state_.on_earth[node].x = kUnmeasured;
  }

  RepairState& state_;
  std::vector<Move> moves_;
};

// For a triangle in a corner of the boundary, both of whose edges there are too short: slides the one's end, then
// searches for the edit that lengthens the other. Returns whether there is such a pair.
bool lengthenLegs(RepairState& state, std::uint32_t t, std::span<const std::uint32_t> movable, const GridPatch& patch,
                  const FoundDefect& found) {
  for (const std::uint32_t node : movable) {
    for (const PatchEdit& slide : harmlessSlides(state.view(), node, patch)) {
      MovedNodes trial(state);
      trial.tryOut(node, slide);
      const std::optional<PatchEdit> chosen = bestLengthening(state.view(), t, movable, patch);
      trial.putBack();
      if (!chosen) continue;
      applyEdit(state, patch, slide);
      applyRepair(state, patch, *chosen, found);
      return true;
    }
  }
  return false;
}

// A reshaping, after the move of a node if there is one.
struct ReshapingOfCorner {
  std::optional<PatchEdit> move{};
  PatchEdit reshaping{};
  EditScore score{};
};

// The best reshaping of `inside`. Where none keeps the minimum angle, or each leaves another defect, for instance
// because several models are requested, those after a move of a node are tried too. REQUIRES: `patch` surrounds
// `inside` and the triangles of the movable nodes.
std::optional<ReshapingOfCorner> bestReshapingOfCorner(RepairState& state, std::span<const std::uint32_t> inside,
                                                       std::span<const std::uint32_t> movable, const GridPatch& patch) {
  std::optional<ReshapingOfCorner> best;
  const auto offer = [&](const PatchEdit* move) {
    const RepairView view = state.view();
    const std::optional<PatchEdit> reshaping = bestReshaping(view, inside, {kShares, {}}, patch);
    if (!reshaping) return;
    const EditScore score = scoreOf(view, patch, scaleOf(view, patch), *reshaping);
    if (best && !score.betterThan(best->score)) return;
    best = {move == nullptr ? std::nullopt : std::optional(*move), *reshaping, score};
  };
  offer(nullptr);
  if (best && best->score.made_angle >= state.options.min_angle_deg - kAngleSlackDeg) return best;
  for (const std::uint32_t node : movable) {
    for (const PatchEdit& move : harmlessMoves(state.view(), node, patch)) {
      MovedNodes trial(state);
      trial.tryOut(node, move);
      offer(&move);
      trial.putBack();
    }
  }
  return best;
}

Attempt reshapeCorner(RepairState& state, std::span<const std::uint32_t> inside, const FoundDefect& found) {
  const std::vector<std::uint32_t> movable = movableCorners(state, inside);
  std::vector<std::uint32_t> middle(inside.begin(), inside.end());
  for (const std::uint32_t node : movable)
    middle.insert(middle.end(), state.links.triangles_at[node].begin(), state.links.triangles_at[node].end());
  const auto patch = untouchedPatch(state, middle);
  if (!patch) return {};
  const std::optional<ReshapingOfCorner> best = bestReshapingOfCorner(state, inside, movable, *patch);
  if (!best) return {true, false};
  if (best->move) applyEdit(state, *patch, *best->move);
  applyRepair(state, *patch, best->reshaping, found);
  return {true, true};
}

// Cuts off the corner of the boundary at the triangle.
Attempt cutCorner(RepairState& state, std::uint32_t t, const FoundDefect& found) {
  const auto patch = untouchedPatch(state, roundOf(state, t));
  if (!patch) return {};
  const std::optional<PatchEdit> cut = usefulCornerCut(state.view(), t, *patch);
  if (cut) applyRepair(state, *patch, *cut, found);
  return {true, cut.has_value()};
}

// True for a corner of the boundary that is too sharp for two triangles.
bool isTooSharpToDivide(const RepairState& state, std::uint32_t t) {
  const GridCorners& v = state.grid.triangles[t];
  const auto p = localPlane(state.grid, v, state.shape());
  const auto angles = anglesDeg(p[0], p[1], p[2]);
  for (unsigned i = 0; i < 3; ++i)
    if (state.links.triangles_at[v[i]].size() == 1)
      return angles[i] < 2.0 * (state.options.min_angle_deg - kAngleSlackDeg);
  return false;
}

bool isInCorner(const RepairState& state, std::uint32_t t) {
  const GridCorners& v = state.grid.triangles[t];
  int edges = 0;
  for (unsigned i = 0; i < 3; ++i) edges += state.links.kinds.contains(edgeKey(v[i], v[next3(i)]));
  return edges == 2;
}

// Advice is not worth short edges or small angles.
void heedAdvice(RepairState& state, const FoundDefect& found) {
  const auto t = static_cast<std::uint32_t>(found.defect.triangle);
  if (state.hopeless_advice[t] || state.isTaken(t)) return;
  const std::vector<std::uint32_t> inside = withNeighbours(state.links.mesh, std::array{t});
  const double least_angle_deg = state.options.min_angle_deg - kAngleSlackDeg;
  const Attempt attempt = reshape(state, inside, {{}, movableCorners(state, inside), least_angle_deg}, found);
  state.hopeless_advice[t] = attempt.made && !attempt.done;
}

}  // namespace

void unfoldTriangle(RepairState& state, const FoundDefect& found) {
  const auto t = static_cast<std::uint32_t>(found.defect.triangle);
  if (state.hopeless_triangles[t] || state.isTaken(t)) return;
  const auto patch = untouchedPatch(state, roundOf(state, t));
  if (!patch) return;
  std::optional<PatchEdit> best;
  double least = 0.0;
  for (const std::uint32_t node : state.grid.triangles[t]) {
    if (state.links.on_boundary[node]) continue;
    if (std::optional<PatchEdit> edit = bestUnfolding(state.view(), node, least)) best = std::move(edit);
  }
  if (best) applyRepair(state, *patch, *best, found);
  state.hopeless_triangles[t] = !best;
}

void reshapeTriangle(RepairState& state, const FoundDefect& found) {
  if (found.defect.advice) return heedAdvice(state, found);
  const auto t = static_cast<std::uint32_t>(found.defect.triangle);
  if (state.hopeless_triangles[t] || state.isTaken(t)) return;
  const bool of_corner =
      found.defect.kind == TargetDefectKind::TwoOpenEdges || found.defect.kind == TargetDefectKind::OpenAndSolid;
  if (of_corner && isTooSharpToDivide(state, t)) {
    const Attempt cut = cutCorner(state, t, found);
    if (cut.done || !cut.made) return;
  }
  const std::vector<std::uint32_t> inside = withNeighbours(state.links.mesh, std::array{t});
  Attempt attempt = of_corner ? reshapeCorner(state, inside, found) : reshape(state, inside, {kShares, {}}, found);
  if (attempt.made && !attempt.done)
    attempt = reshape(state, inside, {kFarShares, movableCorners(state, inside)}, found);
  if (of_corner && attempt.made && !attempt.done) attempt = cutCorner(state, t, found);
  state.hopeless_triangles[t] = attempt.made && !attempt.done;
}

void lengthenFlowLink(RepairState& state, const FoundDefect& found) {
  const auto t = static_cast<std::uint32_t>(found.defect.triangle);
  if (state.hopeless_triangles[t]) return;
  const std::vector<std::uint32_t> inside = withNeighbours(state.links.mesh, std::array{t});
  const std::vector<std::uint32_t> movable = movableCorners(state, inside);
  Attempt attempt = reshape(state, inside, {kShares, movable}, found);
  if (attempt.made && !attempt.done) attempt = reshape(state, inside, {kFarShares, {}}, found);
  state.hopeless_triangles[t] = attempt.made && !attempt.done;
}

void lengthenEdges(RepairState& state, const FoundDefect& found) {
  const auto t = static_cast<std::uint32_t>(found.defect.triangle);
  if (state.hopeless_triangles[t] || state.stuck[t] || state.isTaken(t)) return;
  const std::vector<std::uint32_t> movable = movableNodes(state, state.grid.triangles[t]);
  if (movable.empty()) {  // held by the shore or lines at all corners
    state.stuck[t] = true;
    return;
  }
  const auto patch = untouchedPatch(state, roundOf(state, t));
  if (!patch) return;
  const std::optional<PatchEdit> chosen = bestLengthening(state.view(), t, movable, *patch);
  if (chosen) applyRepair(state, *patch, *chosen, found);
  if (!chosen && isInCorner(state, t) && lengthenLegs(state, t, movable, *patch, found)) return;
  state.hopeless_triangles[t] = !chosen;
  state.stuck[t] = !chosen && mendsByCornersAlone(state.view(), *patch);
}

bool relaxTriangle(RepairState& state, std::uint32_t t) {
  if (state.isTaken(t)) return false;
  const auto patch = untouchedPatch(state, roundOf(state, t));
  if (!patch) return false;
  const std::optional<PatchEdit> chosen =
      bestRelaxing(state.view(), t, movableNodes(state, state.grid.triangles[t]), *patch);
  if (chosen) applyEdit(state, *patch, *chosen);
  return chosen.has_value();
}

bool shareSmallAngle(RepairState& state, std::uint32_t t) {
  constexpr int kRings = 3, kMostSweeps = 80;
  constexpr double kBeyondDeg = 1.0;  // above the bound: larger angles are free to become smaller
  constexpr double kHardly = 0.998;   // sweeps that leave more of the lack than this lead nowhere
  const RepairView view = state.view();
  const double bound = state.options.min_angle_deg - kAngleSlackDeg, goal = state.options.min_angle_deg + kBeyondDeg;
  std::vector<std::uint32_t> around{t};
  for (int ring = 0; ring < kRings; ++ring) around = patchRound(view, around).triangles;
  const std::vector<std::uint32_t> movable = movableNodes(state, nodesOf(state.grid, around));
  const std::vector<std::uint32_t> affected = patchRound(view, around).triangles;
  const auto countSmall = [&] {
    return std::ranges::count_if(affected, [&](std::uint32_t of) {
      const auto p = localPlane(state.grid, state.grid.triangles[of], state.shape());
      return leastAngleDeg(p[0], p[1], p[2]) < bound;
    });
  };
  const auto small_before = countSmall();
  if (small_before == 0) return false;
  MovedNodes moved(state);
  double lack = lackOfAngles(view, affected, goal);
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    bool any = false;
    for (const std::uint32_t node : movable) {
      const std::vector<std::uint32_t>& star = state.links.triangles_at[node];
      if (lackOfAngles(view, star, goal) <= 0.0) continue;
      const GridPatch patch = patchRound(view, star);
      const std::optional<PatchEdit> chosen = bestSharing(view, node, goal, patch);
      if (!chosen) continue;
      moved.move(node, patch, *chosen);
      any = true;
    }
    const double before = std::exchange(lack, lackOfAngles(view, affected, goal));
    if (!any || lack > kHardly * before || countSmall() == 0) break;
  }
  if (countSmall() < small_before) return true;
  moved.putBack();
  return false;
}

void mendValence(RepairState& state, const FoundDefect& found) {
  const auto node = static_cast<std::uint32_t>(found.defect.node);
  const std::vector<std::uint32_t>& round = state.links.triangles_at[node];
  if (round.size() <= 3 && !state.links.isAsked(node)) return takeOutNode(state, node, found);
  if (state.hopeless_nodes[node]) return;
  const Attempt reshaped = reshape(state, withNeighbours(state.links.mesh, round), {kShares, {}}, found);
  if (reshaped.done) return;
  const Attempt was_split = splitNode(state, node, found);
  state.hopeless_nodes[node] = reshaped.made && was_split.made && !was_split.done;
}

}  // namespace coastmesh
