#include "gis/follow/shore_joins.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "gis/follow/shore_settle.hpp"
#include "gis/follow/water_basins.hpp"
#include "gis/follow/water_gaps.hpp"

namespace coastmesh {

namespace {

constexpr int kRounds = 3;  // widening may close something else

// Finds the water that a place is in.
class WaterSearch {
 public:
  explicit WaterSearch(const OpenedShores& opened)
      : triangles_(opened.after), water_(opened.after.mesh.triangles.size(), kNone) {
    for (std::uint32_t i = 0; i < opened.waters.size(); ++i)
      for (const TriId t : opened.waters[i].triangles) water_[t] = i;
  }

  // The water at the first of these places that is in any, also one that was left out; kNone if none is.
  std::uint32_t at(const std::vector<Point>& places) {
    for (const Point& x : places) {
      const TriId t = locateIn(triangles_, x, last_);
      if (t == kNone) continue;
      last_ = t;
      if (water_[t] != kNone) return water_[t];
    }
    return kNone;
  }

 private:
  const ShoreTriangles& triangles_;
  std::vector<std::uint32_t> water_;  // of each triangle
  TriId last_ = 0;
};

class Joiner {
 public:
  Joiner(ShoreStart&& start, const DataShores& data, const ShoreSizes& sizes, ShoreGuides guides,
         const FollowOptions& options, const ItemLoop& loop)
      : data_(std::move(start)),
        gaps_({data_.triangles, data}, options.channel_min, loop),
        sizes_(sizes),
        guides_(std::move(guides)),
        options_(options),
        loop_(loop) {}

  JoinedShores run() {
    // Which water is cut off depends on the order of opening land and water. Most stays connected if all of the land is
    // opened first.
    opened_ = openShores(start(), sizes_, guides_, options_, 1.0, loop_);
    keepSeparatingLand();
    std::vector<JoinedWater> joins = findJoins();
    opened_ = balanceShores(std::move(opened_), start(), sizes_, guides_, options_, loop_);
    if (opened_.first != 1.0) keepSeparatingLand();
    if (joins.empty() && opened_.first != 1.0) joins = findJoins();
    for (int round = 0; round < kRounds && join(std::move(joins)); ++round) {
      joins = findJoins();
      forget(joins);
    }
    forgetApart();
    JoinedShores shores;
    forItems(loop_, 2, [&](std::size_t i) {
      if (i == 0) {
        shores.ways = waysToWaters(gaps_, opened_, sizes_);
      } else {
        shores.straits = closedStraits(gaps_, opened_, options_.keep, sizes_.scale);
      }
    });
    shores.opened = std::move(opened_);
    shores.joined = std::move(joined_);
    return shores;
  }

 private:
  const ShoreStart& start() const { return widened_ ? *widened_ : data_; }

  void keepSeparatingLand() {
    for (int round = 0; round < kRounds; ++round) {
      std::vector<ShoreLine> lines = separatingLand(gaps_, basinsOf(gaps_, opened_));
      if (lines.empty()) return;
      std::ranges::move(lines, std::back_inserter(guides_.land));
      opened_ = openShores(start(), sizes_, guides_, options_, opened_.first, loop_);
    }
  }

  std::vector<JoinedWater> findJoins() const {
    if (options_.strait_min >= options_.channel_min) return {};
    return waysToJoin(gaps_, opened_, sizes_, options_);
  }

  // Removes earlier joins of the same waters: for each, the largest that is in it.
  void forget(const std::vector<JoinedWater>& joins) {
    if (joins.empty()) return;
    WaterSearch waters(opened_);
    std::map<std::uint32_t, std::size_t> largest;  // by water: index of the earlier join
    for (std::size_t i = 0; i < joined_.size(); ++i) {
      const auto [at, is_first] = largest.emplace(waters.at(joined_[i].inside), i);
      if (!is_first && joined_[i].area > joined_[at->second].area) at->second = i;
    }
    std::set<std::size_t, std::greater<>> again;
    for (const JoinedWater& water : joins)
      if (const auto at = largest.find(waters.at(water.inside)); at != largest.end()) again.insert(at->second);
    for (const std::size_t i : again) joined_.erase(joined_.begin() + static_cast<std::ptrdiff_t>(i));
  }

  // Removes joins of waters that are separate nevertheless.
  void forgetApart() {
    if (joined_.empty()) return;
    WaterSearch waters(opened_);
    const std::vector<bool> main = areMain(opened_.waters);
    std::erase_if(joined_, [&](const JoinedWater& water) {
      const std::uint32_t at = waters.at(water.inside);
      return at == kNone || !(water.was_kept ? main[at] : opened_.waters[at].kept);
    });
  }

  bool join(std::vector<JoinedWater>&& joins) {
    std::vector<ShoreLine> lines;
    for (JoinedWater& water : joins) {
      lines.insert(lines.end(), water.way.narrow.begin(), water.way.narrow.end());
      joined_.push_back(std::move(water));
    }
    if (lines.empty()) return false;
    // Continues from the state after the first opening of land, which cannot come back.
    ShoreStart& start = widened_.emplace(ShoreStart{std::move(opened_.before), std::move(opened_.gained_before),
                                                    std::move(opened_.edits), std::move(opened_.spits)});
    start.edits.resize(opened_.edits_before);
    start.spits.resize(opened_.spits_before);
    const ShoreEdit edit = [&](EditKind kind, const Point& place, RegionId water) {
      start.edits.emplace_back(kind, place, water);
    };
    PassageEffects effects;
    widenPassages(start.triangles, sizes_, lines, opened_.small, edit, start.gained, effects, loop_);
    guides_.passages.insert(guides_.passages.end(), lines.begin(), lines.end());
    opened_ = openShores(start, sizes_, guides_, options_, opened_.first, loop_);
    return true;
  }

  const ShoreStart data_;
  const WaterGaps gaps_;
  std::optional<ShoreStart> widened_;
  const ShoreSizes& sizes_;
  ShoreGuides guides_;
  const FollowOptions& options_;
  const ItemLoop& loop_;
  OpenedShores opened_;
  std::vector<JoinedWater> joined_;
};

}  // namespace

JoinedShores openJoined(ShoreStart&& start, const DataShores& data, const ShoreSizes& sizes, ShoreGuides guides,
                        const FollowOptions& options, const ItemLoop& loop) {
  return Joiner(std::move(start), data, sizes, std::move(guides), options, loop).run();
}

}  // namespace coastmesh
