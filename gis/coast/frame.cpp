#include "gis/coast/frame.hpp"

#include <GeographicLib/Math.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>

#include "gis/coast/clip_chains.hpp"
#include "gis/coast/feature_bounds.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

constexpr double kTurn = 360;  // degrees

Box boundsOf(const Coastline& coastline, bool of_frame) {
  Box box;
  for (const Feature& feature : coastline.features) {
    if ((feature.use == FeatureUse::Frame) == of_frame) box.add(boundsOf(feature));
  }
  return box;
}

std::string inWords(const Box& box) {
  char text[160];
  std::snprintf(text, sizeof text, "%.10g,%.10g,%.10g,%.10g", box.xmin, box.ymin, box.xmax, box.ymax);
  return text;
}

// The longitude from which the data's turn round the globe goes: -180, or 0 for data that go on past 180.
double turnOf(const Box& data) {
  if (data.empty() || (data.xmin >= -180 && data.xmax <= 180)) return -180;
  if (data.xmin >= 0 && data.xmax <= kTurn) return 0;
  return data.xmax - data.xmin <= kTurn ? data.xmin : -180;
}

void refuseOddBox(const Box& box, const Crs& crs) {
  const std::string given = "--bbox " + inWords(box);
  if (!(box.ymin < box.ymax)) {
    throw InputError(given + ": the south has to lie below the north (the order is west, south, east, north)");
  }
  if (!crs.geographic) {
    if (!(box.xmin < box.xmax)) throw InputError(given + ": the west has to lie below the east");
    return;
  }
  if (box.ymin < -90 || box.ymax > 90 || std::abs(box.xmin) > 540 || std::abs(box.xmax) > 540) {
    throw InputError(given + ": the input is in degrees (" + nameOf(crs) +
                     "), and these are none: give west, south, east, north in degrees");
  }
  if (box.xmin == box.xmax || box.xmax - box.xmin > kTurn) {
    throw InputError(given + ": from the west to the east it has to be more than 0 and at most 360 degrees");
  }
}

// How many straight pieces an edge of a frame is made of, so that it is the same line in the working plane as in the
// input's CRS: areas then agree to some 2e-7, and along a parallel it turns by 2 degrees at most from piece to piece.
int piecesOf(const Point& a, const Point& b, bool geographic) {
  constexpr double kLongest = 0.15, kLongestInPlane = 15'000, kMostTurn = 2;  // degrees of arc, metres, degrees
  const double dx = std::abs(b.x - a.x), dy = std::abs(b.y - a.y);
  if (!geographic) return std::max(1, static_cast<int>(std::ceil(std::hypot(dx, dy) / kLongestInPlane)));
  if (a.y == b.y && std::abs(a.y) == 90) return 1;  // a pole is a point
  const double middle = (a.y + b.y) / 2 * GeographicLib::Math::degree();
  const double arc = std::hypot(dx * std::cos(middle), dy), turn = dx * std::abs(std::sin(middle));
  return std::max(1, static_cast<int>(std::ceil(std::max(arc / kLongest, turn / kMostTurn))));
}

Ring inPieces(const Ring& ring, bool geographic) {
  Ring result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const int pieces = piecesOf(a, b, geographic);
    for (int k = 0; k < pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      result.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
  }
  return result;
}

void cutLongEdges(Feature& frame, bool geographic) {
  for (Polygon& polygon : frame.polygons) {
    polygon.outer = inPieces(polygon.outer, geographic);
    for (Ring& hole : polygon.holes) hole = inPieces(hole, geographic);
  }
}

Polygon polygonOf(const Box& box) {
  return {{{box.xmin, box.ymin}, {box.xmax, box.ymin}, {box.xmax, box.ymax}, {box.xmin, box.ymax}}, {}};
}

// The user's box as a feature; where it reaches past the end of the data's turn, in two parts.
Feature frameOf(const Box& given, const Crs& crs, double turn) {
  Feature frame;
  frame.fid = 0;
  frame.source = "--bbox " + inWords(given);
  frame.use = FeatureUse::Frame;
  if (!crs.geographic) {
    frame.polygons.push_back(polygonOf(given));
    return frame;
  }
  const double width = given.xmax - given.xmin + (given.xmax < given.xmin ? kTurn : 0);
  const double turns = std::floor((given.xmin - turn) / kTurn);  // 0 where the box lies in the data's turn
  const double west = width == kTurn ? turn : given.xmin - turns * kTurn, end = turn + kTurn;
  const double east = width == kTurn ? end : given.xmax - turns * kTurn + (given.xmax < given.xmin ? kTurn : 0);
  const auto add = [&](double from, double to) {
    if (from < to) frame.polygons.push_back(polygonOf({from, given.ymin, to, given.ymax}));
  };
  add(west, std::min(east, end));
  add(turn, east - kTurn);
  return frame;
}

struct Interval {
  double from, to;
};

// What is kept of the data: intervals of longitude (or x) that do not overlap, and one of latitude.
struct Extent {
  std::vector<Interval> x;
  Interval y{0, 0};
};

// The frames' extents, grown a little.
Extent extentOfFrames(const Coastline& coastline, double turn) {
  constexpr double kMargin = 0.1;
  const bool geographic = coastline.crs.geographic;
  const Box all = boundsOf(coastline, true);
  const double margin = kMargin * std::max(all.ymax - all.ymin, 1e-300);
  Extent extent;
  extent.y = {all.ymin - margin, all.ymax + margin};
  const auto add = [&](double from, double to) {
    if (geographic) from = std::max(from, turn), to = std::min(to, turn + kTurn);
    if (from < to) extent.x.push_back({from, to});
  };
  for (const Feature& feature : coastline.features) {
    if (feature.use != FeatureUse::Frame) continue;
    for (const Polygon& polygon : feature.polygons) {
      Box box;
      for (const Point& p : polygon.outer) box.add(p);
      const double dx = kMargin * (box.xmax - box.xmin);
      if (!geographic) {
        add(box.xmin - dx, box.xmax + dx);
        continue;
      }
      for (const double shift : {-kTurn, 0.0, kTurn}) add(box.xmin - dx + shift, box.xmax + dx + shift);
    }
  }
  std::ranges::sort(extent.x, {}, &Interval::from);
  std::vector<Interval> merged;
  for (const Interval& interval : extent.x) {
    if (merged.empty() || interval.from > merged.back().to) {
      merged.push_back(interval);
    } else {
      merged.back().to = std::max(merged.back().to, interval.to);
    }
  }
  extent.x = std::move(merged);
  return extent;
}

std::vector<ClipBox> clipBoxes(const Extent& extent, bool geographic) {
  std::vector<ClipBox> clips;
  for (const Interval& x : extent.x) {
    const Box box{x.from, extent.y.from, x.to, extent.y.to};
    clips.push_back({box, 0});
    if (!geographic) continue;
    for (const double shift : {-kTurn, kTurn}) clips.push_back({box, shift});
  }
  return clips;
}

// True iff something of `box` lies within the clip; with a turn added only where more than a side is common, since that
// side is there without it as well.
bool meets(const Box& box, const ClipBox& clip) {
  const Box seen{box.xmin + clip.shift, box.ymin, box.xmax + clip.shift, box.ymax};
  return seen.meets(clip.box) && (clip.shift == 0 || (seen.xmax > clip.box.xmin && seen.xmin < clip.box.xmax));
}

bool within(const Box& box, const ClipBox& clip) { return clip.shift == 0 && clip.box.contains(box); }

// What of a feature lies near the frame.
void clipFeature(Feature& feature, const std::vector<ClipBox>& clips) {
  const Box bounds = boundsOf(feature);
  if (std::ranges::any_of(clips, [&](const ClipBox& clip) { return within(bounds, clip); })) return;
  Feature kept = feature;
  kept.polygons.clear();
  kept.lines.clear();
  kept.points.clear();
  for (const ClipBox& clip : clips) {
    if (!meets(bounds, clip)) continue;
    for (const Polygon& polygon : feature.polygons) {
      Polygon part;
      part.outer = clipRing(polygon.outer, clip);
      for (const Ring& hole : polygon.holes) {
        Ring ring = clipRing(hole, clip);
        if (!ring.empty()) part.holes.push_back(std::move(ring));
      }
      if (!part.outer.empty() || !part.holes.empty()) kept.polygons.push_back(std::move(part));
    }
    for (const auto& line : feature.lines) std::ranges::move(clipLine(line, clip), std::back_inserter(kept.lines));
    for (const Point& p : feature.points) {
      if (clip.box.contains({p.x + clip.shift, p.y, p.x + clip.shift, p.y})) kept.points.push_back(p);
    }
  }
  feature = std::move(kept);
  feature.clipped = true;
}

bool holdsNothing(const Feature& feature) {
  return feature.polygons.empty() && feature.lines.empty() && feature.points.empty();
}

void clipToFrame(Coastline& coastline, double turn, FrameReport& report) {
  const std::vector<ClipBox> clips = clipBoxes(extentOfFrames(coastline, turn), coastline.crs.geographic);
  for (Feature& feature : coastline.features) {
    if (feature.use != FeatureUse::Frame) clipFeature(feature, clips);
  }
  report.beyond_frame += std::erase_if(coastline.features, holdsNothing);
}

bool any(const Coastline& coastline, FeatureUse use) {
  return std::ranges::any_of(coastline.features, [use](const Feature& feature) { return feature.use == use; });
}

void setUses(Coastline& coastline, FeatureUse use) {
  for (Feature& feature : coastline.features) {
    if (feature.use == FeatureUse::Area) feature.use = use;
  }
}

// What polygons and lines within a frame are.
void chooseUses(Coastline& coastline, const FrameOptions& options, FrameReport& report) {
  bool polygons = false, open_lines = false;
  for (const Feature& feature : coastline.features) {
    if (feature.use != FeatureUse::Area) continue;
    polygons = polygons || (!feature.from_lines && !feature.polygons.empty());
    open_lines = open_lines || !feature.lines.empty();
  }
  if (options.side == DomainSide::Inside) return;
  if (options.side == DomainSide::Auto && polygons) {
    report.notes.push_back("meshed inside the polygons; --domain outside meshes the water that land polygons leave");
    return;
  }
  if (open_lines) return setUses(coastline, FeatureUse::Coast);
  setUses(coastline, FeatureUse::Land);
  if (!polygons && any(coastline, FeatureUse::Land)) {
    report.notes.push_back("the lines close rings: land lies inside them, water between them and the frame");
  }
}

}  // namespace

FrameReport frameCoastline(Coastline& coastline, const FrameOptions& options) {
  FrameReport report;
  if (options.side == DomainSide::Globe) {
    Feature& rest = coastline.features.emplace_back();
    rest.fid = -1;
    rest.source = "the rest of the globe";
    coastline.rest = coastline.features.size() - 1;
    return report;
  }
  if (options.box) {
    refuseOddBox(*options.box, coastline.crs);
    const double turn = turnOf(boundsOf(coastline, false));
    coastline.features.push_back(frameOf(*options.box, coastline.crs, turn));
    coastline.framed_by_box = true;
  }
  const bool framed = any(coastline, FeatureUse::Frame);
  if (options.water_at) {
    coastline.water_at = options.water_at;
    setUses(coastline, FeatureUse::Coast);
  } else if (!framed && options.side == DomainSide::Outside) {
    throw InputError(
        "--domain outside: water outside of land has to end somewhere: give --bbox W,S,E,N or --clip FILE");
  }
  if (!framed) return report;
  for (Feature& feature : coastline.features) {
    if (feature.use == FeatureUse::Frame) cutLongEdges(feature, coastline.crs.geographic);
  }
  clipToFrame(coastline, turnOf(boundsOf(coastline, false)), report);
  if (!options.water_at) chooseUses(coastline, options, report);
  for (const FeatureUse use : {FeatureUse::Area, FeatureUse::Land, FeatureUse::Coast}) {
    if (any(coastline, use)) return report;
  }
  const Feature& frame = *std::ranges::find(coastline.features, FeatureUse::Frame, &Feature::use);
  throw InputError(frame.source + ": nothing of the input lies in it; the order is west, south, east, north, in " +
                   nameOf(coastline.crs));
}

}  // namespace coastmesh
