#include "gis/grid/map_parts.hpp"

#include <algorithm>
#include <cmath>

#include "gis/grid/on_sphere.hpp"

namespace coastmesh {
namespace {

constexpr double kTurn = 360.0;

// A point of a path around a triangle, with unwrapped longitudes: `turn` whole turns away from its place on the map.
struct WayPoint {
  Point place;
  int turn = 0;

  double lon() const { return place.x + kTurn * turn; }
};

bool isPole(const Point& place) { return std::abs(place.y) == 90.0; }

// The latitude of the great circle through two places, less than half a turn apart, at a longitude between theirs; on a
// pole's line, that of the pole. Independent of their order.
double latitudeAt(double lon, const WayPoint& from, const WayPoint& to) {
  const bool in_order = std::pair(from.place.x, from.place.y) <= std::pair(to.place.x, to.place.y);
  const WayPoint &a = in_order ? from : to, &b = in_order ? to : from;
  if (isPole(a.place) && a.place.y == b.place.y) return a.place.y;
  const auto seen = [](const WayPoint& point) { return onSphere({point.lon(), point.place.y}); };
  // Where the plane of the two meets that of the meridian, on the meridian's side.
  const SphereVector normal = cross(seen(a), seen(b)), east = onSphere({lon + 90.0, 0.0});
  SphereVector met = cross(normal, east);
  if (dot(met, onSphere({lon, 0.0})) < 0.0) met = scaled(met, -1.0);
  return placeOf(met).lat;
}

using Way = std::vector<WayPoint>;

// Degrees to the east, within half a turn.
double stepBetween(const Point& from, const Point& to) { return std::remainder(to.x - from.x, kTurn); }

// Puts `to` within half a turn of the point before it.
WayPoint following(const WayPoint& before, const Point& to) {
  const double lon = before.lon() + stepBetween(before.place, to);
  return {to, static_cast<int>(std::lround((lon - to.x) / kTurn))};
}

// The corners on the map, where a pole is a line: a pole at a corner, or on an edge, becomes two points.
std::vector<Point> onMap(const std::array<Point, 3>& corners) {
  std::vector<Point> path;
  for (unsigned i = 0; i < 3; ++i) {
    const Point &p = corners[i], &before = corners[prev3(i)], &after = corners[next3(i)];
    if (isPole(p)) {
      path.push_back({before.x, p.y});
      path.push_back({after.x, p.y});
      continue;
    }
    path.push_back(p);
    if (!isPole(after) && std::abs(stepBetween(p, after)) == kTurn / 2) {
      const double pole = p.y + after.y >= 0.0 ? 90.0 : -90.0;
      path.push_back({p.x, pole});
      path.push_back({after.x, pole});
    }
  }
  return path;
}

// Makes a path around a pole start and end on the meridian of the map's end, and return along the pole's line.
Way roundPole(const Way& way, int turns, double end) {
  const std::size_t n = way.size();
  const auto at = [&](std::size_t i) {
    WayPoint point = way[i % n];
    point.turn += turns * static_cast<int>(i / n);
    return point;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const WayPoint from = at(i), to = at(i + 1);
    const double low = std::min(from.lon(), to.lon()), high = std::max(from.lon(), to.lon());
    const double meridian = end + kTurn * std::ceil((low - end) / kTurn);
    if (meridian < low || meridian >= high) continue;
    const double lat = latitudeAt(meridian, from, to), pole = at(0).place.y > 0.0 ? 90.0 : -90.0;
    const int turn = static_cast<int>(std::lround((meridian - end) / kTurn));
    Way closed{{{end, lat}, turn}};
    for (std::size_t k = 1; k <= n; ++k) closed.push_back(at(i + k));
    closed.push_back({{end, lat}, turn + turns});
    closed.push_back({{end, pole}, turn + turns});
    closed.push_back({{end, pole}, turn});
    return closed;
  }
  return way;
}

// The part of the path to the east (`sign` 1) or west (-1) of the meridian `end` + `turn` turns.
Way clipped(const Way& way, double end, int turn, double sign) {
  const double meridian = end + kTurn * turn;
  const auto inside = [&](const WayPoint& point) { return sign * (point.lon() - meridian) >= 0.0; };
  Way kept;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const WayPoint &from = way[i], &to = way[(i + 1) % way.size()];
    if (inside(from)) kept.push_back(from);
    if (inside(from) == inside(to) || from.lon() == meridian || to.lon() == meridian) continue;
    kept.push_back({{end, latitudeAt(meridian, from, to)}, turn});
  }
  return kept;
}

// Collects the parts of a line, each within one turn of the map.
class LineParts {
 public:
  explicit LineParts(double end) : end_(end) {}

  void interrupt() { is_open_ = false; }

  // REQUIRES: `from` and `to` are less than half a turn apart.
  void add(const WayPoint& from, const WayPoint& to) {
    const double low = std::min(from.lon(), to.lon()), high = std::max(from.lon(), to.lon());
    const int turn = static_cast<int>(std::ceil((high - end_) / kTurn));
    const double meridian = end_ + kTurn * (turn - 1);
    if (low == high) {
      // On the meridian of the map's end either side will do: the one that the line comes from, else that of its nodes.
      addWithin(from, to, low != end_ + kTurn * turn ? turn : is_open_ ? turn_ : from.turn);
    } else if (low < meridian) {
      const int before = from.lon() < to.lon() ? turn - 1 : turn, after = from.lon() < to.lon() ? turn : turn - 1;
      const WayPoint met{{end_, latitudeAt(meridian, from, to)}, turn - 1};
      addWithin(from, met, before);
      addWithin(met, to, after);
    } else {
      addWithin(from, to, turn);
    }
  }

  std::vector<std::vector<Point>> take() { return std::move(parts_); }

 private:
  static Point onTurn(const WayPoint& point, int turn) {
    const int away = point.turn - turn;
    return away == 0 ? point.place : Point{point.place.x + kTurn * away, point.place.y};
  }

  void addWithin(const WayPoint& from, const WayPoint& to, int turn) {
    if (!is_open_ || turn != turn_) parts_.push_back({onTurn(from, turn)});
    is_open_ = true;
    turn_ = turn;
    parts_.back().push_back(onTurn(to, turn));
  }

  double end_;
  int turn_ = 0;
  bool is_open_ = false;
  std::vector<std::vector<Point>> parts_;
};

bool hasArea(const Way& way) {
  const auto [low, high] = std::ranges::minmax(way, {}, &WayPoint::lon);
  return high.lon() > low.lon();
}

}  // namespace

MapCutter::MapCutter(const Grid& grid) : grid_(grid) {
  if (!grid.crs.geographic || grid.nodes.empty()) return;
  double low = grid.nodes[0].x, high = low;
  bool has_pole = false;
  for (const Point& p : grid.nodes) {
    if (isPole(p)) {  // has any longitude
      has_pole = true;
      continue;
    }
    low = std::min(low, p.x);
    high = std::max(high, p.x);
  }
  const bool can_cut = has_pole || high - low >= kTurn / 2;
  if (!can_cut || high - low > kTurn) return;
  // `lon`, by whole turns, between the eastern end of the nodes and their western end a turn later, if it is there.
  const auto within = [&](double lon) {
    const double end = lon + kTurn * std::ceil((high - lon) / kTurn);
    return end <= low + kTurn ? std::optional(end) : std::nullopt;
  };
  end_ = within(180.0);
  if (!end_) end_ = within(0.0);
  if (!end_) end_ = (high + low + kTurn) / 2;
}

bool MapCutter::cuts(const std::array<std::uint32_t, 3>& corners) const {
  if (!end_) return false;
  for (unsigned i = 0; i < 3; ++i) {
    const Point &p = grid_.nodes[corners[i]], &q = grid_.nodes[corners[next3(i)]];
    if (isPole(p) || std::abs(q.x - p.x) >= kTurn / 2) return true;
  }
  return false;
}

bool MapCutter::cutsLine(std::span<const std::uint32_t> nodes) const {
  if (!end_) return false;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const Point &p = grid_.nodes[nodes[i - 1]], &q = grid_.nodes[nodes[i]];
    if (isPole(p) || isPole(q) || std::abs(q.x - p.x) >= kTurn / 2) return true;
  }
  return false;
}

std::vector<std::vector<Point>> MapCutter::partsOfLine(std::span<const std::uint32_t> nodes) const {
  if (!cutsLine(nodes)) {
    std::vector<Point> whole;
    for (const std::uint32_t node : nodes) whole.push_back(grid_.nodes[node]);
    return {std::move(whole)};
  }
  LineParts parts(*end_);
  WayPoint at{grid_.nodes[nodes[0]], 0};
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const Point &p = grid_.nodes[nodes[i - 1]], &q = grid_.nodes[nodes[i]];
    if (isPole(q)) {
      if (!isPole(p)) parts.add(at, {{at.place.x, q.y}, at.turn});
      continue;
    }
    if (isPole(p)) {
      parts.interrupt();
      at = {{q.x, p.y}, 0};
    } else if (std::abs(stepBetween(p, q)) == kTurn / 2) {
      const double pole = p.y + q.y >= 0.0 ? 90.0 : -90.0;
      parts.add(at, {{at.place.x, pole}, at.turn});
      parts.interrupt();
      at = {{q.x, pole}, 0};
    }
    const WayPoint to = following(at, q);
    parts.add(at, to);
    at = to;
  }
  return parts.take();
}

bool MapCutter::cutsAny() const {
  return end_ && std::ranges::any_of(grid_.triangles, [this](const auto& corners) { return cuts(corners); });
}

std::vector<MapCutter::Ring> MapCutter::partsOf(const std::array<std::uint32_t, 3>& corners) const {
  const std::array<Point, 3> places{grid_.nodes[corners[0]], grid_.nodes[corners[1]], grid_.nodes[corners[2]]};
  if (!cuts(corners)) return {{places.begin(), places.end()}};
  const std::vector<Point> path = onMap(places);
  Way way{{path[0], 0}};
  for (std::size_t i = 1; i < path.size(); ++i) way.push_back(following(way.back(), path[i]));
  int turns = following(way.back(), path[0]).turn;
  if (path.size() > 3 && turns != 0) {
    // Half a turn along the pole's line may go either way: it must return the way that the rest of the path came.
    bool past_pole = false;
    for (std::size_t i = 1; i < way.size(); ++i) {
      past_pole = past_pole || (isPole(way[i].place) && isPole(way[i - 1].place));
      if (past_pole) way[i].turn -= turns;
    }
    turns = 0;
  }
  if (turns != 0) way = roundPole(way, turns, *end_);
  const auto [low, high] = std::ranges::minmax(way, {}, &WayPoint::lon);
  const auto turnOf = [this](double lon) { return static_cast<int>(std::ceil((lon - *end_) / kTurn)); };
  std::vector<Ring> parts;
  for (int turn = turnOf(low.lon()); turn <= turnOf(high.lon()); ++turn) {
    const Way part = clipped(clipped(way, *end_, turn, -1.0), *end_, turn - 1, 1.0);
    if (part.size() < 3 || !hasArea(part)) continue;
    Ring ring;
    for (const WayPoint& point : part) {
      const int on_map = point.turn - turn;
      const Point place{on_map == 0 ? point.place.x : point.place.x + kTurn * on_map, point.place.y};
      if (ring.empty() || ring.back() != place) ring.push_back(place);
    }
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    if (ring.size() >= 3) parts.push_back(std::move(ring));
  }
  if (parts.empty()) parts.push_back({places.begin(), places.end()});
  return parts;
}

}  // namespace coastmesh
