#include "gis/model/repair_search.hpp"

#include "gis/model/repair_score.hpp"

namespace coastmesh {
namespace {

// The best of what is offered that is better than the patch as it is; the first of those as good.
class Contest {
 public:
  Contest(const RepairView& view, const Patch& patch)
      : view_(view), patch_(patch), scale_(scaleOf(view, patch)), now_(scoreOf(scale_)) {}

  void offer(const PatchEdit& edit) {
    const EditScore score = scoreOf(view_, patch_, scale_, edit);
    if (score.defects >= now_.defects || (best_ && !score.betterThan(score_))) return;
    score_ = score;
    best_ = edit;
  }

  std::optional<PatchEdit> take() { return std::move(best_); }

 private:
  const RepairView& view_;
  const Patch& patch_;
  const PatchScale scale_;
  const EditScore now_;
  EditScore score_;
  std::optional<PatchEdit> best_;
};

// Towards nodes of the ring and the middles between two of them.
void offerMoves(Contest& contest, const RepairView& view, std::uint32_t node) {
  const std::vector<std::uint32_t> ring = ringRound(view, node);
  for (const double share : {0.02, 0.05, 0.1, 0.15, 0.2, 0.3}) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      contest.offer(moveOf(view, node, ring[i], ring[i], share));
      contest.offer(moveOf(view, node, ring[i], ring[(i + 1) % ring.size()], share));
    }
  }
}

}  // namespace

std::optional<PatchEdit> bestReshaping(const RepairView& view, std::span<const std::uint32_t> inside,
                                       const SearchReach& reach, const Patch& patch) {
  std::set<NodePair> edges;
  for (const std::uint32_t t : inside) {
    const GridCorners& v = view.grid.triangles[t];
    for (unsigned i = 0; i < 3; ++i) edges.insert(edgeKey(v[i], v[next3(i)]));
  }
  Contest contest(view, patch);
  for (const std::uint32_t node : reach.movable) offerMoves(contest, view, node);
  for (const auto& [a, b] : edges) {
    if (const auto flip = flipOf(view, patch, a, b)) contest.offer(*flip);
    for (const double share : reach.shares) contest.offer(splitOf(view, patch, a, b, share));
  }
  return contest.take();
}

std::optional<PatchEdit> bestNodeSplit(const RepairView& view, std::uint32_t node, const Patch& patch) {
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
