#include "gis/clean_faces.hpp"

#include <algorithm>
#include <iterator>

#include "gis/planar_map.hpp"

namespace coastmesh {

namespace {

// Features that a face lies in, ascending.
using FeatureSet = std::vector<std::uint32_t>;

// An edge, its uses [first_use, last_use), and whether an open line runs along it.
struct MapEdge {
  std::size_t first_use, last_use;
  bool line;
};

class Labeller {
 public:
  Labeller(const CleanChains& chains, const NodedEdges& noded, const Coastline& coastline, CleanReport& report)
      : chains_(chains),
        noded_(noded),
        coastline_(coastline),
        report_(report),
        ends_(listEdges()),
        map_(chains.vertices.plane, ends_) {}

  std::vector<Segment> run() {
    fillFaces();
    tellOverlaps();
    tellMisplacedRings();
    std::vector<Segment> segments = keepEdges();
    tellPinches(segments);
    return segments;
  }

 private:
  std::vector<std::pair<VertexId, VertexId>> listEdges() {
    std::vector<std::pair<VertexId, VertexId>> ends;
    const auto& uses = noded_.uses;
    for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
      MapEdge edge{first, first, false};
      for (; last < uses.size() && uses[last].low() == uses[first].low() && uses[last].high() == uses[first].high();
           ++last) {
        if (roleOf(uses[last]) == CleanChain::Role::Line) edge.line = true;
      }
      edge.last_use = last;
      edges_.push_back(edge);
      ends.emplace_back(uses[first].low(), uses[first].high());
    }
    return ends;
  }

  CleanChain::Role roleOf(const EdgeUse& use) const { return chains_.chains[use.chain].role; }
  std::uint32_t featureOf(const EdgeUse& use) const { return chains_.chains[use.chain].feature; }
  std::int64_t fidOf(std::uint32_t feature) const { return coastline_.features[feature].fid; }
  const Point& inputOf(VertexId v) const { return chains_.vertices.input[v]; }

  // Features whose rings run along the edge: crossing it leads into them or out of them.
  FeatureSet parted(const MapEdge& edge) const {
    FeatureSet features;
    for (std::size_t u = edge.first_use; u < edge.last_use; ++u) {
      if (roleOf(noded_.uses[u]) != CleanChain::Role::Line) features.push_back(featureOf(noded_.uses[u]));
    }
    return features;
  }

  // From the unbounded face inwards.
  void fillFaces() {
    holders_.resize(map_.faceCount());
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

  RegionId label(std::uint32_t face) const {
    return holders_[face].empty() ? kOutside : static_cast<RegionId>(holders_[face].front());
  }

  bool holds(std::uint32_t face, std::uint32_t feature) const {
    return std::binary_search(holders_[face].begin(), holders_[face].end(), feature);
  }

  std::vector<Segment> keepEdges() const {
    std::vector<Segment> segments;
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      const RegionId left = label(map_.faceOf(2 * e)), right = label(map_.faceOf(2 * e + 1));
      if (left == right && (left == kOutside || !edges_[e].line)) continue;
      segments.push_back({ends_[e].first, ends_[e].second, 0, left, right});
    }
    return segments;
  }

  void tellOverlaps() {
    for (std::uint32_t face = 0; face < holders_.size(); ++face) {
      for (std::size_t i = 1; i < holders_[face].size(); ++i) {
        const PlanarMap::HalfEdge h = map_.around(face).front();
        report_.add(EditKind::FeaturesOverlap, inputOf(ends_[h / 2].first), fidOf(holders_[face][i]));
      }
    }
  }

  // A ring is judged by the first of its edges that is left. Those that cross something have no side to judge by.
  void tellMisplacedRings() {
    std::vector<char> done = noded_.crossed;
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      for (std::size_t u = edges_[e].first_use; u < edges_[e].last_use; ++u) {
        const EdgeUse& use = noded_.uses[u];
        if (roleOf(use) == CleanChain::Role::Line || done[use.chain]) continue;
        done[use.chain] = 1;
        const bool upward = use.a == ends_[e].first;
        const bool inner_is_left = windsLeft(chains_.chains[use.chain].walk);
        const std::uint32_t inner = map_.faceOf(upward == inner_is_left ? 2 * e : 2 * e + 1);
        const bool filled = holds(inner, featureOf(use));
        if (filled == (roleOf(use) == CleanChain::Role::Outer)) continue;
        report_.add(EditKind::MisplacedRing, inputOf(use.a), fidOf(featureOf(use)));
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

  // A vertex of the input with outside in two or more of its sectors.
  void tellPinches(const std::vector<Segment>& segments) {
    std::vector<std::uint32_t> outside_sectors(chains_.vertices.plane.size(), 0);
    for (const Segment& s : segments) {  // each sector of outside begins, counter-clockwise, with one edge
      if (s.left == kOutside) ++outside_sectors[s.a];
      if (s.right == kOutside) ++outside_sectors[s.b];
    }
    for (const Segment& s : segments) {
      for (const VertexId v : {s.a, s.b}) {
        if (outside_sectors[v] < 2 || chains_.vertices.is_new[v]) continue;
        outside_sectors[v] = 0;
        report_.add(EditKind::TouchingRing, inputOf(v), fidOf(static_cast<std::uint32_t>(std::max(s.left, s.right))));
      }
    }
  }

  const CleanChains& chains_;
  const NodedEdges& noded_;
  const Coastline& coastline_;
  CleanReport& report_;
  std::vector<MapEdge> edges_;
  std::vector<std::pair<VertexId, VertexId>> ends_;
  PlanarMap map_;
  std::vector<FeatureSet> holders_;
};

}  // namespace

std::vector<Segment> labelFaces(const CleanChains& chains, const NodedEdges& edges, const Coastline& coastline,
                                CleanReport& report) {
  return Labeller(chains, edges, coastline, report).run();
}

}  // namespace coastmesh
