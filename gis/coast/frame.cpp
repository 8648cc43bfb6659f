#include "gis/coast/frame.hpp"

#include <GeographicLib/Math.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>

#include "gis/coast/box_of_frame.hpp"
#include "gis/coast/clip_chains.hpp"
#include "gis/coast/feature_bounds.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/coast/guests.hpp"
#include "gis/coast/split_frames.hpp"
#include "gis/coast/turned_rings.hpp"
#include "gis/coast/unite_frames.hpp"
#include "gis/error.hpp"
#include "gis/geometry/ring_area.hpp"

namespace coastmesh {

namespace {

constexpr double kTurn = 360;  // degrees

// Bounds without guests, which may lie in another turn.
Box boundsOfHosts(const Coastline& coastline) {
  Box bounds;
  for (const Feature& feature : coastline.features)
    if (!isGuest(feature.use)) bounds.add(boundsOf(feature));
  return bounds;
}

// Western end of the 360 degrees of longitude that the data use: -180, 0 for data from 0 to 360, or as far west of the
// data as the other end lies east of them, if they span 360 degrees at most. Longitudes of a range reach to 540.
double turnOf(const Box& data) {
  constexpr double kMost = 540;
  if (data.empty() || (data.xmin >= -180 && data.xmax <= 180)) return -180;
  if (data.xmin >= 0 && data.xmax <= kTurn) return 0;
  const double beyond = kTurn - (data.xmax - data.xmin);
  return beyond < 0 ? -180 : std::clamp(data.xmin - beyond / 2, -kMost, kMost - kTurn);
}

// Polygons of a frame are read like any others, so their coordinates may be invalid in the CRS.
void refuseOddFrames(const Coastline& coastline) {
  for (const Feature& feature : coastline.features) {
    if (feature.use != FeatureUse::Frame || !coastline.crs.geographic) continue;
    const Box box = boundsOf(feature);
    if (box.empty() || (box.ymin >= -90 && box.ymax <= 90 && box.xmin >= -540 && box.xmax <= 540)) continue;
    throw InputError(featureInWords(feature) + ": the frame reaches from " + inWords(box) +
                     " (west, south, east, north), but the input is in degrees (" + nameOf(coastline.crs) +
                     "): give its CRS in the file");
  }
}

// Unit of an input's coordinates.
struct Unit {
  bool geographic;  // degrees
  double metres;    // of a projected CRS
};

// Number of straight pieces of a frame edge, so that it is the same line in the working plane as in the input's CRS:
// areas then agree to some 2e-7, and along a parallel the direction changes by at most 2 degrees per piece.
int piecesOf(const Point& a, const Point& b, const Unit& unit) {
  constexpr double kLongest = 0.15, kLongestInPlane = 15'000, kMostTurn = 2;  // degrees of arc, metres, degrees
  constexpr double kMostInPlane = 4096;                                       // more than once around the Earth
  const double dx = std::abs(b.x - a.x), dy = std::abs(b.y - a.y);
  if (!unit.geographic) {
    const double metres = std::hypot(dx, dy) * unit.metres;
    return static_cast<int>(std::clamp(std::ceil(metres / kLongestInPlane), 1.0, kMostInPlane));
  }
  if (a.y == b.y && std::abs(a.y) == 90) return 1;  // a pole is a point
  const double middle = (a.y + b.y) / 2 * GeographicLib::Math::degree();
  const double arc = std::hypot(dx * std::cos(middle), dy), turn = dx * std::abs(std::sin(middle));
  return std::max(1, static_cast<int>(std::ceil(std::max(arc / kLongest, turn / kMostTurn))));
}

Ring inPieces(const Ring& ring, const Unit& unit) {
  Ring result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const int pieces = piecesOf(a, b, unit);
    for (int k = 0; k < pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      result.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
  }
  return result;
}

void cutLongEdges(Coastline& coastline) {
  const Unit unit{coastline.crs.geographic, metresPerUnit(coastline.crs)};
  for (Feature& feature : coastline.features) {
    if (feature.use != FeatureUse::Frame) continue;
    for (Polygon& polygon : feature.polygons) {
      polygon.outer = inPieces(polygon.outer, unit);
      for (Ring& hole : polygon.holes) hole = inPieces(hole, unit);
    }
  }
}

Polygon polygonOf(const Box& box) {
  return {{{box.xmin, box.ymin}, {box.xmax, box.ymin}, {box.xmax, box.ymax}, {box.xmin, box.ymax}}, {}};
}

// The user's box as a feature; in two parts if it extends beyond the data's range of longitudes.
Feature frameOf(const Box& given, const Crs& crs, double turn) {
  Feature frame;
  frame.fid = 0;
  frame.source = "--bbox " + inWords(given);
  frame.use = FeatureUse::Frame;
  if (!crs.geographic) {
    frame.polygons.push_back(polygonOf(given));
    return frame;
  }
  const double width = widthOf(given);
  const double turns = std::floor((given.xmin - turn) / kTurn);  // 0 if the box begins in the data's range
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

// The data to keep: disjoint intervals of longitude (or x), and one of latitude (or y).
struct Extent {
  std::vector<Interval> x;
  Interval y{0, 0};
};

// Share of its extent by which a frame is grown on each side before data beyond it are cut off.
constexpr double kMargin = 0.1;

// The extents of the frames, grown by the margin.
Extent extentOfFrames(const Coastline& coastline, double turn) {
  const bool geographic = coastline.crs.geographic;
  const Box all = boundsOfFrames(coastline);
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

// Longest piece of a side of a box that deviates from that side in the working plane by at most half of `margin`; all
// in degrees. A chord deviates by an eighth of its squared length times the curvature. A parallel at latitude p has
// geodesic curvature tan p, and the plane may add a curvature of 1 per radius of the Earth, to meridians too. The
// result is 360 degrees times 2^-3, 2^-4, ...
double longestPiece(double margin, double latitude, bool along_parallel) {
  constexpr double kLongest = 45, kShortest = 0.02;
  const double degree = GeographicLib::Math::degree();
  const double c = std::max(std::cos(latitude * degree), 1e-3), s = std::abs(std::sin(latitude * degree));
  const double longest = along_parallel ? std::sqrt(4 * margin * degree / (c * (c + s))) / degree
                                        : std::sqrt(4 * margin * degree * c) / degree;
  double piece = kLongest;
  while (piece > longest && piece > kShortest) piece /= 2;
  return piece;
}

// The clip for a geographic box: sides along parallels are divided, those along meridians if `meridians`.
ClipBox geographicClip(const Box& box, bool meridians) {
  constexpr double kMarginOfAll = kMargin / (1 + 2 * kMargin);
  ClipBox clip{box};
  const double latitude = std::min(std::max(std::abs(box.ymin), std::abs(box.ymax)), 90.0);
  const double margin = kMarginOfAll * (box.ymax - box.ymin);
  clip.piece_x = std::min(longestPiece(margin, box.ymin, true), longestPiece(margin, box.ymax, true));
  if (meridians) {
    clip.piece_y = longestPiece(kMarginOfAll * (box.xmax - box.xmin), latitude, false);
  }
  return clip;
}

std::vector<ClipBox> clipBoxes(const Extent& extent, bool geographic, double turn) {
  std::vector<ClipBox> clips;
  for (const Interval& x : extent.x) {
    const Box box{x.from, extent.y.from, x.to, extent.y.to};
    if (!geographic) {
      clips.push_back({box});
      continue;
    }
    // A side along an end of the data's range is not divided: the cut data continue within the frame at the other end,
    // with the same points on both sides.
    ClipBox clip = geographicClip(box, box.xmin > turn && box.xmax < turn + kTurn);
    for (const double shift : {0.0, -kTurn, kTurn}) {
      clip.shift = shift;
      clips.push_back(clip);
    }
  }
  return clips;
}

// Boxes for chains that continue past the end of the data's range of longitudes, as these boxes do.
std::vector<ClipBox> turnedClipBoxes(const Extent& extent, double turn) {
  std::vector<Interval> joined = extent.x;
  if (joined.size() > 1 && joined.front().from == turn && joined.back().to == turn + kTurn) {
    joined.back().to = joined.front().to + kTurn;
    joined.erase(joined.begin());
  }
  std::vector<ClipBox> clips;
  for (Interval x : joined) {
    if (x.to - x.from >= kTurn) x = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    clips.push_back(geographicClip({x.from, extent.y.from, x.to, extent.y.to}, true));
  }
  return clips;
}

// True iff `box` meets the clip. With a shift, a shared side alone does not count: it is there without the shift too.
bool meets(const Box& box, const ClipBox& clip) {
  const Box seen{box.xmin + clip.shift, box.ymin, box.xmax + clip.shift, box.ymax};
  return seen.meets(clip.box) && (clip.shift == 0 || (seen.xmax > clip.box.xmin && seen.xmin < clip.box.xmax));
}

bool within(const Box& box, const ClipBox& clip) { return clip.shift == 0 && clip.box.contains(box); }

struct Clips {
  std::vector<ClipBox> plain, turned;
  double west = 0;  // where the data's range of longitudes begins
};

// Sets the outer ring's part, and whether that is less than the ring.
void setOuter(Ring part, const Ring& given, Polygon& polygon) {
  polygon.cut.assign(1, part != given);
  polygon.outer = std::move(part);
}

void addHole(Ring part, const Ring& given, Polygon& polygon) {
  polygon.cut.resize(polygon.holes.size() + 1);
  polygon.cut.push_back(part != given);
  polygon.holes.push_back(std::move(part));
}

// Adds the parts near the frame of a polygon whose longitudes jump. Inside is even-odd over all rings, so any outer
// ring may take the holes.
void clipTurnedPolygon(const Polygon& polygon, const Clips& clips, std::vector<Polygon>& kept) {
  const auto partsOf = [&](const Ring& ring) {
    std::vector<Ring> parts;
    for (const ClipBox& clip : clips.turned) {
      std::ranges::move(clipTurnedRing(ring, clip, clips.west), std::back_inserter(parts));
      if (!parts.empty() && parts.front() == ring) break;
    }
    return parts;
  };
  const std::size_t first = kept.size();
  for (Ring& part : partsOf(polygon.outer)) setOuter(std::move(part), polygon.outer, kept.emplace_back());
  for (const Ring& hole : polygon.holes) {
    for (Ring& part : partsOf(hole)) {
      if (kept.size() == first) kept.emplace_back();
      addHole(std::move(part), hole, kept[first]);
    }
  }
}

bool jumps(const Polygon& polygon) {
  return longitudesJump(polygon.outer) || std::ranges::any_of(polygon.holes, longitudesJump);
}

bool jumps(const std::vector<Point>& line) { return turnsOf(line, false).any; }

void shift(std::vector<Point>& chain, double degrees) {
  for (Point& p : chain) p.x += degrees;
}

void shift(Polygon& polygon, double degrees) {
  shift(polygon.outer, degrees);
  for (Ring& hole : polygon.holes) shift(hole, degrees);
}

// Reduces a feature to its parts near the frame. Parts of guests are moved to the frame's longitudes.
void clipFeature(Feature& feature, const Clips& clips) {
  const Box bounds = boundsOf(feature);
  if (std::ranges::any_of(clips.plain, [&](const ClipBox& clip) { return within(bounds, clip); })) return;
  const bool may_jump = !clips.turned.empty() && bounds.xmax - bounds.xmin > kTurn / 2;
  const auto polygon_jumps = [&](const Polygon& polygon) { return may_jump && jumps(polygon); };
  const auto line_jumps = [&](const std::vector<Point>& line) { return may_jump && jumps(line); };
  const bool moves = isGuest(feature.use);
  Feature kept = feature;
  kept.polygons.clear();
  kept.lines.clear();
  kept.points.clear();
  for (const ClipBox& clip : clips.plain) {
    if (!meets(bounds, clip)) continue;
    for (const Polygon& polygon : feature.polygons) {
      if (polygon_jumps(polygon)) continue;
      Polygon part;
      setOuter(clipRing(polygon.outer, clip), polygon.outer, part);
      for (const Ring& hole : polygon.holes) {
        Ring ring = clipRing(hole, clip);
        if (!ring.empty()) addHole(std::move(ring), hole, part);
      }
      if (moves) shift(part, clip.shift);
      if (!part.outer.empty() || !part.holes.empty()) kept.polygons.push_back(std::move(part));
    }
    for (const auto& line : feature.lines) {
      if (line_jumps(line)) continue;
      for (auto& part : clipLine(line, clip)) {
        if (moves) shift(part, clip.shift);
        kept.lines.push_back(std::move(part));
      }
    }
    for (const Point& p : feature.points) {
      if (clip.box.contains({p.x + clip.shift, p.y, p.x + clip.shift, p.y})) kept.points.push_back(p);
    }
  }
  for (const Polygon& polygon : feature.polygons) {
    if (polygon_jumps(polygon)) clipTurnedPolygon(polygon, clips, kept.polygons);
  }
  for (const auto& line : feature.lines) {
    if (!line_jumps(line)) continue;
    for (const ClipBox& clip : clips.turned) {
      std::ranges::move(clipTurnedLine(line, clip, clips.west), std::back_inserter(kept.lines));
    }
  }
  feature = std::move(kept);
  feature.clipped = true;
}

bool holdsNothing(const Feature& feature) {
  return feature.polygons.empty() && feature.lines.empty() && feature.points.empty();
}

void clipToFrame(Coastline& coastline, double turn, FrameReport& report) {
  const Extent extent = extentOfFrames(coastline, turn);
  Clips clips{clipBoxes(extent, coastline.crs.geographic, turn), {}, turn};
  if (coastline.crs.geographic) clips.turned = turnedClipBoxes(extent, turn);
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

// Gives rings of land polygons, whose direction depends on the format, the direction of coastlines: water on the right.
void directAsCoasts(Feature& land) {
  for (Polygon& polygon : land.polygons) {
    if (signedAreaOf(polygon.outer) < 0.0) std::ranges::reverse(polygon.outer);
    for (Ring& hole : polygon.holes)
      if (signedAreaOf(hole) > 0.0) std::ranges::reverse(hole);
  }
}

// Sets the uses of polygons and lines within a frame.
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
  if (open_lines) {
    for (Feature& feature : coastline.features)
      if (feature.use == FeatureUse::Area && !feature.from_lines) directAsCoasts(feature);
    return setUses(coastline, FeatureUse::Coast);
  }
  setUses(coastline, FeatureUse::Land);
  if (!polygons && any(coastline, FeatureUse::Land)) {
    report.notes.push_back("the lines close rings: land lies inside them, water between them and the frame");
  }
}

// Makes everything outside the other features the last feature. A cleaned file has it already, with the coasts around
// it as rings that do not tell its inside.
void addRestOfGlobe(Coastline& coastline) {
  constexpr std::int64_t kFid = -1;
  constexpr const char* kSource = "the rest of the globe";
  const auto isRest = [&](const Feature& feature) { return feature.fid == kFid && feature.source == kSource; };
  Feature rest;
  rest.fid = kFid;
  rest.source = kSource;
  const auto earlier = std::ranges::find_if(coastline.features, isRest);
  if (earlier != coastline.features.end()) {
    rest.vertex_order = std::move(earlier->vertex_order);
    coastline.features.erase(earlier);
  }
  coastline.features.push_back(std::move(rest));
  coastline.rest = coastline.features.size() - 1;
}

}  // namespace

FrameReport frameCoastline(Coastline& coastline, const FrameOptions& options) {
  FrameReport report;
  if (options.side == DomainSide::Globe) {
    addRestOfGlobe(coastline);
    return report;
  }
  if (options.side == DomainSide::Ocean)
    return frameCoastline(coastline, {DomainSide::Outside, Box{-180.0, -90.0, 180.0, 90.0}, {}, options.in_plane});
  refuseOddFrames(coastline);
  const Box given = boundsOfHosts(coastline);
  const double turn = turnOf(given);
  if (coastline.crs.geographic) {
    bringGuests(coastline, turn);
    std::ranges::move(splitFrames(coastline, turn), std::back_inserter(report.notes));
  }
  if (options.box) {
    refuseOddBox(*options.box, coastline.crs);
    if (std::string note = wideBoxNote(*options.box, coastline.crs); !note.empty())
      report.notes.push_back(std::move(note));
    if (std::string warning = beyondEdgeWarning(*options.box, given, coastline.crs); !warning.empty())
      report.warnings.push_back(std::move(warning));
    coastline.features.push_back(frameOf(*options.box, coastline.crs, turn));
    coastline.framed_by_box = true;
  }
  const bool framed = any(coastline, FeatureUse::Frame);
  if (options.water_at) {
    coastline.water_at = options.water_at;
    setUses(coastline, FeatureUse::Coast);
  } else if (!framed && options.side == DomainSide::Outside) {
    throw InputError("--domain outside: the water needs a limit: give --bbox W,S,E,N or --clip FILE");
  }
  if (!framed) return report;
  uniteFrames(coastline);
  if (!options.in_plane && !coastline.crs.isPlane()) cutLongEdges(coastline);
  clipToFrame(coastline, turn, report);
  if (!options.water_at) chooseUses(coastline, options, report);
  for (const FeatureUse use : {FeatureUse::Area, FeatureUse::Land, FeatureUse::Coast}) {
    if (any(coastline, use)) return report;
  }
  const Feature& frame = *std::ranges::find(coastline.features, FeatureUse::Frame, &Feature::use);
  std::string reason =
      (coastline.framed_by_box ? frame.source : sourceInWords(frame.source)) + ": nothing of the input lies in it";
  if (!coastline.framed_by_box) reason += ", which reaches over " + inWords(boundsOfFrames(coastline));
  if (!given.empty()) reason += "; the input reaches over " + inWords(given);
  reason += " (west, south, east, north, in " + nameOf(coastline.crs) + ")";
  if (options.side == DomainSide::Outside) reason += "; if all of it is water, mesh a polygon of it instead";
  throw InputError(reason);
}

}  // namespace coastmesh
