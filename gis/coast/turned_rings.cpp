#include "gis/coast/turned_rings.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace coastmesh {

namespace {

enum class Step { Plain, Jump, WholeTurn };

Step stepOf(const Point& a, const Point& b) {
  const double width = std::abs(a.x - b.x);
  if (width <= 180 || (a.y == b.y && std::abs(a.y) == 90)) return Step::Plain;
  return width == 360 ? Step::WholeTurn : Step::Jump;
}

int turnOf(const Point& a, const Point& b) { return a.x > b.x ? 1 : -1; }

// True for a band round the globe: the others of its places lie between its edges of 360 degrees, and it runs along the
// meridian where they end, as a map does. Where an island crosses that meridian, either is mostly not so.
bool isBand(const Ring& ring) {
  double south = 90, north = -90, west = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if (stepOf(a, b) != Step::WholeTurn) continue;
    south = std::min({south, a.y, b.y});
    north = std::max({north, a.y, b.y});
    west = std::min(a.x, b.x);
  }
  bool along = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if (a.y < south || a.y > north) return false;
    along = along || (a.x == b.x && a.y != b.y && (a.x == west || a.x == west + 360));
  }
  return along;
}

// True if edges of exactly 360 degrees jump.
bool wholeTurnsJump(const std::vector<Point>& lonlat, std::size_t edges) {
  const bool closed = edges == lonlat.size();
  bool by_others = false, any = false;
  int net_of_others = 0, net = 0;
  for (std::size_t i = 0; i < edges; ++i) {
    const Point &a = lonlat[i], &b = lonlat[(i + 1) % lonlat.size()];
    const Step step = stepOf(a, b);
    by_others = by_others || step == Step::Jump;
    any = any || step == Step::WholeTurn;
    if (step == Step::Jump) net_of_others += turnOf(a, b);
    if (step == Step::WholeTurn) net += turnOf(a, b);
  }
  if (!any) return false;
  return by_others ? net_of_others != 0 || net == 0 : closed && net == 0 && !isBand(lonlat);
}

}  // namespace

Turns turnsOf(const std::vector<Point>& lonlat, bool closed) {
  Turns turns;
  if (lonlat.empty()) return turns;
  const std::size_t edges = closed ? lonlat.size() : lonlat.size() - 1;
  const bool whole_turns_jump = wholeTurnsJump(lonlat, edges);
  turns.of.reserve(lonlat.size());
  turns.of.push_back(0);
  for (std::size_t i = 0; i < edges; ++i) {
    const Point &a = lonlat[i], &b = lonlat[(i + 1) % lonlat.size()];
    const Step step = stepOf(a, b);
    const bool jumps = step == Step::Jump || (step == Step::WholeTurn && whole_turns_jump);
    const int turn = turns.of.back() + (jumps ? turnOf(a, b) : 0);
    turns.any = turns.any || jumps;
    turns.of.push_back(turn);
  }
  if (closed) {
    turns.round = turns.of.back();
    turns.of.pop_back();
  }
  return turns;
}

bool longitudesJump(const Ring& lonlat) {
  bool whole_turns = false;
  for (std::size_t i = 0; i < lonlat.size(); ++i) {
    const Step step = stepOf(lonlat[i], lonlat[(i + 1) % lonlat.size()]);
    if (step == Step::Jump) return true;
    whole_turns = whole_turns || step == Step::WholeTurn;
  }
  return whole_turns && wholeTurnsJump(lonlat, lonlat.size());
}

double poleWithin(const Ring& lonlat) {
  const double sum =
      std::accumulate(lonlat.begin(), lonlat.end(), 0.0, [](double so_far, const Point& p) { return so_far + p.y; });
  return sum < 0 ? -90 : 90;
}

std::vector<Ring> turnedRings(const Ring& lonlat) {
  const Turns turns = turnsOf(lonlat, true);
  if (!turns.any) return {lonlat};
  Ring ring;
  ring.reserve(lonlat.size() + 3);
  for (std::size_t i = 0; i < lonlat.size(); ++i) ring.push_back({lonlat[i].x + 360.0 * turns.of[i], lonlat[i].y});
  if (turns.round != 0) {
    const double pole = poleWithin(lonlat), first = ring.front().x, last = first + 360.0 * turns.round;
    ring.insert(ring.end(), {{last, ring.front().y}, {last, pole}, {first, pole}});
  }
  std::vector<Ring> rings;
  for (const double shift : {-360.0, 0.0, 360.0}) {
    rings.push_back(ring);
    for (Point& p : rings.back()) p.x += shift;
  }
  return rings;
}

}  // namespace coastmesh
