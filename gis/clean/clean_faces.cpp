#include "gis/clean/clean_faces.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "core/union_find.hpp"
#include "gis/clean/coast_sides.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/coast/flood_plains.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/geometry/face_locator.hpp"
#include "gis/geometry/planar_map.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

// The features that contain a face, ascending.
using FeatureSet = std::vector<std::uint32_t>;

// An edge and its uses [first_use, last_use).
struct MapEdge {
  std::uint32_t first_use, last_use;
};

// Precedence among features with lines along one edge: the lowest rank, then the first feature.
int rankOf(FeatureUse use) {
  if (use == FeatureUse::Weir) return 0;
  return use == FeatureUse::Region ? 2 : 1;
}

class Labeller {
 public:
  Labeller(const CleanChains& chains, const NodedEdges& noded, const Coastline& coastline, const Projection& projection,
           bool dissolve, CleanReport& report, const ItemLoop& loop)
      : chains_(chains),
        noded_(noded),
        coastline_(coastline),
        projection_(projection),
        dissolve_(dissolve),
        report_(report),
        rest_(coastline.rest ? static_cast<RegionId>(*coastline.rest) : kOutside),
        ends_(listEdges()),
        map_(chains.vertices.plane, ends_, loop) {
    for (const CleanChain& chain : chains.chains) {
      const FeatureUse use = useOf(chain.feature);
      if (use == FeatureUse::Coast) first_coast_ = std::min(first_coast_, chain.feature);
      if (use != FeatureUse::Area) continue;
      std::uint32_t& first = isPlain(chain.feature) ? first_plain_ : first_area_;
      first = std::min(first, chain.feature);
    }
  }

  LabelledEdges run() {
    fillFaces();
    if (chains_.coast) findWaterFaces();
    labelAll();
    if (!dissolve_) reportOverlaps();
    reportMisplacedRings();
    LabelledEdges result;
    if (dissolve_) result.traces = dissolve();
    result.beyond = label(PlanarMap::kOuterFace);
    result.segments = keepEdges(result.lines);
    result.points = keepPoints(result.segments);
    for (const CleanChain& chain : chains_.chains)
      if (chain.role == CleanChain::Role::Point) result.asked.push_back(chain.walk.front());
    return result;
  }

 private:
  std::vector<std::pair<VertexId, VertexId>> listEdges() {
    std::vector<std::pair<VertexId, VertexId>> ends;
    const auto& uses = noded_.uses;
    edges_.reserve(uses.size());
    ends.reserve(uses.size());
    for (std::uint32_t first = 0, last = 0; first < uses.size(); first = last) {
      while (last < uses.size() && uses[last].low() == uses[first].low() && uses[last].high() == uses[first].high())
        ++last;
      edges_.push_back({first, last});
      ends.emplace_back(uses[first].low(), uses[first].high());
    }
    return ends;
  }

  CleanChain::Role roleOf(const EdgeUse& use) const { return chains_.chains[use.chain].role; }
  bool isLine(const EdgeUse& use) const { return roleOf(use) == CleanChain::Role::Line; }
  FeatureUse useOf(std::uint32_t feature) const { return coastline_.features[feature].use; }
  bool isPlain(std::uint32_t feature) const { return isFloodPlain(coastline_.features[feature]); }
  std::uint32_t featureOf(const EdgeUse& use) const { return chains_.chains[use.chain].feature; }
  const Point& inputOf(VertexId v) const { return chains_.vertices.input[v]; }

  // Features whose rings run along the edge: crossing it enters or leaves them.
  FeatureSet parted(const MapEdge& edge) const {
    FeatureSet features;
    for (std::size_t u = edge.first_use; u < edge.last_use; ++u) {
      if (!isLine(noded_.uses[u])) features.push_back(featureOf(noded_.uses[u]));
    }
    return features;
  }

  // Finds the features that contain each face, from the unbounded face inwards.
  void fillFaces() {
    holders_.resize(map_.faceCount());
    holders_[PlanarMap::kOuterFace] = chains_.beyond;
    std::vector<char> reached(map_.faceCount(), 0);
    std::vector<std::uint32_t> queue{PlanarMap::kOuterFace};
    reached[PlanarMap::kOuterFace] = 1;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const PlanarMap::HalfEdge h : map_.around(queue[i])) {
        const std::uint32_t beyond = map_.faceOf(h ^ 1u);
        if (reached[beyond]) continue;
        reached[beyond] = 1;
        const FeatureSet parted_here = parted(edges_[h / 2]);
        std::set_symmetric_difference(holders_[queue[i]].begin(), holders_[queue[i]].end(), parted_here.begin(),
                                      parted_here.end(), std::back_inserter(holders_[beyond]));
        queue.push_back(beyond);
      }
    }
  }

  // The first feature of a use that contains the face, else kOutside.
  RegionId holderOf(std::uint32_t face, FeatureUse use) const {
    for (const std::uint32_t feature : holders_[face]) {
      if (useOf(feature) == use) return static_cast<RegionId>(feature);
    }
    return kOutside;
  }

  RegionId label(std::uint32_t face) const { return labels_[face]; }

  void labelAll() {
    labels_.resize(map_.faceCount());
    plain_.assign(map_.faceCount(), 0);
    for (std::uint32_t face = 0; face < labels_.size(); ++face) {
      const RegionId frame = chains_.framed ? holderOf(face, FeatureUse::Frame) : kOutside;
      labels_[face] = chains_.framed && frame == kOutside ? kOutside : findLabel(face, frame);
      const bool is_free = labels_[face] == kOutside && (!chains_.framed || frame != kOutside);
      if (!is_free || !std::ranges::any_of(holders_[face], [this](std::uint32_t f) { return isPlain(f); })) continue;
      labels_[face] = labelOfPlain(frame);
      plain_[face] = 1;
    }
  }

  // That of the water around, so that only a line separates them.
  RegionId labelOfPlain(RegionId frame) const {
    if (frame != kOutside && (chains_.coast || chains_.land)) return frame;
    if (chains_.coast) return static_cast<RegionId>(first_coast_);
    return one_.empty() ? static_cast<RegionId>(first_area_) : one_.at(first_area_);
  }

  // Without flood plains.
  RegionId findLabel(std::uint32_t face, RegionId frame) const {
    if (chains_.coast) {
      if (!water_[face]) return kOutside;
      if (chains_.framed) return frame;
      const RegionId holder = holderOf(face, FeatureUse::Coast);
      return holder == kOutside ? static_cast<RegionId>(first_coast_) : holder;
    }
    if (chains_.land) return holderOf(face, FeatureUse::Land) == kOutside ? frame : kOutside;
    const RegionId area = holderOf(face, FeatureUse::Area);
    if (area == kOutside) return rest_;
    if (isPlain(static_cast<std::uint32_t>(area))) return kOutside;  // the last of all features
    return one_.empty() ? area : one_.at(static_cast<std::uint32_t>(area));
  }

  // Unites features that share an edge. Returns the vertices of those edges, ascending.
  std::vector<VertexId> dissolve() {
    std::vector<VertexId> traces;
    if (chains_.land || chains_.coast) return traces;
    std::vector<std::uint32_t> features;
    for (const CleanChain& chain : chains_.chains) features.push_back(chain.feature);
    for (const FeatureSet& holders : holders_) features.insert(features.end(), holders.begin(), holders.end());
    std::ranges::sort(features);
    features.erase(std::unique(features.begin(), features.end()), features.end());
    const auto numberOf = [&](RegionId feature) {
      return static_cast<std::uint32_t>(std::ranges::lower_bound(features, static_cast<std::uint32_t>(feature)) -
                                        features.begin());
    };
    UnionFind sets(features.size());
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      const RegionId left = label(map_.faceOf(2 * e)), right = label(map_.faceOf(2 * e + 1));
      if (left == right || left == rest_ || right == rest_) continue;
      sets.unite(numberOf(left), numberOf(right));
      report_.add(EditKind::DissolvedEdge, inputOf(ends_[e].first), coastline_,
                  static_cast<std::size_t>(std::max(left, right)));
      traces.insert(traces.end(), {ends_[e].first, ends_[e].second});
    }
    for (std::uint32_t i = 0; i < features.size(); ++i) {
      one_[features[i]] = static_cast<RegionId>(features[sets.find(i)]);
    }
    labelAll();
    std::ranges::sort(traces);
    traces.erase(std::unique(traces.begin(), traces.end()), traces.end());
    return traces;
  }

  void findWaterFaces() {
    CoastMap coast{map_, std::vector<CoastEdge>(edges_.size()), std::vector<char>(map_.faceCount(), 0), {}};
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      CoastEdge& edge = coast.edges[e];
      std::tie(edge.low, edge.high) = ends_[e];
      int rings = 0;
      for (std::size_t u = edges_[e].first_use; u < edges_[e].last_use; ++u) {
        const EdgeUse& use = noded_.uses[u];
        edge.of_frame = edge.of_frame || useOf(featureOf(use)) == FeatureUse::Frame;
        if (useOf(featureOf(use)) != FeatureUse::Coast) continue;
        edge.feature = featureOf(use);
        edge.line = edge.line || isLine(use);
        if (!isLine(use)) ++rings;
        edge.direction += use.a == edge.low ? 1 : -1;
      }
      edge.parts = edge.line || rings % 2 == 1;
    }
    for (std::uint32_t face = 0; face < map_.faceCount(); ++face) {
      coast.framed[face] =
          chains_.framed ? holderOf(face, FeatureUse::Frame) != kOutside : face != PlanarMap::kOuterFace;
    }
    if (coastline_.water_at) {
      const Point place = projection_.forward(*coastline_.water_at);
      coast.seed = FaceLocator(map_, chains_.vertices.plane, ends_).faceAt(place);
      if (!coast.framed[*coast.seed]) {
        throw NothingWanted("--water-at " + std::to_string(coastline_.water_at->x) + "," +
                            std::to_string(coastline_.water_at->y) + ": lies outside of all that the coasts enclose" +
                            (chains_.framed ? ", and of the frame" : ": close the water with --bbox or --clip"));
      }
    }
    water_ = findWater(coast, chains_.vertices, coastline_, projection_, report_);
  }

  bool holds(std::uint32_t face, std::uint32_t feature) const {
    return std::binary_search(holders_[face].begin(), holders_[face].end(), feature);
  }

  std::vector<Segment> keepEdges(std::vector<DomainLine>& lines) const {
    std::vector<Segment> segments;
    std::vector<std::pair<std::size_t, LineKey>> on_lines;  // by segment
    segments.reserve(edges_.size());
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      const RegionId left = label(map_.faceOf(2 * e)), right = label(map_.faceOf(2 * e + 1));
      std::optional<LineKey> line = left == kOutside || right == kOutside ? std::nullopt : lineAlong(edges_[e]);
      const bool is_coast =
          left != kOutside && right != kOutside && plain_[map_.faceOf(2 * e)] != plain_[map_.faceOf(2 * e + 1)];
      if (is_coast && !line) line = LineKey(first_plain_, false);
      if (left == right && !line) continue;
      if (line) on_lines.emplace_back(segments.size(), *line);
      if (line) noteLines(edges_[e]);
      segments.push_back({ends_[e].first, ends_[e].second, opens(edges_[e], left, right) ? kOpenTag : 0, left, right});
    }
    std::map<LineKey, std::size_t> number_of;  // lines in the order of their features
    for (const auto& [segment, key] : on_lines) number_of.try_emplace(key, 0);
    for (auto& [key, number] : number_of) {
      number = lines.size();
      const Feature& feature = coastline_.features[key.first];
      if (isFloodPlain(feature)) {
        lines.push_back({key.first, FeatureUse::Area, std::string(kFloodedCoast)});
        continue;
      }
      const FeatureUse use = rankOf(feature.use) == 1 ? FeatureUse::Constraint : feature.use;
      lines.push_back({key.first, use, std::string(lineNameOf(feature)), key.second});
    }
    for (const auto& [segment, key] : on_lines) segments[segment].tag = lineTag(number_of.at(key));
    std::ranges::sort(report_.took_part);
    report_.took_part.erase(std::unique(report_.took_part.begin(), report_.took_part.end()), report_.took_part.end());
    return segments;
  }

  // Records all features with a line or border along an edge within the domain.
  void noteLines(const MapEdge& edge) const {
    for (std::size_t u = edge.first_use; u < edge.last_use; ++u) {
      const std::uint32_t feature = featureOf(noded_.uses[u]);
      if (report_.took_part.empty() || report_.took_part.back() != feature) report_.took_part.push_back(feature);
    }
  }

  // A feature, and whether a region has its border along the edge.
  using LineKey = std::pair<std::uint32_t, bool>;

  // The line along an edge within the domain; nullopt if there is none.
  std::optional<LineKey> lineAlong(const MapEdge& edge) const {
    std::uint32_t first = kNone;
    bool of_region = false;
    for (std::size_t u = edge.first_use; u < edge.last_use; ++u) {
      const std::uint32_t feature = featureOf(noded_.uses[u]);
      const FeatureUse use = useOf(feature);
      if (isLine(noded_.uses[u]) ? use == FeatureUse::Open : use != FeatureUse::Region) continue;
      of_region = of_region || use == FeatureUse::Region;
      if (first == kNone || std::pair(rankOf(use), feature) < std::pair(rankOf(useOf(first)), first)) first = feature;
    }
    return first == kNone ? std::nullopt : std::optional(LineKey(first, of_region));
  }

  // True if an edge of the boundary is open: on the frame, or on a line of use Open.
  bool opens(const MapEdge& edge, RegionId left, RegionId right) const {
    if (left != kOutside && right != kOutside) return false;
    for (std::size_t u = edge.first_use; u < edge.last_use; ++u) {
      const FeatureUse use = useOf(featureOf(noded_.uses[u]));
      if (use == FeatureUse::Frame || use == FeatureUse::Open) return true;
    }
    return false;
  }

  // Requested vertices that lie in water and on no segment; those outside are reported.
  std::vector<VertexId> keepPoints(const std::vector<Segment>& segments) const {
    std::vector<VertexId> points;
    const bool any = std::ranges::any_of(chains_.chains,
                                         [](const CleanChain& chain) { return chain.role == CleanChain::Role::Point; });
    if (!any) return points;
    std::vector<char> used(chains_.vertices.plane.size(), 0);
    for (const Segment& s : segments) used[s.a] = used[s.b] = 1;
    const FaceLocator locator(map_, chains_.vertices.plane, ends_);
    for (const CleanChain& chain : chains_.chains) {
      if (chain.role != CleanChain::Role::Point) continue;
      const VertexId v = chain.walk.front();
      if (used[v]) continue;
      const auto star = map_.leaving(v);
      const std::uint32_t face = star.empty() ? locator.faceAt(chains_.vertices.plane[v]) : map_.faceOf(star.front());
      if (label(face) == kOutside) {
        report_.add(EditKind::OutsideWater, inputOf(v), coastline_, chain.feature);
        continue;
      }
      used[v] = 1;
      points.push_back(v);
    }
    std::ranges::sort(points);
    return points;
  }

  void reportOverlaps() {
    if (chains_.coast || chains_.land) return;
    for (std::uint32_t face = 0; face < holders_.size(); ++face) {
      bool first = true;
      for (const std::uint32_t feature : holders_[face]) {
        if (useOf(feature) != FeatureUse::Area || isPlain(feature) || std::exchange(first, false)) continue;
        report_.add(EditKind::FeaturesOverlap, placeIn(face), coastline_, feature);
      }
    }
    warnOfNested();
  }

  const Point& placeIn(std::uint32_t face) const { return inputOf(ends_[map_.around(face).front() / 2].first); }

  // Warns of polygons inside others: most are islands, drawn as separate features instead of holes.
  void warnOfNested() {
    struct Shared {
      std::uint32_t other, face;
    };
    std::map<std::uint32_t, Shared> shared;  // by feature that overlaps another somewhere
    std::vector<std::uint32_t> alone;        // features that have a face to themselves
    for (std::uint32_t face = 0; face < holders_.size(); ++face) {
      FeatureSet areas;
      std::ranges::copy_if(holders_[face], std::back_inserter(areas),
                           [this](std::uint32_t f) { return useOf(f) == FeatureUse::Area && !isPlain(f); });
      if (areas.size() == 1) alone.push_back(areas.front());
      for (std::size_t i = 0; i < areas.size() && areas.size() > 1; ++i)
        shared.try_emplace(areas[i], Shared{areas[i == 0 ? 1 : 0], face});
    }
    if (shared.empty()) return;
    std::ranges::sort(alone);
    std::erase_if(shared, [&](const auto& each) { return std::ranges::binary_search(alone, each.first); });
    // Of two identical features, the second is reported.
    std::erase_if(shared, [&](const auto& each) {
      const auto other = shared.find(each.second.other);
      return other != shared.end() && each.first < other->first && other->second.other == each.first;
    });
    if (shared.empty()) return;
    const auto& [feature, first] = *shared.begin();
    const std::string more = shared.size() > 1 ? ", and so do " + std::to_string(shared.size() - 1) + " more" : "";
    const auto inWords = [this](std::uint32_t f) { return featureInWords(coastline_.features[f]); };
    report_.warnings.push_back(inWords(feature) + " lies in " + inWords(first.other) + " at " +
                               placeInWords(placeIn(first.face)) + more +
                               ": both are meshed, as parts of the latter; an island has to be a hole of the polygon "
                               "round it, which Difference makes in QGIS");
  }

  // Checks each ring at its first remaining edge. Rings that cross something are skipped: their inside is ambiguous.
  void reportMisplacedRings() {
    std::vector<char> done = noded_.crossed;
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      for (std::size_t u = edges_[e].first_use; u < edges_[e].last_use; ++u) {
        const EdgeUse& use = noded_.uses[u];
        if (isLine(use) || done[use.chain]) continue;
        if (useOf(featureOf(use)) != FeatureUse::Area || coastline_.features[featureOf(use)].clipped) continue;
        done[use.chain] = 1;
        const bool upward = use.a == ends_[e].first;
        const bool inner_is_left = windsLeft(chains_.chains[use.chain].walk);
        const std::uint32_t inner = map_.faceOf(upward == inner_is_left ? 2 * e : 2 * e + 1);
        const bool filled = holds(inner, featureOf(use));
        if (filled == (roleOf(use) == CleanChain::Role::Outer)) continue;
        report_.add(EditKind::MisplacedRing, inputOf(use.a), coastline_, featureOf(use));
      }
    }
  }

  bool windsLeft(const std::vector<VertexId>& walk) const {
    const auto& plane = chains_.vertices.plane;
    double twice = 0;
    for (std::size_t i = 1; i + 1 < walk.size(); ++i) {
      const Point &o = plane[walk[0]], &a = plane[walk[i]], &b = plane[walk[i + 1]];
      twice += (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
    }
    return twice > 0;
  }

  const CleanChains& chains_;
  const NodedEdges& noded_;
  const Coastline& coastline_;
  const Projection& projection_;
  bool dissolve_;
  CleanReport& report_;
  std::uint32_t first_coast_ = kNone, first_area_ = kNone, first_plain_ = kNone;
  std::vector<MapEdge> edges_;
  RegionId rest_;  // label outside all features of a whole globe, else kOutside
  std::vector<std::pair<VertexId, VertexId>> ends_;
  PlanarMap map_;
  std::vector<FeatureSet> holders_;
  std::map<std::uint32_t, RegionId> one_;  // by feature: the first that it is united with; empty unless dissolved
  std::vector<char> water_;                // by face; empty without coasts
  std::vector<RegionId> labels_;           // by face
  std::vector<char> plain_;                // by face: land of a flood plain
};

}  // namespace

LabelledEdges labelFaces(const CleanChains& chains, const NodedEdges& edges, const Coastline& coastline,
                         const Projection& projection, bool dissolve, CleanReport& report, const ItemLoop& loop) {
  return Labeller(chains, edges, coastline, projection, dissolve, report, loop).run();
}

}  // namespace coastmesh
