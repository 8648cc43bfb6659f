#include "gis/rivers/river_connection.hpp"

#include <algorithm>
#include <array>
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
constexpr double kTiny = 1e-6;  // widths
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
    for (const FreeEnd& end : ends_) is_line_end_.push_back(isLineEnd(end));
  }

  RiverConnection connect(double reach, bool over_land) {
    if (std::isfinite(reach)) {
      for (const FreeEnd& end : ends_)
        if (const auto shore = shoreBeside(end, reach)) extend(end, *shore);
    } else {
      extendClose();
      extendApart();
    }
    for (const FreeEnd& end : ends_) widenMouth(end);
    if (over_land)
      for (const FreeEnd& end : ends_) leadOut(end);
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

  // Nothing for an end in the water, or of a river that has just left it.
  std::optional<NearWater> shoreBeside(const FreeEnd& end, double reach) const {
    const Point place = placeOf(end);
    return isInWater(end) || comesFromWater(end) ? std::nullopt : water_.nearest(place, reach);
  }

  bool comesFromWater(const FreeEnd& end) const {
    constexpr std::array kBefore{0.25, 0.5, 1.0, 1.5, 2.0};  // widths
    return std::ranges::any_of(kBefore,
                               [&](double widths) { return water_.holds(placeOf(end) - widths * alongOf(end)); });
  }

  // An end on a shore may be on either side of it.
  bool isInWater(const FreeEnd& end) const {
    constexpr double kOnShore = 1e-3;  // widths
    const Point place = placeOf(end);
    if (!water_.holds(place)) return false;
    const Point beyond = place + kOnShore * alongOf(end);
    return water_.holds(beyond) && water_.holds(place - kOnShore * alongOf(end));
  }

  // A width in the direction in which the river ends.
  Point alongOf(const FreeEnd& end) const {
    const RiverReach& own = network_.reaches[end.reach];
    const Point place = placeOf(end), before = end.at_end ? own.points[own.points.size() - 2] : own.points[1];
    return (widthOf(end) / distance(before, place)) * (place - before);
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

  // True if the end is the last place of its line, false if it is the first.
  bool isLineEnd(const FreeEnd& end) const {
    const RiverReach& own = network_.reaches[end.reach];
    const std::vector<Point>& line = rivers_[end.at_end ? own.line_of.back() : own.line_of.front()].points;
    return squaredDistance(placeOf(end), line.back()) < squaredDistance(placeOf(end), line.front());
  }

  // By network: above 0 if most of its ends in the water are last places of their lines, below 0 if they are first
  // ones.
  std::vector<int> directions() {
    std::vector<int> all(network_.nodes.size(), 0);
    for (std::size_t i = 0; i < ends_.size(); ++i)
      if (water_.holds(placeOf(ends_[i]))) all[networkOf(ends_[i])] += is_line_end_[i] ? 1 : -1;
    return all;
  }

  // Ends that are close, but not within a width. Springs may be, too: of a network that has water, those are continued
  // that are mouths if all lines are drawn in the same direction; of others the nearest, and those like it.
  void extendApart() {
    const std::vector<std::uint8_t> has_water = networksWithWater();
    std::vector<int> direction = directions();
    std::vector<double> least(network_.nodes.size(), kInfinity);  // by network: the nearest of the ends that are close
    std::vector<std::optional<NearWater>> shores;
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      const std::uint32_t network = networkOf(ends_[i]);
      std::optional<NearWater> shore = shoreAround(ends_[i]);
      if (shore && shore->distance > std::max(kClose * widthOf(ends_[i]), shore->edge)) shore.reset();
      shores.push_back(shore);
      if (!shore || shore->distance >= least[network]) continue;
      least[network] = shore->distance;
      if (has_water[network] == 0) direction[network] = is_line_end_[i] ? 1 : -1;
    }
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      if (!shores[i]) continue;
      const std::uint32_t network = networkOf(ends_[i]);
      const bool is_mouth = is_line_end_[i] ? direction[network] > 0 : direction[network] < 0;
      const bool is_like_nearest = has_water[network] == 0 && shores[i]->distance <= kAlike * least[network];
      if (is_mouth || is_like_nearest)
        extend(ends_[i], *shores[i]);
      else
        connection_.left.push_back(placeOf(ends_[i]));
    }
  }

  void extend(const FreeEnd& end, const NearWater& shore) {
    const Point from = placeOf(end), gap = shore.place - from;
    const double least = kTiny * widthOf(end);
    const Point along = shore.distance > least ? (widthOf(end) / shore.distance) * gap : alongOf(end);
    auto place = placeWithin(shore.place, along);
    // A narrow inlet may lie in another direction.
    if (!place)
      place =
          placeWithin(shore.place, (widthOf(end) / distance(shore.place, shore.inside)) * (shore.inside - shore.place));
    if (!place) place = shore.inside;
    if (shore.distance > least) connection_.extended.push_back(from);
    connection_.touches[end.reach] = 1;
    moveEnd(end, *place);
  }

  bool holdsBanks(const Point& middle, const Point& along) const {
    const Point half{-0.5 * along.y, 0.5 * along.x};
    return water_.holds(middle + half) && water_.holds(middle - half);
  }

  // A place in the water beyond its shore, from `shore` on in the direction of `along`, a width, or as close to that as
  // possible: where both banks are in the water too, within three widths; else, as at the head of an inlet, a width
  // away, or less.
  std::optional<Point> placeWithin(const Point& shore, const Point& along) const {
    constexpr double kStep = 0.25;  // widths
    constexpr std::array kTurnsDeg{0.0, 30.0, -30.0, 60.0, -60.0, 90.0, -90.0};
    std::optional<Point> narrow;
    double farthest = 0.0;
    for (const double turn : kTurnsDeg) {
      const double c = std::cos(toRadians(turn)), s = std::sin(toRadians(turn));
      const Point ahead{c * along.x - s * along.y, s * along.x + c * along.y};
      for (double widths = kStep; widths <= kClose; widths += kStep) {
        const Point middle = shore + widths * ahead;
        if (!water_.holds(middle)) break;
        if (widths >= 1.0 && holdsBanks(middle, ahead)) return middle;
        if (widths > 1.0 || widths <= farthest) continue;
        farthest = widths;
        narrow = middle;
      }
    }
    return narrow;
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

  // An end just behind a shore would have a bank on land, if the river meets the shore at an angle or is wider than the
  // water there.
  void widenMouth(const FreeEnd& end) {
    if (!isInWater(end) || holdsBanks(placeOf(end), alongOf(end))) return;
    if (const auto place = placeWithin(placeOf(end), alongOf(end))) moveEnd(end, *place);
  }

  // Continues an end on land close to the mesh's edge, or across it, until both banks are beyond it.
  void leadOut(const FreeEnd& end) {
    constexpr double kStep = 0.125;  // widths
    const Point place = placeOf(end), along = alongOf(end);
    const Point half{-0.5 * along.y, 0.5 * along.x};
    const auto isOnLand = [&](const Point& p) { return water_.holds(p) && water_.isLandAt(p); };
    const std::array banks{place, place + half, place - half};
    if (std::ranges::none_of(banks, isOnLand)) return;
    const auto isBeyond = [&](double widths) {
      return std::ranges::none_of(banks, [&](const Point& p) { return water_.holds(p + widths * along); });
    };
    for (double widths = kStep; widths <= kClose + 1.0; widths += kStep) {
      if (!isBeyond(widths)) continue;
      connection_.led_out.push_back(place);
      moveEnd(end, place + widths * along);
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
  std::vector<bool> is_line_end_;  // of each of them, as they were
  UnionFind sets_;
  RiverConnection connection_;
};

}  // namespace

RiverConnection connectRivers(RiverNetwork& network, std::span<const PlaneRiver> rivers, const MeshWater& water,
                              double reach, bool over_land) {
  return Connector(network, rivers, water).connect(reach, over_land);
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
