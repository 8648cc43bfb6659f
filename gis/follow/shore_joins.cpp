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
    if (ways_.empty()) findWays();
    return {std::move(opened_), std::move(ways_), std::move(joined_)};
  }

 private:
  void open(double first) {
    opened_ = openShores(graph_, sizes_, guides_, options_, first);
    ways_.clear();
  }
  bool isAnyCutOff() const { return !std::ranges::all_of(opened_.waters, &WaterPart::kept); }

  // Of the waters as they are opened by now; returns those that are wide enough to be widened.
  std::vector<WaterWay> findWays() {
    ways_.assign(opened_.waters.size(), {});
    if (!isAnyCutOff()) return ways_;
    WaterWays found = waysToWaters(graph_, opened_, sizes_, guides_, options_, options_.strait_min);
    ways_ = std::move(found.any);
    return std::move(found.wide);
  }

  void join() {
    ways_.clear();
    if (options_.strait_min >= options_.channel_min) return;
    for (int round = 0; round < kRounds && isAnyCutOff(); ++round) {
      std::vector<WaterWay> ways = findWays();
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
  std::vector<WaterWay> ways_;  // of its waters, however narrow; empty where they have not been looked for
  WaterAreas widened_m2_;
  std::vector<JoinedWater> joined_;
};

}  // namespace

JoinedShores openJoined(ShoreGraph graph, const ShoreSizes& sizes, ShoreGuides guides, const FollowOptions& options,
                        const ShoreEdit& edit) {
  return Joiner(std::move(graph), sizes, std::move(guides), options, edit).run();
}

}  // namespace coastmesh
