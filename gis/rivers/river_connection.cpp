#include "gis/rivers/river_connection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/ids.hpp"
#include "core/metric.hpp"
#include "core/union_find.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kClose = 3.0;  // widths
constexpr double kFar = 300.0;  // widths; beyond, the distance is not reported
constexpr double kAlike = 2.0;  // ends that are at most this many times as far as the nearest one

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

class Connector {
 public:
  Connector(RiverNetwork& network, std::span<const PlaneRiver> rivers, const MeshWater& water)
      : network_(network), rivers_(rivers), water_(water), ends_(freeEnds(network)), sets_(networksOf(network, {})) {
    for (const RiverReach& own : network.reaches) connection_.touches.push_back(touchesWater(own, water) ? 1 : 0);
  }

  RiverConnection connect(double reach) {
    if (std::isfinite(reach)) {
      for (const FreeEnd& end : ends_)
        if (const auto shore = shoreBeside(end, reach)) extend(end, *shore);
    } else {
      extendClose();
      extendApart();
    }
    for (const FreeEnd& end : ends_) widenMouth(end);
    findGaps();
    return std::move(connection_);
  }

 private:
  Point placeOf(const FreeEnd& end) const {
    const RiverReach& own = network_.reaches[end.reach];
    return end.at_end ? own.points.back() : own.points.front();
  }
  double widthOf(const FreeEnd& end) const {
    const RiverReach& own = network_.reaches[end.reach];
    return rivers_[end.at_end ? own.line_of.back() : own.line_of.front()].width;
  }
  std::uint32_t networkOf(const FreeEnd& end) { return sets_.find(network_.reaches[end.reach].from); }

  // Nothing for an end in the water.
  std::optional<NearWater> shoreBeside(const FreeEnd& end, double reach) const {
    const Point place = placeOf(end);
    if (water_.holds(place)) return std::nullopt;
    const auto shore = water_.nearest(place, reach);
    return shore && shore->distance > 0.0 ? shore : std::nullopt;
  }

  // The same for water far away, nearby first: most ends have none.
  std::optional<NearWater> shoreAround(const FreeEnd& end) const {
    const double width = widthOf(end);
    for (double widths = kClose; widths < 2.0 * kFar; widths *= 4.0)
      if (const auto shore = shoreBeside(end, std::min(widths, kFar) * width)) return shore;
    return std::nullopt;
  }

  void extendClose() {
    for (const FreeEnd& end : ends_)
      if (const auto shore = shoreBeside(end, widthOf(end))) extend(end, *shore);
  }

  std::vector<std::uint8_t> networksWithWater() {
    std::vector<std::uint8_t> has_water(network_.nodes.size(), 0);
    for (std::size_t r = 0; r < network_.reaches.size(); ++r)
      if (connection_.touches[r] != 0) has_water[sets_.find(network_.reaches[r].from)] = 1;
    return has_water;
  }

  void extendApart() {
    const std::vector<std::uint8_t> has_water = networksWithWater();
    std::vector<double> least(network_.nodes.size(), kInfinity);  // by network: the nearest of the ends that are close
    std::vector<std::optional<NearWater>> shores;
    for (const FreeEnd& end : ends_) {
      std::optional<NearWater> shore = shoreAround(end);
      if (shore && shore->distance > std::max(kClose * widthOf(end), shore->edge)) shore.reset();
      if (shore) least[networkOf(end)] = std::min(least[networkOf(end)], shore->distance);
      shores.push_back(shore);
    }
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      if (!shores[i]) continue;
      const std::uint32_t network = networkOf(ends_[i]);
      if (has_water[network] == 0 && shores[i]->distance <= kAlike * least[network])
        extend(ends_[i], *shores[i]);
      else
        connection_.left.push_back(placeOf(ends_[i]));
    }
  }

  void extend(const FreeEnd& end, const NearWater& shore) {
    const Point from = placeOf(end);
    connection_.extended.push_back(from);
    connection_.touches[end.reach] = 1;
    moveEnd(end, shore.place + (widthOf(end) / shore.distance) * (shore.place - from));
  }

  void moveEnd(const FreeEnd& end, const Point& place) {
    RiverReach& reach = network_.reaches[end.reach];
    network_.nodes[end.at_end ? reach.to : reach.from] = place;
    if (end.at_end) {
      reach.points.push_back(place);
      reach.line_of.push_back(reach.line_of.back());
    } else {
      reach.points.insert(reach.points.begin(), place);
      reach.line_of.insert(reach.line_of.begin(), reach.line_of.front());
    }
  }

  // An end just behind a shore that the river meets at an angle would have one bank on land.
  void widenMouth(const FreeEnd& end) {
    constexpr double kStep = 0.25;  // widths
    const RiverReach& reach = network_.reaches[end.reach];
    const Point place = placeOf(end);
    const Point before = end.at_end ? reach.points[reach.points.size() - 2] : reach.points[1];
    const double width = widthOf(end);
    const Point along = (width / distance(before, place)) * (place - before), half{-0.5 * along.y, 0.5 * along.x};
    if (!water_.holds(place)) return;
    for (double widths = 0.0; widths <= kClose; widths += kStep) {
      const Point middle = place + widths * along;
      if (!water_.holds(middle)) return;
      if (!water_.holds(middle + half) || !water_.holds(middle - half)) continue;
      if (widths > 0.0) moveEnd(end, middle);
      return;
    }
  }

  // How far the networks without water are from it, for messages.
  void findGaps() {
    const std::vector<std::uint8_t> has_water = networksWithWater();
    std::vector<double> gap(network_.nodes.size(), kInfinity);
    for (const FreeEnd& end : ends_) {
      double& least = gap[networkOf(end)];
      if (has_water[networkOf(end)] != 0) continue;
      if (const auto shore = shoreAround(end)) least = std::min(least, shore->distance);
    }
    for (const RiverReach& own : network_.reaches) connection_.gap.push_back(gap[sets_.find(own.from)]);
  }

  RiverNetwork& network_;
  std::span<const PlaneRiver> rivers_;
  const MeshWater& water_;
  const std::vector<FreeEnd> ends_;
  UnionFind sets_;
  RiverConnection connection_;
};

}  // namespace

RiverConnection connectRivers(RiverNetwork& network, std::span<const PlaneRiver> rivers, const MeshWater& water,
                              double reach) {
  return Connector(network, rivers, water).connect(reach);
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
