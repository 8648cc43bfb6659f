#include "gis/shore/shore_shift.hpp"

#include <algorithm>
#include <cmath>

#include "core/metric.hpp"
#include "gis/shore/shore_pieces.hpp"

namespace coastmesh {

namespace {

// Shares of the size wanted.
constexpr double kMost = 0.1;
constexpr double kApart = 0.5;
constexpr int kRounds = 3;

class Shifter {
 public:
  Shifter(ShoreChains& chains, const std::map<RegionId, double>& wanted_m2, const ScaleTable& scales,
          const ShoreMove& moved)
      : c_(chains), left_(wanted_m2), scale_(scales), moved_(moved), from_(chains.at), near_(chains) {}

  void run() {
    for (int round = 0; round < kRounds; ++round) {
      std::map<RegionId, double> reach = reaches();
      near_.buildTrees();
      std::map<RegionId, double> share;
      for (const auto& [region, area] : left_)
        if (reach[region] > 0.0) share[region] = std::clamp(kMost * area / reach[region], -kMost, kMost);
      for (VertexId v = 0; v < c_.at.size(); ++v) {
        if (!canShift(v)) continue;
        const auto by = share.find(c_.leaving[v].left);
        if (by != share.end() && by->second != 0.0) shift(v, by->second);
      }
    }
  }

 private:
  bool canShift(VertexId v) const { return c_.next[v] != kNone && c_.prev[v] != kNone && !c_.stays[v] && !c_.open[v]; }

  // Square metres gained by each region if all its shores move by `kMost`.
  std::map<RegionId, double> reaches() const {
    std::map<RegionId, double> reach;
    for (VertexId v = 0; v < c_.at.size(); ++v) {
      if (!canShift(v)) continue;
      const double scale = scale_.at(c_.at[v]);
      reach[c_.leaving[v].left] +=
          0.5 * distance(c_.at[c_.prev[v]], c_.at[c_.next[v]]) * kMost * c_.size[v] / scale / scale;
    }
    return reach;
  }

  void shift(VertexId v, double share) {
    const Point &a = c_.at[c_.prev[v]], &b = c_.at[c_.next[v]];
    const double across = distance(a, b), size = c_.size[v];
    if (across == 0.0) return;
    // Land lies to the right.
    const Point out{(b - a).y / across, (a - b).x / across};
    const Point x = c_.at[v] + share * size * out;
    if (squaredDistance(x, from_[v]) > kMost * kMost * size * size * 1.0001) return;
    if (leavesFrame(c_, v, x)) return;
    near_.gather(v, 3.0 * kMost);
    if (!near_.canMove(v, x)) return;
    if (near_.qualityOf(v, x) < near_.qualityOf(v, c_.at[v])) return;
    if (near_.apart(v, x) < std::min(kApart * size, near_.apart(v, c_.at[v]))) return;
    const double scale = scale_.at(x);
    left_[c_.leaving[v].left] -= 0.5 * across * share * size / scale / scale;
    moved_(v, x);
    c_.at[v] = x;
    c_.source[v] = kNone;
  }

  ShoreChains& c_;
  std::map<RegionId, double> left_;
  const ScaleTable& scale_;
  const ShoreMove& moved_;
  std::vector<Point> from_;
  ShorePieces near_;
};

}  // namespace

void shiftShores(ShoreChains& chains, const std::map<RegionId, double>& wanted_m2, const ScaleTable& scales,
                 const ShoreMove& moved) {
  Shifter(chains, wanted_m2, scales, moved).run();
}

}  // namespace coastmesh
