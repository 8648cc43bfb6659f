#include "gis/repair_search.hpp"

#include "gis/repair_score.hpp"

namespace coastmesh {
namespace {

// The best of what is offered that is better than the patch as it is.
template <typename Candidate>
class Contest {
 public:
  Contest(const RepairView& view, const Patch& patch)
      : view_(view), patch_(patch), scale_(scaleOf(view, patch)), now_(scoreOf(scale_)) {}

  void offer(const PatchEdit& edit, auto&& candidate) {
    const EditScore score = scoreOf(view_, patch_, scale_, edit);
    if (score.defects >= now_.defects || (best_ && !score.betterThan(score_))) return;
    score_ = score;
    best_ = candidate();
  }

  std::optional<Candidate> take() { return std::move(best_); }

 private:
  const RepairView& view_;
  const Patch& patch_;
  const PatchScale scale_;
  const EditScore now_;
  EditScore score_;
  std::optional<Candidate> best_;
};

}  // namespace

std::optional<Reshaping> bestReshaping(const RepairView& view, std::span<const std::uint32_t> inside,
                                       const Patch& patch) {
  std::set<NodePair> edges;
  for (const std::uint32_t t : inside) {
    const GridCorners& v = view.grid.triangles[t];
    for (unsigned i = 0; i < 3; ++i) edges.insert(edgeKey(v[i], v[next3(i)]));
  }
  Contest<Reshaping> contest(view, patch);
  for (const NodePair& edge : edges) {
    const auto& [a, b] = edge;
    if (const auto flip = flipOf(view, patch, a, b))
      contest.offer(*flip, [&] { return Reshaping{*flip, edge, std::nullopt}; });
    for (const double share : {0.5, 0.4, 0.6, 0.3, 0.7}) {
      const PatchEdit split = splitOf(view, patch, a, b, share);
      contest.offer(split, [&] { return Reshaping{split, edge, share}; });
    }
  }
  return contest.take();
}

std::optional<PatchEdit> bestNodeSplit(const RepairView& view, std::uint32_t node, const Patch& patch) {
  const std::vector<std::uint32_t> ring = ringRound(view, node);
  if (ring.size() < 8) return std::nullopt;
  const std::size_t n = ring.size(), half = n / 2;
  const std::set<std::uint32_t> fixed = fixedNeighbours(view, node);
  Contest<PatchEdit> contest(view, patch);
  for (std::size_t first = 0; first < n; ++first) {
    std::optional<PatchEdit> edit = nodeSplitOf(view, node, ring, fixed, first, half);
    if (!edit) continue;
    std::vector<Point> places;
    for (std::size_t k = 0; k <= half; ++k) places.push_back(view.grid.nodes[ring[(first + k) % n]]);
    const Point middle = meanPlace(view.grid.crs, places);
    for (const double share : {0.3, 0.5, 0.7}) {
      edit->fresh = placeBetween(view.grid.crs, view.grid.nodes[node], middle, share);
      contest.offer(*edit, [&] { return *edit; });
    }
  }
  return contest.take();
}

}  // namespace coastmesh
