#include "gis/repair/repair_search.hpp"

#include <array>
#include <limits>

#include "core/predicates.hpp"
#include "core/quality.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/repair/repair_score.hpp"
#include "gis/repair/repair_shore.hpp"

namespace coastmesh {
namespace {

// Checked last because it needs a spatial search.
bool keepsShores(const RepairView& view, const PatchEdit& edit) {
  return view.shores == nullptr || view.shores->keepsApart(view, edit);
}

// The best of the offered edits that reduce the patch's defects; the first of equally good ones.
class Contest {
 public:
  // Triangles with an angle below `least_angle_deg` or above `largest_angle_deg` may only replace such triangles.
  Contest(const RepairView& view, const GridPatch& patch, double least_angle_deg = 0.0,
          double largest_angle_deg = 180.0)
      : view_(view),
        patch_(patch),
        scale_(scaleOf(view, patch)),
        now_(scoreOf(scale_)),
        least_angle_deg_(least_angle_deg),
        largest_angle_deg_(largest_angle_deg) {}

  void offer(const PatchEdit& edit) {
    const ScoreBar bar{now_.defects, least_angle_deg_, best_ ? &score_ : nullptr, largest_angle_deg_};
    const std::optional<EditScore> score = scoreAbove(view_, patch_, scale_, edit, bar);
    if (!score || !keepsShores(view_, edit)) return;
    score_ = *score;
    best_ = edit;
  }

  bool moveMayMend(std::uint32_t node) const { return coastmesh::moveMayMend(view_, scale_, node); }

  std::optional<PatchEdit> take() { return std::move(best_); }

 private:
  const RepairView& view_;
  const GridPatch& patch_;
  const PatchScale scale_;
  const EditScore now_;
  const double least_angle_deg_, largest_angle_deg_;
  EditScore score_;
  std::optional<PatchEdit> best_;
};

// How far nodes move, as shares of the way: inner ones, and those that slide along the boundary.
struct MoveShares {
  std::span<const double> inner, slides;
};
constexpr std::array kInner{0.02, 0.05, 0.1, 0.15, 0.2, 0.3};
constexpr std::array kSlides{0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5};
constexpr MoveShares kMoves{kInner, kSlides};
// For sums, which change steadily.
constexpr std::array kFineInner{0.001, 0.004, 0.01, 0.02, 0.05, 0.1, 0.2};
constexpr std::array kFineSlides{0.001, 0.004, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5};
constexpr MoveShares kFineMoves{kFineInner, kFineSlides};

void forEachSlide(const RepairView& view, std::uint32_t node, std::span<const double> shares, auto&& use) {
  for (const std::uint32_t other : slideNeighbours(view, node))
    for (const double share : shares) use(moveOf(view, node, other, other, share));
}

// Moves towards nodes of the ring and midpoints of consecutive ones; on the boundary, along it.
void forEachMove(const RepairView& view, std::uint32_t node, const MoveShares& shares, auto&& use) {
  forEachSlide(view, node, shares.slides, use);
  if (view.links.on_boundary[node]) return;
  const std::vector<std::uint32_t> ring = ringRound(view, node);
  for (const double share : shares.inner) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      use(moveOf(view, node, ring[i], ring[i], share));
      use(moveOf(view, node, ring[i], ring[(i + 1) % ring.size()], share));
    }
  }
}

void offerMoves(Contest& contest, const RepairView& view, std::uint32_t node) {
  if (!contest.moveMayMend(node)) return;
  forEachMove(view, node, kMoves, [&contest](const PatchEdit& edit) { contest.offer(edit); });
}

// True if a shore may lose its corners for a model that needs two neighbours there: splits, the other repair, halve
// edges and angles.
bool mayCutShore(const RepairView& view) {
  return view.shores != nullptr && (view.isFor(Target::Fesom) || view.isFor(Target::Fvcom));
}

// True if some of the boundary edges that the edit removes are shore: it takes off no corner of a frame.
bool isOfShore(const RepairView& view, const PatchEdit& edit) {
  return std::ranges::any_of(edit.gone, [&](const NodePair& edge) { return isShore(view.links.kinds.at(edge)); });
}

// The sum of the squares of what the angles of a triangle lack of `goal_deg`; infinite if it is clockwise. Not of the
// smallest alone: where two are equally small, no move of one node would increase that.
double squaredLack(const RepairView& view, std::array<Point, 3> p, double goal_deg) {
  flattenLocally(view.grid.crs, p, view.shape);
  if (orient2d(p[0], p[1], p[2]) <= 0) return std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (const double angle : anglesDeg(p[0], p[1], p[2])) {
    const double lack = std::max(0.0, goal_deg - angle);
    sum += lack * lack;
  }
  return sum;
}

}  // namespace

std::optional<PatchEdit> bestReshaping(const RepairView& view, std::span<const std::uint32_t> inside,
                                       const SearchReach& reach, const GridPatch& patch) {
  std::set<NodePair> edges;
  for (const std::uint32_t t : inside) {
    const GridCorners& v = view.grid.triangles[t];
    for (unsigned i = 0; i < 3; ++i) edges.insert(edgeKey(v[i], v[next3(i)]));
  }
  Contest contest(view, patch, reach.least_angle_deg);
  for (const std::uint32_t node : reach.movable) offerMoves(contest, view, node);
  for (const auto& [a, b] : edges) {
    if (const auto flip = flipOf(view, patch, a, b)) contest.offer(*flip);
    if (view.links.isOfQuad({a, b})) continue;
    for (const double share : reach.shares) contest.offer(splitOf(view, patch, a, b, share));
  }
  if (mayCutShore(view))
    for (const std::uint32_t t : inside)
      if (const auto cut = cornerCutOf(view, t); cut && isOfShore(view, *cut)) contest.offer(*cut);
  return contest.take();
}

std::optional<PatchEdit> bestLengthening(const RepairView& view, std::uint32_t t,
                                         std::span<const std::uint32_t> movable, const GridPatch& patch) {
  const GridCorners& v = view.grid.triangles[t];
  Contest contest(view, patch, view.step.least_angle_deg, view.step.largest_angle_deg);
  for (const std::uint32_t node : movable) offerMoves(contest, view, node);
  for (unsigned i = 0; i < 3; ++i) {
    for (const auto& [gone, kept] : {std::pair(v[i], v[next3(i)]), std::pair(v[next3(i)], v[i])})
      for (const double share : {0.0, 0.25, 0.5})
        if (const auto edit = collapseOf(view, gone, kept, share)) contest.offer(*edit);
  }
  return contest.take();
}

std::optional<PatchEdit> usefulCornerCut(const RepairView& view, std::uint32_t t, const GridPatch& patch) {
  std::optional<PatchEdit> edit = cornerCutOf(view, t);
  if (edit && !scoreAbove(view, patch, scaleOf(view, patch), *edit, {.defects = 0})) edit.reset();
  return edit;
}

std::vector<PatchEdit> harmlessMoves(const RepairView& view, std::uint32_t node, const GridPatch& patch) {
  const PatchScale scale = scaleOf(view, patch);
  std::vector<PatchEdit> moves;
  forEachMove(view, node, kMoves, [&](PatchEdit&& edit) {
    if (scoreAbove(view, patch, scale, edit, {.defects = 1, .short_added = 0}) && keepsShores(view, edit))
      moves.push_back(std::move(edit));
  });
  return moves;
}

std::vector<PatchEdit> harmlessSlides(const RepairView& view, std::uint32_t node, const GridPatch& patch) {
  const PatchScale scale = scaleOf(view, patch);
  const ScoreBar bar{.defects = 1,
                     .least_angle_deg = view.step.least_angle_deg,
                     .largest_angle_deg = view.step.largest_angle_deg,
                     .short_added = 0};
  std::vector<PatchEdit> slides;
  forEachSlide(view, node, kSlides, [&](PatchEdit&& edit) {
    if (scoreAbove(view, patch, scale, edit, bar) && keepsShores(view, edit)) slides.push_back(std::move(edit));
  });
  return slides;
}

bool mendsByCornersAlone(const RepairView& view, const GridPatch& patch) {
  return view.shores == nullptr && !view.isFor(Target::Dflowfm) && !view.isFor(Target::Swan) &&
         !view.isFor(Target::Fesom) && scaleOf(view, patch).turned.empty();
}

std::optional<PatchEdit> bestRelaxing(const RepairView& view, std::uint32_t t, std::span<const std::uint32_t> movable,
                                      const GridPatch& patch) {
  constexpr double kBetterDeg = 0.1;
  const PatchScale scale = scaleOf(view, patch);
  std::optional<PatchEdit> best;
  double most = 0.0;
  const auto offer = [&](const PatchEdit& edit) {
    const bool changes_it = std::ranges::count(edit.removed, t) > 0 ||
                            std::ranges::any_of(edit.triangles, [t](const EditedTriangle& e) { return e.slot == t; });
    if (!changes_it) return;
    const std::optional<EditScore> score = scoreAbove(
        view, patch, scale, edit, {.defects = 1, .largest_angle_deg = view.step.largest_angle_deg, .short_added = 0});
    if (!score || score->made_angle <= std::max(most, score->replaced_angle + kBetterDeg)) return;
    if (!keepsShores(view, edit)) return;
    most = score->made_angle;
    best = edit;
  };
  const GridCorners& v = view.grid.triangles[t];
  for (unsigned i = 0; i < 3; ++i) {
    if (const auto flip = flipOf(view, patch, v[i], v[next3(i)])) offer(*flip);
    if (std::ranges::count(movable, v[i]) > 0) forEachMove(view, v[i], kMoves, offer);
    for (const auto& [gone, kept] : {std::pair(v[i], v[next3(i)]), std::pair(v[next3(i)], v[i])})
      for (const double share : {0.0, 0.5})
        if (const auto edit = collapseOf(view, gone, kept, share)) offer(*edit);
  }
  return best;
}

double lackOfAngles(const RepairView& view, std::span<const std::uint32_t> triangles, double goal_deg) {
  double sum = 0.0;
  for (const std::uint32_t t : triangles) {
    std::array<Point, 3> p;
    for (unsigned i = 0; i < 3; ++i) p[i] = view.grid.nodes[view.grid.triangles[t][i]];
    sum += squaredLack(view, p, goal_deg);
  }
  return sum;
}

std::optional<PatchEdit> bestSharing(const RepairView& view, std::uint32_t node, double goal_deg,
                                     const GridPatch& patch) {
  constexpr double kWorthwhile = 0.999;
  std::optional<PatchEdit> best;
  double least = kWorthwhile * lackOfAngles(view, view.links.triangles_at[node], goal_deg);
  if (least <= 0.0) return best;
  const PatchScale scale = scaleOf(view, patch);
  forEachMove(view, node, kFineMoves, [&](const PatchEdit& edit) {
    double lack = 0.0;
    for (const EditedTriangle& triangle : edit.triangles) {
      std::array<Point, 3> p;
      for (unsigned i = 0; i < 3; ++i)
        p[i] = triangle.v[i] == edit.placed ? edit.place : view.grid.nodes[triangle.v[i]];
      lack += squaredLack(view, p, goal_deg);
      if (lack >= least) return;
    }
    const ScoreBar bar{.defects = 1, .largest_angle_deg = view.step.largest_angle_deg, .short_added = 0};
    if (!scoreAbove(view, patch, scale, edit, bar) || !keepsShores(view, edit)) return;
    least = lack;
    best = edit;
  });
  return best;
}

std::optional<PatchEdit> bestNodeSplit(const RepairView& view, std::uint32_t node, const GridPatch& patch) {
  const std::vector<std::uint32_t> ring = ringRound(view, node);
  if (ring.size() < 8) return std::nullopt;
  const std::size_t n = ring.size(), half = n / 2;
  const std::set<std::uint32_t> fixed = fixedNeighbours(view, node);
  Contest contest(view, patch);
  for (std::size_t first = 0; first < n; ++first) {
    std::optional<PatchEdit> edit = nodeSplitOf(view, node, ring, fixed, first, half);
    if (!edit) continue;
    std::vector<Point> places;
    for (std::size_t k = 0; k <= half; ++k) places.push_back(view.grid.nodes[ring[(first + k) % n]]);
    const Point middle = meanPlace(view.grid.crs, places);
    for (const double share : {0.3, 0.5, 0.7}) {
      edit->place = placeBetween(view.grid.crs, view.grid.nodes[node], middle, share);
      contest.offer(*edit);
    }
  }
  return contest.take();
}

}  // namespace coastmesh
