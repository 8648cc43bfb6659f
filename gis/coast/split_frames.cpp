#include "gis/coast/split_frames.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "gis/coast/feature_bounds.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/coast/ogr_polygons.hpp"
#include "gis/coast/turned_rings.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

constexpr double kTurn = 360;  // degrees

// A point, and the turns to add to its longitude so that its ring does not jump.
struct Placed {
  Point p;
  int turns = 0;

  double longitude() const { return p.x + kTurn * turns; }
};

using PlacedRing = std::vector<Placed>;

// Adds points where the edge from a to b crosses `west`, or a full turn from it.
void addCrossings(const Placed& a, const Placed& b, double west, PlacedRing& ring) {
  const double from = a.longitude(), to = b.longitude();
  const double low = std::floor((std::min(from, to) - west) / kTurn) + 1;
  const double high = std::ceil((std::max(from, to) - west) / kTurn) - 1;
  const int count = static_cast<int>(high - low) + 1;
  for (int k = 0; k < count; ++k) {
    const double turns = from < to ? low + k : high - k;
    const double t = (west + kTurn * turns - from) / (to - from);
    ring.push_back({{west, a.p.y + t * (b.p.y - a.p.y)}, static_cast<int>(turns)});
  }
}

// Closes a ring that ends `round` turns from its start through the pole, along the meridian `west`.
void closeThroughPole(PlacedRing& ring, int round, double pole, double west) {
  const auto isAtWest = [&](const Placed& at) { return std::remainder(at.longitude() - west, kTurn) == 0; };
  const auto start = std::ranges::find_if(ring, isAtWest);
  for (auto at = ring.begin(); at != start; ++at) at->turns += round;
  std::rotate(ring.begin(), start, ring.end());
  const Placed first = ring.front();
  const Placed last{first.p, first.turns + round};
  ring.insert(ring.end(), {last, {{first.p.x, pole}, last.turns}, {{first.p.x, pole}, first.turns}});
}

// The ring continued past the antimeridian, with points where it crosses `west` or a full turn from it.
PlacedRing placed(const Ring& lonlat, double west) {
  const Turns turns = turnsOf(lonlat, true);
  PlacedRing ring;
  for (std::size_t i = 0; i < lonlat.size(); ++i) {
    const bool last = i + 1 == lonlat.size();
    const Placed a{lonlat[i], turns.of[i]};
    const Placed b = last ? Placed{lonlat.front(), turns.round} : Placed{lonlat[i + 1], turns.of[i + 1]};
    ring.push_back(a);
    addCrossings(a, b, west, ring);
  }
  if (turns.round != 0) closeThroughPole(ring, turns.round, poleWithin(lonlat), west);
  return ring;
}

class Splitting {
 public:
  Splitting(const Feature& frame, double west) : frame_(frame), west_(west) {
    constexpr double kBeyond = 100;  // degrees north and south
    const double east = west + kTurn;
    range_ = shapeOf({Polygon{{{west, -kBeyond}, {east, -kBeyond}, {east, kBeyond}, {west, kBeyond}}, {}}});
  }

  // The polygon's parts within the range.
  std::vector<Polygon> partsOf(const Polygon& polygon) const {
    Shape shape = insideOf(polygon.outer);
    for (const Ring& hole : polygon.holes) shape = required(shape->Difference(insideOf(hole).get()));
    std::vector<Polygon> parts;
    for (const OGRPolygon* part : polygonsOf(*shape)) parts.push_back(fromOgr(*part));
    return parts;
  }

 private:
  // The inside of the ring, brought into the range.
  Shape insideOf(const Ring& lonlat) const {
    OGRMultiPolygon parts;
    if (lonlat.size() < 3) return Shape(parts.clone());
    const PlacedRing ring = placed(lonlat, west_);
    const auto [first, last] = std::ranges::minmax(ring, {}, &Placed::longitude);
    for (double turns = std::floor((first.longitude() - west_) / kTurn); west_ + kTurn * turns < last.longitude();
         ++turns) {
      Ring seen;
      for (const Placed& at : ring) seen.push_back({at.p.x + kTurn * (at.turns - turns), at.p.y});
      const Shape valid = required(shapeOf({Polygon{std::move(seen), {}}})->MakeValid());
      const Shape part = required(valid->Intersection(range_.get()));
      for (const OGRPolygon* polygon : polygonsOf(*part)) parts.addGeometry(polygon);
    }
    return parts.IsEmpty() ? Shape(parts.clone()) : required(parts.UnionCascaded());
  }

  Shape required(OGRGeometry* made) const {
    if (made) return Shape(made);
    throw InputError(featureInWords(frame_) + ": the frame cannot be split at the antimeridian" +
                     (errors_.text().empty() ? "" : " (" + errors_.text() + ")") + ": split it there first");
  }

  const Feature& frame_;
  double west_;
  OgrErrors errors_;
  Shape range_;
};

// The longest jump of a polygon's rings; nullopt if none jumps.
std::optional<std::pair<Point, Point>> jumpOf(const Polygon& polygon) {
  std::optional<std::pair<Point, Point>> longest;
  const auto lookAt = [&](const Ring& ring) {
    if (!longitudesJump(ring)) return;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if (!longest || std::abs(b.x - a.x) > std::abs(longest->second.x - longest->first.x)) longest = {a, b};
    }
  };
  lookAt(polygon.outer);
  std::ranges::for_each(polygon.holes, lookAt);
  return longest;
}

std::string noteOfJump(const Feature& frame, const std::pair<Point, Point>& jump) {
  char text[160];
  std::snprintf(text, sizeof text, "%.10g,%.10g to %.10g,%.10g", jump.first.x, jump.first.y, jump.second.x,
                jump.second.y);
  return featureInWords(frame) + ": the frame's edge from " + text +
         " is taken across the antimeridian; for the way round the rest of the globe, divide it";
}

}  // namespace

std::vector<std::string> splitFrames(Coastline& coastline, double west) {
  std::vector<std::string> notes;
  for (Feature& feature : coastline.features) {
    if (feature.use != FeatureUse::Frame) continue;
    const Box bounds = boundsOf(feature);
    const bool within = bounds.xmin >= west && bounds.xmax <= west + kTurn;
    if (bounds.empty() || (within && bounds.xmax - bounds.xmin <= kTurn / 2)) continue;
    const Splitting splitting(feature, west);
    std::optional<std::pair<Point, Point>> jump;
    std::vector<Polygon> parts;
    for (Polygon& polygon : feature.polygons) {
      const auto jumps = polygon.outer.empty() ? std::nullopt : jumpOf(polygon);
      if (!jump) jump = jumps;
      if (polygon.outer.empty() || (within && !jumps)) {
        parts.push_back(std::move(polygon));
      } else {
        std::ranges::move(splitting.partsOf(polygon), std::back_inserter(parts));
      }
    }
    if (jump) notes.push_back(noteOfJump(feature, *jump));
    feature.polygons = std::move(parts);
  }
  return notes;
}

}  // namespace coastmesh
