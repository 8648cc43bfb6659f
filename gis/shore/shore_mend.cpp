#include "gis/shore/shore_mend.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

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
  // A vertex whose piece of shore may be improved.
  struct Bad {
    double quality;
    VertexId v;
    std::uint32_t stretch, first, last;  // what lies near it, in `BadPieces::near`
    bool operator<(const Bad& other) const { return quality != other.quality ? quality < other.quality : v < other.v; }
  };
  struct BadPieces {
    std::vector<Bad> bad;                     // in order of their vertices
    std::vector<std::vector<VertexId>> near;  // by stretch
    std::span<const VertexId> nearTo(const Bad& of) const {
      return std::span(near[of.stretch]).subspan(of.first, of.last - of.first);
    }
  };

  // Divides long segments, because moving a vertex moves all of both its segments.
  void divide() {
    divideAtLines(c_);
    near_.buildTrees(loop_);
    is_new_.assign(c_.at.size(), 1);
    for (const Bad& bad : findBad().bad) divideBeside(c_, bad.v);
    from_ = c_.at;
    is_new_.assign(c_.at.size(), 1);
    near_.buildTrees(loop_);
  }

  bool isFixed(VertexId v) const { return c_.stays[v] != 0 || c_.open[v] != 0; }

  BadPieces findBad() const {
    constexpr std::size_t kStretch = 4096;
    struct Found {
      std::vector<Bad> bad;
      std::vector<VertexId> near;
    };
    std::vector<Found> found = overStretches(
        loop_, c_.at.size(),
        [&](std::size_t first, std::size_t last) {
          Found here;
          ShorePieces pieces = near_;
          for (auto v = static_cast<VertexId>(first); v < last; ++v) {
            if (!is_new_[v] || isFixed(v) || c_.next[v] == kNone || c_.prev[v] == kNone) continue;
            if (pieces.isFine(v)) continue;
            pieces.gather(v, kSteps[2]);
            const double quality = pieces.qualityOf(v, c_.at[v]);
            if (quality >= 1.0) continue;
            const auto begin = static_cast<std::uint32_t>(here.near.size());
            here.near.insert(here.near.end(), pieces.points().begin(), pieces.points().end());
            here.bad.push_back({quality, v, 0, begin, static_cast<std::uint32_t>(here.near.size())});
          }
          return here;
        },
        kStretch);
    BadPieces all;
    for (std::uint32_t stretch = 0; stretch < found.size(); ++stretch) {
      for (Bad& bad : found[stretch].bad) bad.stretch = stretch;
      all.bad.insert(all.bad.end(), found[stretch].bad.begin(), found[stretch].bad.end());
      all.near.push_back(std::move(found[stretch].near));
    }
    return all;
  }

  // Mends the worst first. What lies near a mended piece is locked until the next round, so that pieces may be judged
  // all at once.
  bool mendOnce() {
    BadPieces pieces = findBad();
    std::sort(pieces.bad.begin(), pieces.bad.end());
    std::vector<char> locked(c_.at.size(), 0);
    const auto isLocked = [&](const Bad& bad) {
      return std::ranges::any_of(pieces.nearTo(bad), [&](VertexId w) { return locked[w] != 0; });
    };
    const std::vector<std::uint32_t> likely = likelyMended(pieces);
    const std::vector<std::optional<Change>> changes = changesOf(pieces, likely);
    is_new_.assign(c_.at.size(), 0);
    bool any = false;
    std::size_t next = 0;  // in `likely`
    for (std::uint32_t i = 0; i < pieces.bad.size(); ++i) {
      const Bad& bad = pieces.bad[i];
      const bool is_likely = next < likely.size() && likely[next] == i;
      const std::size_t place = is_likely ? next++ : next;
      if (isLocked(bad)) {
        is_new_[bad.v] = 1;
        continue;
      }
      if (!is_likely) near_.gather(bad.v, kSteps[2]);
      const std::optional<Change> change = is_likely ? changes[place] : changeOf(bad, near_);
      if (!change) continue;
      make(*change, bad.v);
      for (const VertexId w : pieces.nearTo(bad)) locked[w] = is_new_[w] = 1;
      any = true;
    }
    if (any) near_.renewTrees(loop_);
    return any;
  }

  // The pieces that will be mended if this succeeds for all of them, as it mostly does.
  std::vector<std::uint32_t> likelyMended(const BadPieces& pieces) const {
    std::vector<std::uint32_t> likely;
    std::vector<char> locked(c_.at.size(), 0);
    for (std::uint32_t i = 0; i < pieces.bad.size(); ++i) {
      const std::span<const VertexId> near = pieces.nearTo(pieces.bad[i]);
      if (std::ranges::any_of(near, [&](VertexId w) { return locked[w] != 0; })) continue;
      for (const VertexId w : near) locked[w] = 1;
      likely.push_back(i);
    }
    return likely;
  }

  std::vector<std::optional<Change>> changesOf(const BadPieces& pieces, const std::vector<std::uint32_t>& of) const {
    constexpr std::size_t kStretch = 64;
    std::vector<std::optional<Change>> changes(of.size());
    forStretches(
        loop_, of.size(),
        [&](std::size_t first, std::size_t last) {
          ShorePieces near = near_;
          for (std::size_t i = first; i < last; ++i) {
            const Bad& bad = pieces.bad[of[i]];
            near.gather(bad.v, kSteps[2]);
            changes[i] = changeOf(bad, near);
          }
        },
        kStretch);
    return changes;
  }

  // The best change that is an improvement. `near`: gathered for the piece.
  std::optional<Change> changeOf(const Bad& bad, const ShorePieces& near) const {
    const VertexId v = bad.v;
    const double size = c_.size[v];
    // Close to the wanted quality, a smaller improvement is enough.
    Change best{std::nullopt, std::min(bad.quality + kBetter, 1.0)};
    bool found = false;
    if (canTakeOut(c_, v) && canGo(v, near)) {
      const double after = near.qualityOf(v, std::nullopt);
      if (after >= best.quality) best = {std::nullopt, after}, found = true;
    }
    for (const double step : kSteps) {
      for (int i = 0; i < kDirections; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kDirections;
        const Point x = c_.at[v] + step * size * Point{std::cos(angle), std::sin(angle)};
        if (squaredDistance(x, from_[v]) > kMoved * kMoved * size * size) continue;
        const double after = near.qualityOf(v, x);
        const bool is_better = found ? after > best.quality + kBetter : after >= best.quality;
        if (is_better && !leavesFrame(c_, v, x) && near.canMove(v, x)) best = {x, after}, found = true;
      }
    }
    if (!found) return std::nullopt;
    return best;
  }

  void make(const Change& change, VertexId v) {
    if (change.x) {
      moved_(v, *change.x);
      c_.at[v] = *change.x;
      c_.source[v] = kNone;
    } else {
      gone_(v);
      takeOut(c_, v);
    }
  }

  // True if removing v moves the shore little enough, with nothing in between.
  bool canGo(VertexId v, const ShorePieces& near) const {
    const Point &a = c_.at[c_.prev[v]], &x = c_.at[v], &b = c_.at[c_.next[v]];
    const double most = (waterAngle(a, x, b) < kSmallShoreAngle ? kClosed : kMoved) * c_.size[v];
    return squaredDistanceToSegment(from_[v], a, b) <= most * most && near.canCut(v);
  }

  ShoreChains& c_;
  const ShoreLoss& gone_;
  const ShoreMove& moved_;
  const ItemLoop& loop_;
  std::vector<Point> from_;
  ShorePieces near_;
  std::vector<char> is_new_;  // something near has changed since the last check
};

}  // namespace

void mendShores(ShoreChains& chains, const ShoreLoss& gone, const ShoreMove& moved, const ItemLoop& loop) {
  Mender(chains, gone, moved, loop).run();
  dropSamples(chains);
}

}  // namespace coastmesh
