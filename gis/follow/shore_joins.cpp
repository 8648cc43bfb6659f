#include "gis/follow/shore_joins.hpp"

#include <algorithm>
#include <utility>

namespace coastmesh {

namespace {

constexpr double kMostWidened = 0.25;  // of the area of the water that is joined so
constexpr int kRounds = 3;             // waters behind one another are joined one after another

class Joiner {
 public:
  Joiner(ShoreGraph graph, const ShoreSizes& sizes, ShoreGuides guides, const FollowOptions& options,
         const ShoreEdit& edit)
      : graph_(std::move(graph)), sizes_(sizes), guides_(std::move(guides)), options_(options), edit_(edit) {}

  JoinedShores run() {
    // Which water is cut off hangs on the order of opening land and water, and so on the areas.
    open(1.0);
    join();
    opened_ = balanceShores(std::move(opened_), graph_, sizes_, guides_, options_);
    if (opened_.first != 1.0) join();
    for (const auto& [water, area] : widened_m2_) opened_.gained[water] += area;
    std::vector<WaterWay> ways = waysToWaters(opened_, sizes_, options_, 0.0);
    return {std::move(opened_), std::move(ways), std::move(joined_)};
  }

 private:
  void open(double first) { opened_ = openShores(graph_, sizes_, guides_, options_, first); }

  void join() {
    if (options_.strait_min >= options_.channel_min) return;
    for (int round = 0; round < kRounds; ++round) {
      std::vector<WaterWay> ways = waysToWaters(opened_, sizes_, options_, options_.strait_min);
      std::vector<ShoreLine> lines;
      for (std::size_t i = 0; i < ways.size(); ++i) {
        const double area = opened_.waters[i].area;
        if (ways[i].narrow.empty() || ways[i].widening_m2 > kMostWidened * area) continue;
        lines.insert(lines.end(), ways[i].narrow.begin(), ways[i].narrow.end());
        joined_.push_back({std::move(ways[i]), area});
      }
      if (lines.empty()) return;
      std::vector<WidenedPassage> widened;
      std::vector<std::size_t> dry;
      graph_ = widenPassages(graph_, sizes_, lines, edit_, widened_m2_, widened, dry);
      guides_.passages.insert(guides_.passages.end(), lines.begin(), lines.end());
      open(opened_.first);
    }
  }

  ShoreGraph graph_;
  const ShoreSizes& sizes_;
  ShoreGuides guides_;
  const FollowOptions& options_;
  const ShoreEdit& edit_;
  OpenedShores opened_;
  WaterAreas widened_m2_;
  std::vector<JoinedWater> joined_;
};

}  // namespace

JoinedShores openJoined(ShoreGraph graph, const ShoreSizes& sizes, ShoreGuides guides, const FollowOptions& options,
                        const ShoreEdit& edit) {
  return Joiner(std::move(graph), sizes, std::move(guides), options, edit).run();
}

}  // namespace coastmesh
