#include "gis/grid/one_turn.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gis/geometry/box.hpp"

namespace coastmesh {
namespace {

using Corners = std::array<std::uint32_t, 3>;

constexpr double kTurn = 360.0;
constexpr double kMostEast = 540.0;  // readers reject longitudes beyond this

bool isPole(const Point& place) { return std::abs(place.y) == 90.0; }

// The longitudes of triangles: west within ±180, east not less than west.
struct Arc {
  double west, east;
};

// Returns nullopt for a triangle around a pole.
std::optional<Arc> arcOf(std::span<const Point> nodes, const Corners& corners) {
  std::array<double, 3> lon;
  unsigned count = 0;
  for (const std::uint32_t node : corners)
    if (!isPole(nodes[node])) lon[count++] = nodes[node].x;
  if (count == 0) return Arc{0.0, 0.0};
  double at = lon[0], west = at, east = at;
  for (unsigned i = 1; i < count; ++i) {
    at += std::remainder(lon[i] - lon[i - 1], kTurn);
    west = std::min(west, at);
    east = std::max(east, at);
  }
  const double back = at + std::remainder(lon[0] - lon[count - 1], kTurn);
  if (std::abs(back - lon[0]) > kTurn / 2) return std::nullopt;
  const double turns = kTurn * std::floor((west + kTurn / 2) / kTurn);
  return Arc{west - turns, east - turns};
}

// Merges arcs that meet; sorted.
std::vector<Arc> merged(std::vector<Arc> arcs) {
  std::ranges::sort(arcs, {}, &Arc::west);
  std::vector<Arc> apart;
  for (const Arc& arc : arcs) {
    if (apart.empty() || arc.west > apart.back().east)
      apart.push_back(arc);
    else
      apart.back().east = std::max(apart.back().east, arc.east);
  }
  return apart;
}

// Returns nullopt if a triangle surrounds a pole.
std::optional<std::vector<Arc>> arcsOf(std::span<const Point> nodes, std::span<const Corners> triangles,
                                       const ItemLoop& loop) {
  struct Stretch {
    std::vector<Arc> arcs;
    bool round_pole = false;
  };
  const auto stretches = overStretches(loop, triangles.size(), [&](std::size_t first, std::size_t last) {
    Stretch stretch;
    for (std::size_t t = first; t < last; ++t) {
      const std::optional<Arc> arc = arcOf(nodes, triangles[t]);
      if (arc) stretch.arcs.push_back(*arc);
      stretch.round_pole = stretch.round_pole || !arc;
    }
    stretch.arcs = merged(std::move(stretch.arcs));
    return stretch;
  });
  std::vector<Arc> all;
  for (const Stretch& stretch : stretches) {
    if (stretch.round_pole) return std::nullopt;
    all.insert(all.end(), stretch.arcs.begin(), stretch.arcs.end());
  }
  return merged(std::move(all));
}

// The longitude in the middle of the widest gap between sorted arcs; nullopt if there is none.
std::optional<double> middleOfGap(const std::vector<Arc>& arcs) {
  double widest = 0.0, middle = 0.0, east = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    east = std::max(east, arcs[i].east);
    // The last gap ends at the first arc, a turn later.
    const double next = i + 1 < arcs.size() ? arcs[i + 1].west : arcs[0].west + kTurn;
    if (next - east <= widest) continue;
    widest = next - east;
    middle = east + widest / 2;
  }
  return widest > 0.0 ? std::optional(middle) : std::nullopt;
}

}  // namespace

bool longitudesJump(std::span<const Point> nodes, const Corners& corners) {
  for (unsigned i = 0; i < 3; ++i) {
    const Point &p = nodes[corners[i]], &q = nodes[corners[next3(i)]];
    if (std::abs(q.x - p.x) > kTurn / 2 && !isPole(p) && !isPole(q)) return true;
  }
  return false;
}

std::optional<std::vector<Point>> inOneTurn(std::span<const Point> nodes, std::span<const Corners> triangles,
                                            const ItemLoop& loop) {
  if (nodes.empty()) return std::nullopt;
  const Box all = boxAround(nodes, loop);
  if (!(all.xmax - all.xmin > kTurn / 2)) return std::nullopt;  // skips the triangles of most meshes
  const auto any = overStretches(loop, triangles.size(), [&](std::size_t first, std::size_t last) {
    return static_cast<char>(
        std::ranges::any_of(triangles.subspan(first, last - first),
                            [nodes](const Corners& corners) { return longitudesJump(nodes, corners); }));
  });
  if (std::ranges::none_of(any, [](char jumped) { return jumped != 0; })) return std::nullopt;
  const std::optional<std::vector<Arc>> arcs = arcsOf(nodes, triangles, loop);
  const std::optional<double> gap = arcs ? middleOfGap(*arcs) : std::nullopt;
  if (!gap) return std::nullopt;
  // Turns begin in the middle of the gap, where no node is so close that rounding could put it on the other side.
  const auto turnsOf = [start = *gap](const Point& p) { return -std::floor((p.x - start) / kTurn); };
  double west = std::numeric_limits<double>::infinity(), east = -west, turns_of_west = 0.0;
  for (const Corners& corners : triangles) {
    for (const std::uint32_t node : corners) {
      const double turns = turnsOf(nodes[node]), lon = nodes[node].x + kTurn * turns;
      if (isPole(nodes[node])) continue;
      east = std::max(east, lon);
      if (lon < west) west = lon, turns_of_west = turns;
    }
  }
  if (east - kTurn * turns_of_west > kMostEast) ++turns_of_west;
  std::vector<Point> turned(nodes.begin(), nodes.end());
  forEachByStretches(loop, turned.size(), [&](std::size_t i) {
    if (!isPole(nodes[i])) turned[i].x += kTurn * (turnsOf(nodes[i]) - turns_of_west);
  });
  return turned;
}

TurnedNodes::TurnedNodes(Grid& grid, const ItemLoop& loop) {
  if (!grid.crs.geographic) return;
  std::optional<std::vector<Point>> turned = inOneTurn(grid.nodes, grid.triangles, loop);
  if (!turned) return;
  const auto [least, greatest] = std::ranges::minmax(grid.nodes, {}, &Point::x);
  west_ = least.x;
  if (least.x >= 0.0 && greatest.x <= kTurn) west_ = 0.0;
  if (least.x >= -kTurn / 2 && greatest.x <= kTurn / 2) west_ = -kTurn / 2;
  for (std::size_t i = 0; i < turned->size(); ++i)
    if ((*turned)[i] != grid.nodes[i]) was_.push_back({(*turned)[i], grid.nodes[i].x});
  std::ranges::sort(was_, lexLess, &Turned::place);
  grid.nodes.assign(turned->begin(), turned->end());
}

void TurnedNodes::putBack(Grid& grid) const {
  if (!any()) return;
  for (Point& node : grid.nodes) node = putBack(node);
}

Point TurnedNodes::putBack(const Point& place) const {
  if (!any()) return place;
  const auto known = std::ranges::lower_bound(was_, place, lexLess, &Turned::place);
  if (known != was_.end() && known->place == place) return {known->was, place.y};
  if (place.x >= west_ && place.x <= west_ + kTurn) return place;
  return {place.x - kTurn * std::floor((place.x - west_) / kTurn), place.y};
}

}  // namespace coastmesh
