#include "gis/rivers/river_connection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/ids.hpp"
#include "core/metric.hpp"
#include "core/union_find.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kClose = 3.0;  // widths
constexpr double kFar = 300.0;  // widths; beyond, the distance is not reported

bool touchesWater(const RiverReach& reach, const MeshWater& water) {
  for (std::size_t i = 0; i < reach.points.size(); ++i) {
    if (water.holds(reach.points[i])) return true;
    if (i > 0 && water.holds(midpoint(reach.points[i - 1], reach.points[i]))) return true;
  }
  return false;
}

// A free end beside the water.
struct NearEnd {
  double gap = kInfinity;
  std::uint32_t reach = kNone;
  bool at_end = false;
  Point shore;
};

UnionFind networksOf(const RiverNetwork& network, std::span<const std::uint8_t> barred) {
  UnionFind sets(network.nodes.size());
  for (std::size_t r = 0; r < network.reaches.size(); ++r)
    if (barred.empty() || barred[r] == 0) sets.unite(network.reaches[r].from, network.reaches[r].to);
  return sets;
}

void extend(RiverNetwork& network, const NearEnd& end, double width) {
  RiverReach& reach = network.reaches[end.reach];
  const Point from = end.at_end ? reach.points.back() : reach.points.front();
  const Point place = end.shore + (width / end.gap) * (end.shore - from);
  network.nodes[end.at_end ? reach.to : reach.from] = place;
  if (end.at_end) {
    reach.points.push_back(place);
    reach.line_of.push_back(reach.line_of.back());
  } else {
    reach.points.insert(reach.points.begin(), place);
    reach.line_of.insert(reach.line_of.begin(), reach.line_of.front());
  }
}

}  // namespace

RiverConnection connectRivers(RiverNetwork& network, std::span<const PlaneRiver> rivers, const MeshWater& water,
                              double reach) {
  RiverConnection connection;
  UnionFind sets = networksOf(network, {});
  std::vector<std::uint32_t> degree(network.nodes.size(), 0);
  std::vector<std::uint8_t> has_water(network.nodes.size(), 0);  // by root
  for (const RiverReach& own : network.reaches) {
    ++degree[own.from];
    ++degree[own.to];
    connection.touches.push_back(touchesWater(own, water) ? 1 : 0);
    if (connection.touches.back() != 0) has_water[sets.find(own.from)] = 1;
  }
  std::map<std::uint32_t, NearEnd> nearest;  // by root
  for (std::uint32_t r = 0; r < network.reaches.size(); ++r) {
    const RiverReach& own = network.reaches[r];
    const std::uint32_t root = sets.find(own.from);
    if (has_water[root] != 0) continue;
    NearEnd& best = nearest[root];
    for (const bool at_end : {false, true}) {
      if (degree[at_end ? own.to : own.from] != 1) continue;
      const Point end = at_end ? own.points.back() : own.points.front();
      const double width = rivers[at_end ? own.line_of.back() : own.line_of.front()].width;
      const double far = std::isfinite(reach) ? std::max(reach, kFar * width) : kFar * width;
      const auto shore = water.nearest(end, std::min(best.gap, far));
      if (shore && distance(end, *shore) < best.gap) best = {distance(end, *shore), r, at_end, *shore};
    }
  }
  for (const auto& [root, end] : nearest) {
    if (end.reach == kNone) continue;
    const RiverReach& own = network.reaches[end.reach];
    const double width = rivers[end.at_end ? own.line_of.back() : own.line_of.front()].width;
    if (end.gap > (std::isfinite(reach) ? reach : kClose * width) || !(end.gap > 0.0)) continue;
    extend(network, end, width);
    ++connection.extended;
    connection.touches[end.reach] = 1;
  }
  for (const RiverReach& own : network.reaches) {
    const auto found = nearest.find(sets.find(own.from));
    connection.gap.push_back(found == nearest.end() ? 0.0 : found->second.gap);
  }
  return connection;
}

std::vector<std::uint8_t> connectedReaches(const RiverNetwork& network, std::span<const std::uint8_t> touches,
                                           std::span<const std::uint8_t> barred) {
  UnionFind sets = networksOf(network, barred);
  std::vector<std::uint8_t> has_water(network.nodes.size(), 0), connected;
  for (std::size_t r = 0; r < network.reaches.size(); ++r)
    if (touches[r] != 0 && barred[r] == 0) has_water[sets.find(network.reaches[r].from)] = 1;
  for (std::size_t r = 0; r < network.reaches.size(); ++r)
    connected.push_back(barred[r] == 0 && has_water[sets.find(network.reaches[r].from)] != 0 ? 1 : 0);
  return connected;
}

}  // namespace coastmesh
