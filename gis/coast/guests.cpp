#include "gis/coast/guests.hpp"

#include <algorithm>
#include <cmath>

#include "gis/coast/turned_rings.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

namespace {

constexpr double kTurn = 360;  // degrees

// Degrees to add to longitudes so that all of `box` lies in the range that begins at `west`; 0 if none do that.
double shiftOf(const Box& box, double west) {
  const double east = west + kTurn;
  if (box.empty() || (box.xmin >= west && box.xmax <= east)) return 0;
  const double shift = -kTurn * std::floor((box.xmin - west) / kTurn);
  return box.xmax + shift <= east ? shift : 0;
}

// Moves chains together; one by one, the points of chains that jump.
void bring(const std::vector<std::vector<Point>*>& chains, bool jump, double west) {
  Box all;
  for (const auto* chain : chains) {
    for (const Point& p : *chain) all.add(p);
  }
  const double together = shiftOf(all, west);
  for (auto* chain : chains) {
    for (Point& p : *chain) p.x += jump ? shiftOf(Box::of(p, p), west) : together;
  }
}

void bringPolygon(Polygon& polygon, double west) {
  std::vector<std::vector<Point>*> rings{&polygon.outer};
  for (Ring& hole : polygon.holes) rings.push_back(&hole);
  bring(rings, std::ranges::any_of(rings, [](const Ring* ring) { return longitudesJump(*ring); }), west);
}

}  // namespace

void bringGuests(Coastline& coastline, double west) {
  for (Feature& feature : coastline.features) {
    if (!isGuest(feature.use) || feature.use == FeatureUse::Frame) continue;
    for (Polygon& polygon : feature.polygons) bringPolygon(polygon, west);
    for (auto& line : feature.lines) bring({&line}, turnsOf(line, false).any, west);
    bring({&feature.points}, true, west);
  }
}

}  // namespace coastmesh
