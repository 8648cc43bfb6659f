#include "gis/follow/shore_joins.hpp"

#include <algorithm>
#include <utility>

namespace coastmesh {

namespace {

constexpr int kRounds = 3;  // widening may close something else

class Joiner {
 public:
  Joiner(ShoreStart&& start, const ShoreSizes& sizes, ShoreGuides guides, const FollowOptions& options)
      : start_(std::move(start)), sizes_(sizes), guides_(std::move(guides)), options_(options) {}

  JoinedShores run() {
    // Which water is cut off depends on the order of opening land and water. Straits are widest if all of the land is
    // opened first: what is connected then stays so.
    opened_ = openShores(start_, sizes_, guides_, options_, 1.0);
    std::vector<JoinedWater> joins = findJoins();
    opened_ = balanceShores(std::move(opened_), start_, sizes_, guides_, options_);
    if (joins.empty() && opened_.first != 1.0) joins = findJoins();
    for (int round = 0; round < kRounds && join(std::move(joins)); ++round) joins = findJoins();
    std::vector<WaterWay> ways = waysToWaters(opened_, sizes_, options_);
    return {std::move(opened_), std::move(ways), std::move(joined_)};
  }

 private:
  std::vector<JoinedWater> findJoins() const {
    if (options_.strait_min >= options_.channel_min) return {};
    return waysToJoin(opened_, sizes_, options_);
  }

  bool join(std::vector<JoinedWater>&& joins) {
    std::vector<ShoreLine> lines;
    for (JoinedWater& water : joins) {
      lines.insert(lines.end(), water.way.narrow.begin(), water.way.narrow.end());
      joined_.push_back(std::move(water));
    }
    if (lines.empty()) return false;
    // Continues from the state after the first opening of land, which cannot come back.
    start_ = {std::move(opened_.before), std::move(opened_.gained_before), std::move(opened_.edits),
              std::move(opened_.spits)};
    start_.edits.resize(opened_.edits_before);
    start_.spits.resize(opened_.spits_before);
    const ShoreEdit edit = [&](EditKind kind, const Point& place, RegionId water) {
      start_.edits.emplace_back(kind, place, water);
    };
    PassageEffects effects;
    widenPassages(start_.triangles, sizes_, lines, edit, start_.gained, effects);
    guides_.passages.insert(guides_.passages.end(), lines.begin(), lines.end());
    opened_ = openShores(start_, sizes_, guides_, options_, opened_.first);
    return true;
  }

  ShoreStart start_;
  const ShoreSizes& sizes_;
  ShoreGuides guides_;
  const FollowOptions& options_;
  OpenedShores opened_;
  std::vector<JoinedWater> joined_;
};

}  // namespace

JoinedShores openJoined(ShoreStart&& start, const ShoreSizes& sizes, ShoreGuides guides, const FollowOptions& options) {
  return Joiner(std::move(start), sizes, std::move(guides), options).run();
}

}  // namespace coastmesh
