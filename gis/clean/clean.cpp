#include "gis/clean/clean.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>

#include "gis/clean/clean_faces.hpp"
#include "gis/clean/clean_pinches.hpp"
#include "gis/clean/clean_simplify.hpp"
#include "gis/clean/domain_of_edges.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/coast/flood_plains.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/coast/snap_distance.hpp"
#include "gis/error.hpp"
#include "gis/for_count.hpp"
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

// Open lines among the features to mesh become edges where they are in the water, and are dropped elsewhere. Such a
// line may be a wharf, but also the shore of an island or a lake with a gap, which would be lost in silence.
class OpenLines {
 public:
  OpenLines(const Coastline& coastline, const CleanChains& chains, const LabelledEdges& labelled,
            const Projection& projection)
      : coastline_(coastline), vertices_(chains.vertices), projection_(projection) {
    std::vector<std::uint32_t> degree(vertices_.plane.size(), 0);
    for (const Segment& s : labelled.segments) ++degree[s.a], ++degree[s.b];
    for (const Segment& s : labelled.segments) {
      if (!isLineTag(s.tag)) continue;
      const std::size_t feature = labelled.lines[lineOfTag(s.tag)].feature;
      if (!isToMesh(feature)) continue;
      within_[feature] += distance(s.a, s.b);
      for (const VertexId v : {s.a, s.b})
        if (degree[v] == 1) loose_.push_back({v, feature});
    }
    if (!chains.framed) findDropped(chains, degree);
  }

  void report(CleanReport& report) const {
    note(within_,
         {" line of the input closes no ring, and is an edge with water on both sides: ",
          " lines of the input close no ring, and are edges with water on both sides, the first: "},
         report);
    note(dropped_,
         {" line of the input closes no ring, and is left out, as it is not in the water: ",
          " lines of the input close no ring, and are left out, as they are not in the water, the first: "},
         report);
    warnOfGaps(report);
  }

 private:
  struct LooseEnd {
    VertexId vertex;
    std::size_t feature;
  };
  struct Gap {
    LooseEnd a, b;
    double length;
  };

  using Lengths = std::map<std::size_t, double>;  // by feature

  bool isToMesh(std::size_t feature) const {
    return coastline_.features[feature].use == FeatureUse::Area && !isFloodPlain(coastline_.features[feature]);
  }

  // Lines along a shore are none of these.
  void findDropped(const CleanChains& chains, const std::vector<std::uint32_t>& degree) {
    for (const CleanChain& chain : chains.chains) {
      if (chain.role != CleanChain::Role::Line || !isToMesh(chain.feature) || within_.contains(chain.feature)) continue;
      if (std::ranges::none_of(chain.walk, [&](VertexId v) { return degree[v] == 0; })) continue;
      for (std::size_t i = 1; i < chain.walk.size(); ++i)
        dropped_[chain.feature] += distance(chain.walk[i - 1], chain.walk[i]);
      for (const VertexId v : {chain.walk.front(), chain.walk.back()})
        if (degree[v] == 0) loose_.push_back({v, chain.feature});
    }
  }

  void note(const Lengths& lines, const std::array<const char*, 2>& texts, CleanReport& report) const {
    if (lines.empty()) return;
    const Feature& first = coastline_.features[lines.begin()->first];
    report.notes.push_back(std::to_string(lines.size()) + forCount(lines.size(), texts[0], texts[1]) +
                           featureInWords(first) + " at " + placeInWords(first.lines.front().front()));
  }

  double lengthOf(std::size_t feature) const {
    const auto within = within_.find(feature);
    return within != within_.end() ? within->second : dropped_.at(feature);
  }

  double distance(VertexId a, VertexId b, double scale) const {  // on the ground
    const Point &p = vertices_.plane[a], &q = vertices_.plane[b];
    return std::hypot(p.x - q.x, p.y - q.y) / scale;
  }
  double distance(VertexId a, VertexId b) const {
    const double sum = projection_.scaleAt(vertices_.plane[a]) + projection_.scaleAt(vertices_.plane[b]);
    return distance(a, b, 0.5 * sum);
  }

  // For each loose end that has another close by, in relation to the lengths of the lines, the nearest; each gap once.
  std::vector<Gap> findGaps() const {
    constexpr std::size_t kMost = 2000;    // more are no slips
    constexpr double kOfTheLength = 0.02;  // harbours have wider mouths in relation to their moles
    std::vector<Gap> gaps;
    if (loose_.size() > kMost) return gaps;
    std::vector<double> scales;  // of the plane
    for (const LooseEnd& end : loose_) scales.push_back(projection_.scaleAt(vertices_.plane[end.vertex]));
    for (std::size_t i = 0; i < loose_.size(); ++i) {
      std::optional<Gap> nearest;
      for (std::size_t j = 0; j < loose_.size(); ++j) {
        if (i == j) continue;
        const Gap gap{loose_[i], loose_[j],
                      distance(loose_[i].vertex, loose_[j].vertex, 0.5 * (scales[i] + scales[j]))};
        const double shorter = std::min(lengthOf(gap.a.feature), lengthOf(gap.b.feature));
        if (gap.length > kMostSnapped || gap.length > kOfTheLength * shorter) continue;
        if (!nearest || gap.length < nearest->length) nearest = gap;
      }
      if (!nearest) continue;
      const auto isSame = [&](const Gap& g) {
        return g.a.vertex == nearest->b.vertex && g.b.vertex == nearest->a.vertex;
      };
      if (std::ranges::none_of(gaps, isSame)) gaps.push_back(*nearest);
    }
    return gaps;
  }

  void warnOfGaps(CleanReport& report) const {
    const std::vector<Gap> gaps = findGaps();
    if (gaps.empty()) return;
    const double widest = std::ranges::max(gaps, {}, &Gap::length).length;
    const auto& [a, b, length] = gaps.front();
    const std::string one = featureInWords(coastline_.features[a.feature]);
    const std::string ends = placeInWords(vertices_.input[a.vertex]) + " and " +
                             placeInWords(vertices_.input[b.vertex]) + ", " + amount("%.3g", length) +
                             (projection_.isIdentity() ? "" : " m") + " apart";
    const std::string more = gaps.size() == 1 ? "" : ", and " + std::to_string(gaps.size() - 1) + " more such gaps";
    report.warnings.push_back((a.feature == b.feature ? one + ": a line almost closes, between " + ends
                                                      : one + " and " + featureInWords(coastline_.features[b.feature]) +
                                                            ": lines almost meet, at " + ends) +
                              more + ": if it is a shore, join the ends, or give --snap " +
                              amount("%.2g", std::ceil(widest * 1.1 * 1000) / 1000));
  }

  const Coastline& coastline_;
  const CleanVertices& vertices_;
  const Projection& projection_;
  Lengths within_, dropped_;
  std::vector<LooseEnd> loose_;  // ends of lines that meet neither another line nor a shore
};

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
  OpenLines(coastline, chains, labelled, projection).report(report);
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
