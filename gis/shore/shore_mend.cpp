#include "gis/shore/shore_mend.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/metric.hpp"
#include "gis/shore/shore_divide.hpp"
#include "gis/shore/shore_pieces.hpp"

namespace coastmesh {

namespace {

// Lengths are shares of the size wanted.
constexpr double kMoved = 0.5;
constexpr double kClosed = 1.2;  // how far removing a sharp corner may move the shore
constexpr double kBetter = 0.03;
constexpr int kRounds = 12;
constexpr int kDirections = 8;
constexpr double kSteps[] = {0.1, 0.25, 0.45};

class Mender {
 public:
  Mender(ShoreChains& chains, const ShoreLoss& gone, const ShoreMove& moved, const ItemLoop& loop)
      : c_(chains), gone_(gone), moved_(moved), loop_(loop), near_(chains) {}

  void run() {
    divide();
    for (int round = 0; round < kRounds && mendOnce(); ++round) {
    }
  }

 private:
  // A candidate for a vertex's piece of shore: p, x, q, or p, q if x is nullopt.
  struct Change {
    std::optional<Point> x;
    double quality = 0.0;
  };

  // Divides long segments, because moving a vertex moves all of both its segments.
  void divide() {
    divideAtLines(c_);
    near_.buildTrees();
    is_new_.assign(c_.at.size(), 1);
    for (const auto& [quality, v] : findBad())
      if (!isFixed(v)) divideBeside(c_, v);
    from_ = c_.at;
    is_new_.assign(c_.at.size(), 1);
  }

  bool isFixed(VertexId v) const { return c_.stays[v] != 0 || c_.open[v] != 0; }

  std::vector<std::pair<double, VertexId>> findBad() const {
    constexpr std::size_t kStretch = 4096;
    return joined(overStretches(
        loop_, c_.at.size(),
        [&](std::size_t first, std::size_t last) {
          std::vector<std::pair<double, VertexId>> bad;
          ShorePieces near = near_;
          for (auto v = static_cast<VertexId>(first); v < last; ++v) {
            if (!is_new_[v] || c_.next[v] == kNone || c_.prev[v] == kNone) continue;
            if (near.isFine(v)) continue;
            near.gather(v, 0.0);
            const double quality = near.qualityOf(v, c_.at[v]);
            if (quality < 1.0) bad.emplace_back(quality, v);
          }
          return bad;
        },
        kStretch));
  }

  bool mendOnce() {
    near_.buildTrees();
    locked_.assign(c_.at.size(), 0);
    std::vector<std::pair<double, VertexId>> bad = findBad();
    std::ranges::sort(bad);
    is_new_.assign(c_.at.size(), 0);
    bool any = false;
    for (const auto& [quality, v] : bad) {
      if (isFixed(v) || c_.next[v] == kNone) continue;
      near_.gather(v, kSteps[2]);
      if (std::ranges::any_of(near_.points(), [&](VertexId w) { return locked_[w] != 0; })) {
        is_new_[v] = 1;
        continue;
      }
      if (!mend(v, quality)) continue;
      for (const VertexId w : near_.points()) locked_[w] = is_new_[w] = 1;
      any = true;
    }
    return any;
  }

  bool mend(VertexId v, double quality) {
    const double size = c_.size[v];
    // Close to the wanted quality, a smaller improvement is enough.
    Change best{std::nullopt, std::min(quality + kBetter, 1.0)};
    bool found = false;
    if (canTakeOut(c_, v) && canGo(v)) {
      const double after = near_.qualityOf(v, std::nullopt);
      if (after >= best.quality) best = {std::nullopt, after}, found = true;
    }
    for (const double step : kSteps) {
      for (int i = 0; i < kDirections; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kDirections;
        const Point x = c_.at[v] + step * size * Point{std::cos(angle), std::sin(angle)};
        if (squaredDistance(x, from_[v]) > kMoved * kMoved * size * size) continue;
        const double after = near_.qualityOf(v, x);
        const bool is_better = found ? after > best.quality + kBetter : after >= best.quality;
        if (is_better && !leavesFrame(c_, v, x) && near_.canMove(v, x)) best = {x, after}, found = true;
      }
    }
    if (!found) return false;
    if (best.x) {
      moved_(v, *best.x);
      c_.at[v] = *best.x;
      c_.source[v] = kNone;
    } else {
      gone_(v);
      takeOut(c_, v);
    }
    return true;
  }

  // True if removing v moves the shore little enough, with nothing in between.
  bool canGo(VertexId v) const {
    const Point &a = c_.at[c_.prev[v]], &x = c_.at[v], &b = c_.at[c_.next[v]];
    const double most = (waterAngle(a, x, b) < kSmallShoreAngle ? kClosed : kMoved) * c_.size[v];
    return squaredDistanceToSegment(from_[v], a, b) <= most * most && near_.canCut(v);
  }

  ShoreChains& c_;
  const ShoreLoss& gone_;
  const ShoreMove& moved_;
  const ItemLoop& loop_;
  std::vector<Point> from_;
  ShorePieces near_;
  std::vector<char> locked_;
  std::vector<char> is_new_;  // something near has changed since the last check
};

}  // namespace

void mendShores(ShoreChains& chains, const ShoreLoss& gone, const ShoreMove& moved, const ItemLoop& loop) {
  Mender(chains, gone, moved, loop).run();
  dropSamples(chains);
}

}  // namespace coastmesh
