#include "gis/coast/turned_rings.hpp"

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

// True if edges of exactly 360 degrees jump.
bool wholeTurnsJump(const std::vector<Point>& lonlat, std::size_t edges) {
  bool others = false;
  int by_jumps = 0, by_whole_turns = 0;
  for (std::size_t i = 0; i < edges; ++i) {
    const Point &a = lonlat[i], &b = lonlat[(i + 1) % lonlat.size()];
    const Step step = stepOf(a, b);
    others = others || step == Step::Jump;
    if (step == Step::Jump) by_jumps += turnOf(a, b);
    if (step == Step::WholeTurn) by_whole_turns += turnOf(a, b);
  }
  return others && !(by_jumps == 0 && by_whole_turns != 0);
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
  for (std::size_t i = 0; i < lonlat.size(); ++i) {
    if (stepOf(lonlat[i], lonlat[(i + 1) % lonlat.size()]) == Step::Jump) return true;
  }
  return false;
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
