#include "gis/clean/seam.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gis/coast/turned_rings.hpp"

namespace coastmesh {

namespace {

// Adds the latitudes strictly between those of a and b, in the order from a to b.
void addBetween(const Point& a, const Point& b, const std::vector<double>& latitudes, std::vector<Point>& points) {
  const auto low = std::upper_bound(latitudes.begin(), latitudes.end(), std::min(a.y, b.y));
  const auto high = std::lower_bound(low, latitudes.end(), std::max(a.y, b.y));
  const auto begin = static_cast<std::ptrdiff_t>(points.size());
  for (auto at = low; at != high; ++at) points.push_back({a.x, *at});
  if (a.y > b.y) std::reverse(points.begin() + begin, points.end());
}

constexpr double kTurn = 360;  // degrees

// Degrees of longitude that the rings span.
struct Span {
  double west = std::numeric_limits<double>::infinity(), east = -west;

  bool isTurn() const { return east - west >= kTurn; }
  // True if the span holds the longitude a turn to the west or to the east of x.
  bool repeats(double x) const { return x - west >= kTurn || east - x >= kTurn; }
};

Span spanOf(const std::vector<Ring*>& rings) {
  Span span;
  for (const Ring* ring : rings) {
    for (const Point& p : *ring) span.west = std::min(span.west, p.x), span.east = std::max(span.east, p.x);
  }
  return span;
}

// Calls `visit(a, b)` for each edge of the ring, in order. If the edge jumps from one end of the map to the other, `b`
// is moved by a turn, to where it lies beside `a`: edges along a meridian have one longitude.
template <typename Visit>
void forEachEdge(const Ring& ring, Visit&& visit) {
  const Turns turns = turnsOf(ring, true);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const bool last = i + 1 == ring.size();
    const Point& next = ring[last ? 0 : i + 1];
    const int jump = (last ? turns.round : turns.of[i + 1]) - turns.of[i];
    visit(ring[i], Point{next.x + kTurn * jump, next.y});
  }
}

CutMeridians cutsOf(const std::vector<Ring*>& rings, const Span& span) {
  std::vector<double> longitudes;
  for (const Ring* ring : rings) {
    forEachEdge(*ring, [&](const Point& a, const Point& b) {
      if (a.x == b.x && span.repeats(a.x)) longitudes.push_back(a.x);
    });
  }
  return CutMeridians(std::move(longitudes));
}

// Points of the rings on one cut.
struct OnCut {
  double longitude = 0;  // of one of them
  std::vector<double> latitudes;
};

std::vector<OnCut> pointsOn(const CutMeridians& cuts, const std::vector<Ring*>& rings, const Span& span) {
  std::vector<OnCut> points(cuts.count());
  for (const Ring* ring : rings) {
    for (const Point& p : *ring) {
      const auto cut = span.repeats(p.x) ? cuts.at(p.x) : std::nullopt;
      if (!cut) continue;
      points[*cut].longitude = p.x;
      points[*cut].latitudes.push_back(p.y);
    }
  }
  for (auto& [longitude, latitudes] : points) {
    std::ranges::sort(latitudes);
    latitudes.erase(std::ranges::unique(latitudes).begin(), latitudes.end());
  }
  return points;
}

bool joinsTurns(const Projection& projection, const OnCut& cut, const Span& span) {
  const double middle = cut.latitudes[cut.latitudes.size() / 2];
  const double turn = cut.longitude - span.west >= kTurn ? -kTurn : kTurn;
  const Point here = projection.forward({cut.longitude, middle});
  const Point there = projection.forward({cut.longitude + turn, middle});
  return std::hypot(there.x - here.x, there.y - here.y) < 1e-3;
}

}  // namespace

std::optional<Seam> healSeam(const std::vector<Ring*>& rings, const Crs& crs, const Projection& projection) {
  if (!crs.geographic) return std::nullopt;
  const Span span = spanOf(rings);
  if (!span.isTurn()) return std::nullopt;
  Seam seam{cutsOf(rings, span)};
  if (seam.cuts.count() == 0) return std::nullopt;
  const std::vector<OnCut> points = pointsOn(seam.cuts, rings, span);
  if (!std::ranges::all_of(points, [&](const OnCut& cut) { return joinsTurns(projection, cut, span); }))
    return std::nullopt;

  for (Ring* ring : rings) {
    Ring healed;
    healed.reserve(ring->size());
    forEachEdge(*ring, [&](const Point& a, const Point& b) {
      healed.push_back(a);
      if (a.x != b.x || !span.repeats(a.x)) return;
      if (const auto cut = seam.cuts.at(a.x)) addBetween(a, b, points[*cut].latitudes, healed);
    });
    *ring = std::move(healed);
  }
  return seam;
}

}  // namespace coastmesh
