#include "gis/clean/clean.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <tuple>

#include "gis/clean/clean_faces.hpp"
#include "gis/clean/clean_pinches.hpp"
#include "gis/clean/clean_simplify.hpp"
#include "gis/clean/domain_of_edges.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/coast/snap_distance.hpp"
#include "gis/error.hpp"
#include "gis/geometry/chain_index.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

// Text that names the two nearest loose ends of lines, at which no other line begins or ends, and advises to join them;
// without their names if there are fewer than two, or too many to join by hand.
std::string adviceOnEnds(const Coastline& coastline, const std::vector<std::size_t>& members,
                         const Projection& projection) {
  constexpr std::size_t kMost = 2000;
  std::vector<Point> ends;
  for (const std::size_t member : members) {
    for (const auto& line : coastline.features[member].lines) {
      if (line.size() < 2) continue;
      ends.push_back(line.front());
      ends.push_back(line.back());
    }
  }
  std::ranges::sort(ends, lexLess);
  std::vector<Point> loose, plane;
  std::vector<double> scales;  // of the plane
  for (std::size_t i = 0; i < ends.size(); ++i)
    if ((i == 0 || ends[i - 1] != ends[i]) && (i + 1 == ends.size() || ends[i + 1] != ends[i]))
      loose.push_back(ends[i]);
  if (loose.size() < 2 || loose.size() > kMost) return ": join them";
  std::ranges::transform(loose, std::back_inserter(plane), [&](const Point& p) { return projection.forward(p); });
  std::ranges::transform(plane, std::back_inserter(scales), [&](const Point& p) { return projection.scaleAt(p); });
  std::size_t a = 0, b = 1;
  const auto gap = [&](std::size_t i, std::size_t j) {  // on the ground
    return 2 * std::hypot(plane[i].x - plane[j].x, plane[i].y - plane[j].y) / (scales[i] + scales[j]);
  };
  for (std::size_t i = 0; i < plane.size(); ++i)
    for (std::size_t j = i + 1; j < plane.size(); ++j)
      if (gap(i, j) < gap(a, b)) std::tie(a, b) = std::pair(i, j);
  char width[40];
  std::snprintf(width, sizeof width, gap(a, b) < 100.0 ? "%.3g" : "%.0f", gap(a, b));
  const std::string with_snap = gap(a, b) <= kMostSnapped ? ", with --snap too" : "";
  return " (the nearest ends, " + placeInWords(loose[a]) + " and " + placeInWords(loose[b]) + ", are " + width +
         (projection.isIdentity() ? "" : " m") + " apart): join them" + with_snap;
}

void refuseEmpty(const Coastline& coastline, const std::vector<std::size_t>& members,
                 const std::vector<Segment>& segments, const Projection& projection) {
  for (const Segment& segment : segments) {
    if (segment.left >= 0 || segment.right >= 0) return;
  }
  bool has_polygon = false, has_frame = false, has_land = false;
  for (const std::size_t member : members) {
    const Feature& feature = coastline.features[member];
    has_frame = has_frame || feature.use == FeatureUse::Frame;
    has_polygon = has_polygon || !feature.polygons.empty();
    has_land = has_land || feature.use == FeatureUse::Land || feature.use == FeatureUse::Coast;
  }
  if (has_frame && !has_land) throw NothingWanted(featuresInWords(coastline, members) + ": lies outside of the frame");
  if (has_frame) throw InputError("the frame holds no water: all of it is land");
  throw InputError(featuresInWords(coastline, members) + ": " +
                   (has_polygon ? "the polygons enclose no area"
                                : "the lines close no ring, so there is nothing to mesh" +
                                      adviceOnEnds(coastline, members, projection) +
                                      ", or close them with --bbox W,S,E,N or --clip FILE"));
}

// Removes edits outside the frame, where nothing is meshed, except for points that were requested there.
void keepFramedEdits(const Coastline& coastline, const std::vector<std::size_t>& members, std::size_t first,
                     CleanReport& report) {
  ChainIndex frame(ChainIndex::Kind::Rings);
  for (const std::size_t member : members) {
    if (coastline.features[member].use != FeatureUse::Frame) continue;
    for (const Polygon& polygon : coastline.features[member].polygons) {
      frame.add(polygon.outer);
      for (const Ring& hole : polygon.holes) frame.add(hole);
    }
  }
  frame.build();
  if (frame.edgeCount() == 0) return;
  const auto beyond = [&](const Edit& edit) {
    for (const double turn : {0.0, -360.0, 360.0}) {
      if (frame.locate({edit.place.x + turn, edit.place.y}) != Location::Outside) return false;
      if (!coastline.crs.geographic) break;
    }
    return edit.kind != EditKind::OutsideWater;
  };
  const auto from = report.edits.begin() + static_cast<std::ptrdiff_t>(first);
  const auto kept = std::stable_partition(from, report.edits.end(), [&](const Edit& edit) { return !beyond(edit); });
  for (auto edit = kept; edit != report.edits.end(); ++edit) --report.counts[static_cast<std::size_t>(edit->kind)];
  report.edits.erase(kept, report.edits.end());
}

}  // namespace

Domain cleanFeatures(const Coastline& coastline, const std::vector<std::size_t>& members, const Projection& projection,
                     const CleanOptions& options, CleanReport& report, const ItemLoop& loop) {
  const std::size_t edits_before = report.edits.size();
  CleanChains chains = makeChains(coastline, members, projection, options, report, loop);
  const NodedEdges edges = nodeChains(chains, coastline, projection, report, loop);
  LabelledEdges labelled = labelFaces(chains, edges, coastline, projection, options.dissolve, report, loop);
  if (options.pinches == Pinches::Keep) reportPinches(chains.vertices, labelled.segments, coastline, report);
  if (!coastline.rest) refuseEmpty(coastline, members, labelled.segments, projection);
  keepFramedEdits(coastline, members, edits_before, report);
  reportOpenLines(coastline, chains, labelled, projection, report);
  const Resolution& resolution = chains.resolution;
  if (options.dissolve) {
    labelled.segments = dropTraces(chains.vertices, labelled, coastline, projection, resolution, report);
  }
  if (options.simplify_m > 0) {
    labelled.segments =
        simplifyEdges(chains.vertices, labelled, coastline, projection, resolution, options.simplify_m, report);
  }
  if (options.pinches == Pinches::Open) {
    labelled.segments =
        openPinches(chains.vertices, std::move(labelled.segments), coastline, projection, resolution, report);
  }
  const RegionId beyond = labelled.beyond;
  Domain domain = domainOf(chains.vertices, std::move(labelled), projection, resolution);
  if (coastline.rest) domain.rest = static_cast<RegionId>(*coastline.rest), domain.beyond = beyond;
  return domain;
}

}  // namespace coastmesh
