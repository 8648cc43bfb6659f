#include "gis/rivers/river_connection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

// A free end of a reach.
struct FreeEnd {
  std::uint32_t reach = kNone;
  bool at_end = false;
};

UnionFind networksOf(const RiverNetwork& network, std::span<const std::uint8_t> barred) {
  UnionFind sets(network.nodes.size());
  for (std::size_t r = 0; r < network.reaches.size(); ++r)
    if (barred.empty() || barred[r] == 0) sets.unite(network.reaches[r].from, network.reaches[r].to);
  return sets;
}

std::vector<FreeEnd> freeEnds(const RiverNetwork& network) {
  std::vector<std::uint32_t> degree(network.nodes.size(), 0);
  for (const RiverReach& reach : network.reaches) {
    ++degree[reach.from];
    ++degree[reach.to];
  }
  std::vector<FreeEnd> ends;
  for (std::uint32_t r = 0; r < network.reaches.size(); ++r)
    for (const bool at_end : {false, true})
      if (degree[at_end ? network.reaches[r].to : network.reaches[r].from] == 1) ends.push_back({r, at_end});
  return ends;
}

// Continues the reach to a place and beyond, by `farther`.
void extend(RiverNetwork& network, const FreeEnd& end, const Point& shore, double farther) {
  RiverReach& reach = network.reaches[end.reach];
  const Point from = end.at_end ? reach.points.back() : reach.points.front();
  const Point place = shore + (farther / distance(from, shore)) * (shore - from);
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
  for (const RiverReach& own : network.reaches) connection.touches.push_back(touchesWater(own, water) ? 1 : 0);
  const auto endOf = [&](const FreeEnd& end) {
    const RiverReach& own = network.reaches[end.reach];
    const double width = rivers[end.at_end ? own.line_of.back() : own.line_of.front()].width;
    return std::pair(end.at_end ? own.points.back() : own.points.front(), width);
  };
  const std::vector<FreeEnd> ends = freeEnds(network);
  for (const FreeEnd& end : ends) {
    const auto [place, width] = endOf(end);
    if (water.holds(place)) continue;
    const auto shore = water.nearest(place, std::isfinite(reach) ? reach : kClose * width);
    if (!shore || *shore == place) continue;
    extend(network, end, *shore, width);
    ++connection.extended;
    connection.touches[end.reach] = 1;
  }
  // How far the others are, for messages.
  const std::vector<std::uint8_t> none(network.reaches.size(), 0);
  const std::vector<std::uint8_t> connected = connectedReaches(network, connection.touches, none);
  UnionFind sets = networksOf(network, {});
  std::vector<double> gap(network.nodes.size(), kInfinity);  // by root
  for (const FreeEnd& end : ends) {
    if (connected[end.reach] != 0) continue;
    const auto [place, width] = endOf(end);
    double& least = gap[sets.find(network.reaches[end.reach].from)];
    if (const auto shore = water.nearest(place, std::min(least, kFar * width))) least = distance(place, *shore);
  }
  for (const RiverReach& own : network.reaches) connection.gap.push_back(gap[sets.find(own.from)]);
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
