#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gis/clean/clean_faces.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/coast/flood_plains.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/coast/snap_distance.hpp"
#include "gis/for_count.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

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
      within_.try_emplace(feature, OpenLine{s.a}).first->second.length += distance(s.a, s.b);
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

  // What a feature has of open lines: a vertex of them, and their length on the ground.
  struct OpenLine {
    VertexId vertex;
    double length = 0.0;
  };
  using LinesOfFeatures = std::map<std::size_t, OpenLine>;

  bool isToMesh(std::size_t feature) const {
    return coastline_.features[feature].use == FeatureUse::Area && !isFloodPlain(coastline_.features[feature]);
  }

  // Lines along a shore are none of these.
  void findDropped(const CleanChains& chains, const std::vector<std::uint32_t>& degree) {
    for (const CleanChain& chain : chains.chains) {
      if (chain.role != CleanChain::Role::Line || !isToMesh(chain.feature) || within_.contains(chain.feature)) continue;
      if (std::ranges::none_of(chain.walk, [&](VertexId v) { return degree[v] == 0; })) continue;
      OpenLine& dropped = dropped_.try_emplace(chain.feature, OpenLine{chain.walk.front()}).first->second;
      for (std::size_t i = 1; i < chain.walk.size(); ++i) dropped.length += distance(chain.walk[i - 1], chain.walk[i]);
      for (const VertexId v : {chain.walk.front(), chain.walk.back()})
        if (degree[v] == 0) loose_.push_back({v, chain.feature});
    }
  }

  void note(const LinesOfFeatures& lines, const std::array<const char*, 2>& texts, CleanReport& report) const {
    if (lines.empty()) return;
    const auto& [feature, line] = *lines.begin();
    report.notes.push_back(std::to_string(lines.size()) + forCount(lines.size(), texts[0], texts[1]) +
                           featureInWords(coastline_.features[feature]) + " at " +
                           placeInWords(vertices_.input[line.vertex]));
  }

  double lengthOf(std::size_t feature) const {
    const auto within = within_.find(feature);
    return within != within_.end() ? within->second.length : dropped_.at(feature).length;
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
    report.warnings.push_back(
        (a.feature == b.feature
             ? one + ": a line almost closes, between " + ends
             : one + " and " + featureInWords(coastline_.features[b.feature]) + ": lines almost meet, at " + ends) +
        more + ": if it is a shore, join the ends, or give --snap " + roundAmount(1.1 * widest, 2));
  }

  const Coastline& coastline_;
  const CleanVertices& vertices_;
  const Projection& projection_;
  LinesOfFeatures within_, dropped_;
  std::vector<LooseEnd> loose_;  // ends of lines that meet neither another line nor a shore
};

}  // namespace

void reportOpenLines(const Coastline& coastline, const CleanChains& chains, const LabelledEdges& labelled,
                     const Projection& projection, CleanReport& report) {
  const auto isLine = [](const CleanChain& chain) { return chain.role == CleanChain::Role::Line; };
  if (std::ranges::any_of(chains.chains, isLine)) OpenLines(coastline, chains, labelled, projection).report(report);
}

}  // namespace coastmesh
