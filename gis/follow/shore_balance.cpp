#include "gis/follow/shore_balance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gis/follow/shore_settle.hpp"

namespace coastmesh {

namespace {

constexpr double kClose = 0.01;  // of the water's area: smaller errors are accepted
// Shares of the narrowest land that stays.
constexpr double kTried[] = {0.75, 0.5};
constexpr int kBetween = 3;      // further attempts
constexpr double kInside = 0.1;  // their distance from both ends, as a share of the interval

}  // namespace

OpenedShores openShores(const ShoreStart& start, const ShoreSizes& sizes, const ShoreGuides& guides,
                        const FollowOptions& options, double first, const ItemLoop& loop) {
  OpenedShores opened;
  opened.first = first;
  opened.gained = start.gained;
  opened.edits = start.edits;
  opened.spits = start.spits;
  const ShoreEdit edit = [&](EditKind kind, const Point& place, RegionId water) {
    opened.edits.emplace_back(kind, place, water);
  };
  opened.after = start.triangles;
  ShoreTriangles& triangles = opened.after;
  const ConnectedRegions connected = connectedRegions(triangles, loop);
  opened.small = smallWaters(triangles, sizes, guides, options.leastOfSmall(), connected, loop);
  openLand(triangles, sizes, guides, first * options.land_min, opened.small, edit, opened.gained, opened.spits, loop);
  opened.gained_before = opened.gained;
  opened.edits_before = opened.edits.size();
  opened.spits_before = opened.spits.size();
  opened.before = triangles;
  const auto close = [&](KeepWater keep) {
    return openWater(triangles, sizes, guides, options.channel_min, keep, connected, edit, opened.gained, loop);
  };
  OpenedWater water = close(first < 1.0 ? KeepWater::All : options.keep);
  if (first < 1.0) {
    settleShores(triangles, sizes.wanted, loop);
    openLand(triangles, sizes, guides, options.land_min, opened.small, edit, opened.gained, opened.spits, loop);
    water = close(options.keep);
  }
  opened.waters = std::move(water.waters);
  opened.areas = std::move(water.areas);
  double gained = 0.0, area = 0.0;
  for (const auto& [region, more] : opened.gained) gained += more;
  for (const auto& [region, there] : opened.areas) area += there;
  opened.error = gained / area;
  return opened;
}

OpenedShores balanceShores(OpenedShores&& opened, const ShoreStart& start, const ShoreSizes& sizes,
                           const ShoreGuides& guides, const FollowOptions& options, const ItemLoop& loop) {
  if (options.land_min == 0.0 || opened.error < kClose) return std::move(opened);
  // Too much water is left at `high`, too little at `low`.
  double high = 1.0, low = 1.0, too_much = opened.error, too_little = opened.error;
  OpenedShores best = std::move(opened);
  const auto attempt = [&](double first) {
    OpenedShores other = openShores(start, sizes, guides, options, first, loop);
    (other.error > 0.0 ? high : low) = first;
    (other.error > 0.0 ? too_much : too_little) = other.error;
    if (std::abs(other.error) < std::abs(best.error)) best = std::move(other);
  };
  for (const double first : kTried)
    if (low == 1.0 && std::abs(best.error) > kClose) attempt(first);
  for (int i = 0; i < kBetween && low < 1.0 && std::abs(best.error) > kClose; ++i) {
    const double share = std::clamp(too_little / (too_little - too_much), kInside, 1.0 - kInside);
    attempt(low + share * (high - low));
  }
  return best;
}

}  // namespace coastmesh
