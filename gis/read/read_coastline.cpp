#include "gis/read/read_coastline.hpp"

#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <string_view>
#include <utility>

#include "gis/coast/feature_names.hpp"
#include "gis/coast/join_gaps.hpp"
#include "gis/coast/nest_rings.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/for_count.hpp"
#include "gis/places.hpp"
#include "gis/read/read_layers.hpp"

namespace coastmesh {

namespace {

bool looksGeographic(const Box& box) {
  return box.xmin >= -180 && box.xmax <= 180 && box.ymin >= -90 && box.ymax <= 90;
}

Crs crsOfFirst(const RawLayer& first, bool unsaid_in_plane, ReadReport& report) {
  if (first.crs && !first.crs->geographic && !first.crs->isPlane() && looksGeographic(first.bounds)) {
    report.warnings.push_back(
        sourceInWords(first.source) + ": says that it is in " + nameOf(*first.crs) +
        ", but all coordinates lie within ±180, ±90: if they are degrees, give the file EPSG:4326");
  }
  if (first.crs) return *first.crs;
  if (unsaid_in_plane) {
    report.notes.push_back(sourceInWords(first.source) + ": does not say its CRS; taken as metres in a plane");
    return {};
  }
  if (looksGeographic(first.bounds)) {
    report.warnings.push_back(sourceInWords(first.source) +
                              ": does not say its CRS; all coordinates lie within ±180, ±90, so they are taken for "
                              "longitudes and latitudes on WGS 84 (take them as a plane, or give the file a CRS, where "
                              "that is wrong)");
    return wgs84();
  }
  report.warnings.push_back(
      sourceInWords(first.source) +
      ": does not say its CRS; coordinates lie beyond ±180, ±90, so they are taken as metres in a "
      "plane");
  return {};
}

// Brings the points of a layer from one CRS to another, feature by feature.
class Reprojection {
 public:
  Reprojection(const std::string& source, const Crs& from, const Crs& to) : source_(source), name_(nameOf(to)) {
    const OGRSpatialReference from_srs = toOgr(from), to_srs = toOgr(to);
    transformation_.reset(OGRCreateCoordinateTransformation(&from_srs, &to_srs));
    if (transformation_) return;
    throw InputError(sourceInWords(source_) + ": PROJ has no transformation from its CRS, " + nameOf(from) +
                     ", to that of the first source, " + name_ +
                     (errors_.text().empty() ? "" : " (" + errors_.text() + ")"));
  }

  void apply(std::vector<Point>& chain, std::int64_t fid) const {
    std::vector<double> x(chain.size()), y(chain.size());
    for (std::size_t i = 0; i < chain.size(); ++i) x[i] = chain[i].x, y[i] = chain[i].y;
    transformation_->Transform(static_cast<int>(chain.size()), x.data(), y.data());
    for (std::size_t i = 0; i < chain.size(); ++i) {
      if (!std::isfinite(x[i]) || !std::isfinite(y[i])) {
        throw InputError(featureInWords(source_, fid) + ": the point " + std::to_string(chain[i].x) + ", " +
                         std::to_string(chain[i].y) + " has no place in " + name_ + ", the CRS of the first source");
      }
      chain[i] = {x[i], y[i]};
    }
  }

 private:
  OgrErrors errors_;
  std::string source_, name_;
  std::unique_ptr<OGRCoordinateTransformation> transformation_;
};

// Edges are straight in the new CRS, between points that are on straight edges of the old one: how far they are from
// those.
struct Bend {
  double offset = 0.0;  // the largest distance between the middles of both, in the new CRS
  std::array<Point, 2> middles{};

  void measure(const std::vector<Point>& before, const std::vector<Point>& after, const Reprojection& reprojection,
               std::int64_t fid) {
    if (after.size() < 2) return;
    std::vector<Point> middles_before;
    for (std::size_t i = 1; i < before.size(); ++i)
      middles_before.push_back({(before[i - 1].x + before[i].x) / 2, (before[i - 1].y + before[i].y) / 2});
    reprojection.apply(middles_before, fid);
    for (std::size_t i = 1; i < after.size(); ++i) {
      const Point straight{(after[i - 1].x + after[i].x) / 2, (after[i - 1].y + after[i].y) / 2};
      const Point& bent = middles_before[i - 1];
      const double here = std::hypot(bent.x - straight.x, bent.y - straight.y);
      const double length = std::hypot(after[i].x - after[i - 1].x, after[i].y - after[i - 1].y);
      constexpr double kNoted = 0.005;                                          // of the edge's length
      if (here < kNoted * length || here <= offset || here > length) continue;  // beyond: longitudes that jump
      offset = here;
      middles = {bent, straight};
    }
  }
};

// The sides of a frame are where the mesh ends: how far they are from where the user sees them in its own CRS.
std::string bendWarning(const RawLayer& frame, const std::vector<Feature>& before, const Reprojection& reprojection,
                        const Crs& crs) {
  Bend bend;
  const auto closed = [](Ring ring) {
    if (!ring.empty()) ring.push_back(ring.front());
    return ring;
  };
  for (std::size_t f = 0; f < before.size(); ++f)
    for (std::size_t p = 0; p < before[f].polygons.size(); ++p)
      bend.measure(closed(before[f].polygons[p].outer), closed(frame.features[f].polygons[p].outer), reprojection,
                   before[f].fid);
  if (bend.offset == 0.0) return {};
  const double metres = chainLengths({{bend.middles[0], bend.middles[1]}}, crs).front();
  char distance[40];
  std::snprintf(distance, sizeof distance, metres < 1000.0 ? "%.3g m" : "%.3g km",
                metres < 1000.0 ? metres : metres / 1000.0);
  return sourceInWords(frame.source) + ": its sides are straight in " + nameOf(crs) +
         ", the CRS of the first source, " + "and up to " + distance + " from where they are in its own, " +
         nameOf(*frame.crs) + ", at " + placeInWords(bend.middles[1]) +
         "; points along them keep them in place (ogr2ogr -segmentize)";
}

void bringTo(const Crs& crs, const RawLayer& first, RawLayer& layer, ReadReport& report) {
  if (!layer.crs) {
    if (crs.geographic && !looksGeographic(layer.bounds)) {
      throw InputError(sourceInWords(layer.source) +
                       ": does not say its CRS, and its coordinates are not longitudes and latitudes as those of " +
                       sourceInWords(first.source) + " are: give the file a CRS");
    }
    if (first.crs) {
      report.warnings.push_back(sourceInWords(layer.source) +
                                ": does not say its CRS; taken to be in that of the first source, " + nameOf(crs));
    }
    return;
  }
  if (sameCrs(*layer.crs, crs)) return;
  if (crs.isPlane() || layer.crs->isPlane()) {
    const bool first_lacks = crs.isPlane();
    throw InputError(sourceInWords(first_lacks ? first.source : layer.source) +
                     ": is in a plane without a place on Earth, while " +
                     sourceInWords(first_lacks ? layer.source : first.source) + " is in " +
                     nameOf(first_lacks ? *layer.crs : crs) + ": give both a CRS");
  }
  const Reprojection reprojection(layer.source, *layer.crs, crs);
  const bool is_frame = layer.use == FeatureUse::Frame;
  const std::vector<Feature> before = is_frame ? layer.features : std::vector<Feature>();
  for (Feature& feature : layer.features) {
    for (Polygon& polygon : feature.polygons) {
      reprojection.apply(polygon.outer, feature.fid);
      for (Ring& hole : polygon.holes) reprojection.apply(hole, feature.fid);
    }
    for (auto& line : feature.lines) reprojection.apply(line, feature.fid);
    reprojection.apply(feature.vertex_order, feature.fid);
  }
  if (is_frame)
    if (std::string warning = bendWarning(layer, before, reprojection, crs); !warning.empty())
      report.warnings.push_back(std::move(warning));
  for (Feature& feature : layer.line_features) reprojection.apply(feature.points, feature.fid);
  for (RawLayer::Line& line : layer.lines) {
    reprojection.apply(line.points, layer.line_features[line.feature].fid);
  }
}

// The feature that a line came from.
struct LineOrigin {
  const RawLayer* layer;
  std::size_t feature;

  Feature named() const { return layer->line_features[feature]; }
};

// Adds lines that are not joined, such as constraints and weirs, each to its own feature.
void addPlainLines(RawLayer& layer, Coastline& coastline) {
  std::vector<Feature> features = std::move(layer.line_features);
  for (RawLayer::Line& line : layer.lines) features[line.feature].lines.push_back(std::move(line.points));
  std::move(features.begin(), features.end(), std::back_inserter(coastline.features));
}

bool joinsLines(FeatureUse use) { return use == FeatureUse::Area || use == FeatureUse::Frame; }

// The mesh knows features by their numbers.
void warnOfEqualNumbers(const RawLayer& layer, ReadReport& report) {
  if (layer.use != FeatureUse::Area) return;
  const auto ofFid = [](const Feature& feature) { return feature.fid; };
  // Ascending in most files.
  const auto unsorted = std::ranges::adjacent_find(layer.features, std::ranges::greater_equal(), ofFid);
  if (unsorted == layer.features.end()) return;
  std::vector<std::pair<std::string_view, std::int64_t>> numbers;  // a cleaned file has features of several sources
  for (const Feature& feature : layer.features) numbers.emplace_back(feature.source, feature.fid);
  std::ranges::sort(numbers);
  std::size_t count = 0;
  std::int64_t first = 0;
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    if (numbers[i] != numbers[i - 1] || (i > 1 && numbers[i] == numbers[i - 2])) continue;
    if (++count == 1) first = numbers[i].second;
  }
  if (count == 0) return;
  report.warnings.push_back(
      sourceInWords(layer.source) + ": " +
      (count == 1 ? "number " + std::to_string(first) + " is that of several features"
                  : std::to_string(count) + " numbers are those of several features, as " + std::to_string(first)) +
      ": src_fid does not tell them apart");
}

void noteGaps(const std::vector<ClosedGap>& gaps, ReadReport& report) {
  if (gaps.empty()) return;
  report.notes.push_back(std::to_string(gaps.size()) +
                         forCount(gaps.size(), " gap between ends of lines was closed",
                                  " gaps between ends of lines were closed, the first") +
                         " at " + placeInWords(gaps.front().to) + " (--snap)");
}

void addJoinedLines(std::vector<RawLayer>& layers, FeatureUse use, const SnapDistance& snap, Coastline& coastline,
                    ReadReport& report) {
  std::vector<std::vector<Point>> lines;
  std::vector<LineOrigin> origins;
  for (RawLayer& layer : layers) {
    if (layer.use != use) continue;
    for (RawLayer::Line& line : layer.lines) {
      lines.push_back(std::move(line.points));
      origins.push_back({&layer, line.feature});
    }
  }
  if (lines.empty()) return;
  std::vector<ClosedGap> gaps;
  JoinedLines joined = joinAcrossGaps(lines, snap, coastline.crs, gaps);
  noteGaps(gaps, report);
  std::vector<Ring> rings;
  rings.reserve(joined.rings.size());
  for (JoinedLines::Part& part : joined.rings) rings.push_back(std::move(part.points));
  report.rings += rings.size();
  for (const NestedRing& nested : nestRings(rings, coastline.crs.geographic)) {
    Feature feature = origins[joined.rings[nested.outer].origin].named();
    feature.from_lines = true;
    Polygon& polygon = feature.polygons.emplace_back();
    polygon.outer = std::move(rings[nested.outer]);
    for (const std::size_t hole : nested.holes) polygon.holes.push_back(std::move(rings[hole]));
    coastline.features.push_back(std::move(feature));
  }
  for (JoinedLines::Part& part : joined.open) {
    Feature feature = origins[part.origin].named();
    feature.from_lines = true;
    feature.lines.push_back(std::move(part.points));
    coastline.features.push_back(std::move(feature));
  }
}

}  // namespace

Coastline readCoastline(const std::vector<std::string>& paths, ReadReport& report) {
  std::vector<Source> sources;
  for (const std::string& path : paths) sources.push_back({path, FeatureUse::Area});
  return readCoastline(sources, {}, report);
}

Coastline readCoastline(const std::vector<Source>& sources, const ReadFilter& filter, ReadReport& report,
                        const SeeLayers& see_areas, const SnapIn& snap_in) {
  if (sources.empty()) throw InputError("no input was given: name at least one vector source");
  std::vector<RawLayer> layers;
  ReadFilter of_guests;
  of_guests.unsaid_in_plane = filter.unsaid_in_plane;
  for (const Source& source : sources) {
    const bool is_area = source.use == FeatureUse::Area;
    std::vector<RawLayer> of_source = readLayers(source, is_area ? filter : of_guests, report);
    if (is_area && see_areas) see_areas(of_source);
    for (RawLayer& layer : of_source)
      if (layer.use != FeatureUse::Boundary) layers.push_back(std::move(layer));
  }
  Coastline coastline;
  const bool none_says = std::ranges::none_of(layers, [](const RawLayer& layer) { return layer.crs.has_value(); });
  coastline.crs = crsOfFirst(layers.front(), filter.unsaid_in_plane && none_says, report);
  for (std::size_t i = 1; i < layers.size(); ++i) bringTo(coastline.crs, layers.front(), layers[i], report);
  for (RawLayer& layer : layers) {
    warnOfEqualNumbers(layer, report);
    if (coastline.features.empty()) {
      coastline.features = std::move(layer.features);
    } else {
      std::move(layer.features.begin(), layer.features.end(), std::back_inserter(coastline.features));
    }
  }
  const SnapDistance snap = snap_in ? snap_in(coastline.crs) : SnapDistance{};
  for (const FeatureUse use : {FeatureUse::Area, FeatureUse::Frame})
    addJoinedLines(layers, use, snap, coastline, report);
  for (RawLayer& layer : layers) {
    if (!joinsLines(layer.use)) addPlainLines(layer, coastline);
  }
  report.features = static_cast<std::uint64_t>(
      std::ranges::count(coastline.features, FeatureUse::Area, [](const Feature& feature) { return feature.use; }));
  report.features += report.not_read;
  if (report.skipped_empty > 0)
    report.notes.push_back(std::to_string(report.skipped_empty) + forCount(report.skipped_empty,
                                                                           " feature without a shape is left out",
                                                                           " features without a shape are left out"));
  return coastline;
}

}  // namespace coastmesh
