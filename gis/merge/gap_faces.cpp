#include "gis/merge/gap_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/geometry/chain_index.hpp"
#include "gis/geometry/crossing.hpp"

namespace coastmesh {

namespace {

// A node of the first mesh is left out if it is nearer to an edge of the outline that joins than this share of the
// edge's length. Near others are no triangles.
constexpr double kNear = 0.45;

class GapFiller {
 public:
  GapFiller(const TriMesh& mesh, std::span<const std::uint32_t> same, std::span<const Cover> cover,
            std::span<const std::vector<VertexId>> holes, std::span<const NodePair> lines, const Outline& outline,
            const ItemLoop& loop)
      : mesh_(mesh),
        same_(same),
        cover_(cover),
        lines_(lines),
        outline_(outline),
        loop_(loop),
        shift_(static_cast<std::uint32_t>(mesh.points.size())) {
    for (const std::vector<VertexId>& ring : holes) {
      std::vector<Point> places;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        hole_edges_.push_back({ring[i], ring[(i + 1) % ring.size()]});
        places.push_back(mesh.points[ring[i]]);
      }
      holes_.add(places);
    }
    holes_.build();
    std::ranges::sort(hole_edges_);
  }

  GapFaces fill() {
    for (TriId t = 0; t < mesh_.triangles.size(); ++t)
      if (cover_[t] == Cover::Met) met_.push_back(t);
    GapFaces faces;
    if (met_.empty() && hole_edges_.empty()) return faces;
    markNodes();
    gatherPoints();
    gatherEdges(faces);
    const TriMesh filled = triangulate();
    indexMet();
    std::vector<std::uint8_t> wanted(filled.triangles.size(), 0);
    forEachByStretches(loop_, wanted.size(), [&](std::size_t t) {
      if (isWanted(filled, static_cast<TriId>(t))) wanted[t] = 1;
    });
    for (TriId t = 0; t < wanted.size(); ++t) {
      if (wanted[t] == 0) continue;
      auto& corners = faces.triangles.emplace_back();
      for (unsigned i = 0; i < 3; ++i) corners[i] = nodes_[filled.triangles[t].v[i]];
    }
    return faces;
  }

 private:
  std::uint32_t numberOf(VertexId v) const { return same_[v] == kNone ? v : shift_ + same_[v]; }
  const Point& place(std::uint32_t number) const {
    return number < shift_ ? mesh_.points[number] : outline_.place(number - shift_);
  }

  void markNodes() {
    for (const Outline::Edge& edge : outline_.edges()) {
      outline_nodes_.push_back(shift_ + edge.a);
      if (edge.joins) joining_.insert(joining_.end(), {shift_ + edge.a, shift_ + edge.b});
      outline_keys_.push_back(edgeKey(shift_ + edge.a, shift_ + edge.b));
      if (!edge.joins) walls_.push_back(outline_keys_.back());
    }
    for (auto* const list : {&outline_nodes_, &joining_}) {
      std::ranges::sort(*list);
      const auto repeated = std::ranges::unique(*list);
      list->erase(repeated.begin(), repeated.end());
    }
    std::ranges::sort(outline_keys_);
    std::ranges::sort(walls_);
  }

  void gatherPoints() {
    std::vector<std::uint8_t> is_fixed(shift_, 0);
    for (TriId t = 0; t < mesh_.triangles.size(); ++t)
      if (cover_[t] == Cover::Free)
        for (const VertexId v : mesh_.triangles[t].v) is_fixed[v] = 1;
    std::vector<VertexId> candidates;
    for (const TriId t : met_)
      for (const VertexId v : mesh_.triangles[t].v)
        if (same_[v] == kNone) candidates.push_back(v);
    for (const NodePair& edge : hole_edges_)
      if (same_[edge[0]] == kNone) candidates.push_back(edge[0]);
    std::ranges::sort(candidates);
    const auto repeated = std::ranges::unique(candidates);
    candidates.erase(repeated.begin(), repeated.end());
    std::vector<std::uint8_t> taken(candidates.size(), 0);
    forEachByStretches(loop_, candidates.size(), [&](std::size_t i) {
      const Point& p = mesh_.points[candidates[i]];
      const bool is_clear = !outline_.surrounds(p) && !outline_.passes(p) &&
                            !outline_.isNear(p, kNear, [&](std::uint32_t e) { return outline_.edges()[e].joins; });
      taken[i] = is_fixed[candidates[i]] != 0 || is_clear ? 1 : 0;
    });
    for (std::size_t i = 0; i < candidates.size(); ++i)
      if (taken[i] != 0) nodes_.push_back(candidates[i]);
    nodes_.insert(nodes_.end(), outline_nodes_.begin(), outline_nodes_.end());  // their numbers are larger
  }

  bool hasPoint(std::uint32_t number) const { return std::ranges::binary_search(nodes_, number); }

  // True if the edge of the first mesh has a point in common with the outline that is not a node of both.
  bool crossesOutline(std::uint32_t from, std::uint32_t to) const {
    const Point &p = place(from), &q = place(to);
    bool crosses = false;
    outline_.visit(Box::of(p, q), [&](std::uint32_t e) {
      const std::uint32_t a = shift_ + outline_.edges()[e].a, b = shift_ + outline_.edges()[e].b;
      const bool at_from = from == a || from == b, at_to = to == a || to == b;
      if (at_from || at_to) {
        // Through a common node the outline passes along the edge, or not.
        const std::uint32_t common = at_from ? from : to, other = at_from ? to : from, end = common == a ? b : a;
        const Point middle = place(common);
        if (orient2d(middle, place(other), place(end)) == 0 && dot(place(other) - middle, place(end) - middle) > 0.0)
          crosses = true;
        return;
      }
      if (segmentsMeet(p, q, place(a), place(b))) crosses = true;
    });
    return crosses;
  }

  // Where the outline passes an edge of the first mesh's boundary, the rest of that goes on from a node of the outline
  // that joins: from `end` to `gone`, which is not there or beyond the outline. Otherwise walls just behind that shore
  // would be nearer to the water than its own nodes are.
  std::optional<std::uint32_t> nodeBeside(std::uint32_t end, std::uint32_t gone) const {
    const Point &p = place(end), &q = place(gone);
    std::vector<std::pair<double, std::uint32_t>> candidates;  // by distance from where the outline is met
    double first = std::numeric_limits<double>::infinity();
    const auto take = [&](const Outline::Edge& edge, const Point& met, double far) {
      if (far >= first) return;
      first = far;
      candidates = {{distance(met, outline_.place(edge.a)), shift_ + edge.a},
                    {distance(met, outline_.place(edge.b)), shift_ + edge.b}};
    };
    outline_.visit(Box::of(p, q), [&](std::uint32_t e) {
      const Outline::Edge& edge = outline_.edges()[e];
      const Point &from = outline_.place(edge.a), &to = outline_.place(edge.b);
      if (!segmentsMeet(p, q, from, to)) return;
      const Point met = crossingPoint(p, q, from, to);
      take(edge, met, distance(p, met));
    });
    // Else the edge ends close to the outline.
    if (candidates.empty())
      outline_.isNear(q, kNear, [&](std::uint32_t e) {
        const Outline::Edge& edge = outline_.edges()[e];
        take(edge, q, std::sqrt(squaredDistanceToSegment(q, outline_.place(edge.a), outline_.place(edge.b))));
        return false;
      });
    std::ranges::sort(candidates);
    for (const auto& [gap, node] : candidates)
      if (node != end && std::ranges::binary_search(joining_, node) && !crossesOutline(end, node)) return node;
    return std::nullopt;
  }

  void gatherEdges(GapFaces& faces) {
    std::vector<NodePair>& shore = faces.shore;
    std::vector<NodePair> keys = outline_keys_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> broken, broken_lines;
    for (const TriId t : met_) {
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(t, i), across = mesh_.twin(e);
        const bool is_shore = across == kNone, is_within = !is_shore && cover_[triOf(across)] != Cover::Free;
        if (is_within && (e > across || !isLine(e))) continue;
        const std::uint32_t from = numberOf(mesh_.origin(e)), to = numberOf(mesh_.target(e));
        const NodePair key = edgeKey(from, to);
        if (std::ranges::binary_search(outline_keys_, key)) continue;
        if ((is_shore || is_within) && (!hasPoint(from) || !hasPoint(to) || crossesOutline(from, to))) {
          auto& of_kind = is_shore ? broken : broken_lines;
          if (hasPoint(from)) of_kind.emplace_back(from, to);
          if (hasPoint(to)) of_kind.emplace_back(to, from);
          continue;
        }
        if (is_shore) shore.push_back(key);
        keys.push_back(key);
      }
    }
    for (TriId t = 0; t < mesh_.triangles.size() && !hole_edges_.empty(); ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(t, i);
        if (cover_[t] != Cover::Free || mesh_.twin(e) != kNone || !isOfHole(e)) continue;
        const NodePair key = edgeKey(numberOf(mesh_.origin(e)), numberOf(mesh_.target(e)));
        if (!std::ranges::binary_search(outline_keys_, key)) keys.push_back(key);
      }
    }
    for (const auto& [end, gone, node] : continued(broken, keys)) shore.push_back(edgeKey(end, node));
    faces.line_ends = continued(broken_lines, keys);
    std::ranges::sort(faces.line_ends);
    std::ranges::sort(shore);
    std::ranges::sort(keys);
    const auto repeated = std::ranges::unique(keys);
    keys.erase(repeated.begin(), repeated.end());
    edges_ = std::move(keys);
  }

  // Continues edges, from an end to what is gone, to nodes of the outline if nothing is in the way.
  std::vector<LineEnd> continued(std::span<const std::pair<std::uint32_t, std::uint32_t>> broken,
                                 std::vector<NodePair>& keys) const {
    std::vector<LineEnd> ends;
    for (const auto& [end, gone] : broken)
      if (const auto node = nodeBeside(end, gone)) ends.push_back({end, gone, *node});
    const std::size_t before = keys.size();
    for (const LineEnd& end : ends) keys.push_back(edgeKey(end.from, end.node));
    std::vector<Box> boxes;
    for (const NodePair& key : keys) boxes.push_back(Box::of(place(key[0]), place(key[1])));
    const BoxTree tree(boxes, BoxTree::Order::Hilbert, loop_);
    const auto cross = [&](const NodePair& key, const NodePair& other) {
      const bool adjoin =
          std::ranges::any_of(key, [&](std::uint32_t node) { return node == other[0] || node == other[1]; });
      return !adjoin && segmentsMeet(place(key[0]), place(key[1]), place(other[0]), place(other[1]));
    };
    std::vector<std::uint8_t> stays(keys.size(), 0);  // of two new ones that cross, the first
    std::fill_n(stays.begin(), before, std::uint8_t{1});
    for (std::size_t k = before; k < keys.size(); ++k) {
      bool crosses = false;
      tree.visit(boxes[k], [&](std::uint32_t i) { crosses = crosses || (stays[i] != 0 && cross(keys[k], keys[i])); });
      stays[k] = crosses ? 0 : 1;
    }
    std::vector<LineEnd> kept;
    for (std::size_t k = before; k < stays.size(); ++k)
      if (stays[k] != 0) kept.push_back(ends[k - before]);
    keys.resize(before);
    for (const LineEnd& end : kept) keys.push_back(edgeKey(end.from, end.node));
    return kept;
  }

  TriMesh triangulate() const {
    Pslg pslg;
    Box box;
    for (const std::uint32_t number : nodes_) {
      pslg.points.push_back(place(number));
      box.add(pslg.points.back());
    }
    const auto vertexOf = [&](std::uint32_t number) {
      return static_cast<VertexId>(std::ranges::lower_bound(nodes_, number) - nodes_.begin());
    };
    for (const NodePair& edge : edges_) pslg.segments.push_back({vertexOf(edge[0]), vertexOf(edge[1])});
    // A frame, so that all places are enclosed.
    box = box.grownBy(std::max({box.xmax - box.xmin, box.ymax - box.ymin}));
    const auto first = static_cast<VertexId>(pslg.points.size());
    for (const Point& corner :
         {Point{box.xmin, box.ymin}, Point{box.xmax, box.ymin}, Point{box.xmax, box.ymax}, Point{box.xmin, box.ymax}})
      pslg.points.push_back(corner);
    for (VertexId i = 0; i < 4; ++i) pslg.segments.push_back({first + i, first + (i + 1) % 4});
    return constrainedDelaunay(pslg, {}, loop_);
  }

  bool isLine(EdgeRef e) const { return std::ranges::binary_search(lines_, edgeKey(mesh_.origin(e), mesh_.target(e))); }

  bool isOfHole(EdgeRef e) const {
    return std::ranges::binary_search(hole_edges_, NodePair{mesh_.origin(e), mesh_.target(e)});
  }

  void indexMet() {
    std::vector<Box> boxes;
    for (const TriId t : met_) {
      Box& box = boxes.emplace_back();
      for (const VertexId v : mesh_.triangles[t].v) box.add(mesh_.points[v]);
    }
    met_tree_ = BoxTree(boxes, BoxTree::Order::Hilbert, loop_);
  }

  bool isWater(const Point& p) const {
    bool found = holes_.locate(p) == Location::Inside;
    met_tree_.visit(Box::of(p, p), [&](std::uint32_t i) {
      const auto& v = mesh_.triangles[met_[i]].v;
      const Point &a = mesh_.points[v[0]], &b = mesh_.points[v[1]], &c = mesh_.points[v[2]];
      found = found || (orient2d(a, b, p) >= 0 && orient2d(b, c, p) >= 0 && orient2d(c, a, p) >= 0);
    });
    return found;
  }

  bool isWanted(const TriMesh& filled, TriId t) const {
    const auto& v = filled.triangles[t].v;
    if (std::ranges::any_of(v, [&](VertexId corner) { return corner >= nodes_.size(); })) return false;
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t node = nodes_[v[i]];
      if (node >= shift_ && !std::ranges::binary_search(joining_, node)) return false;
      if (std::ranges::binary_search(walls_, edgeKey(node, nodes_[v[next3(i)]]))) return false;
    }
    const Point middle = centroid(filled.points[v[0]], filled.points[v[1]], filled.points[v[2]]);
    return !outline_.surrounds(middle) && isWater(middle);
  }

  const TriMesh& mesh_;
  std::span<const std::uint32_t> same_;
  std::span<const Cover> cover_;
  std::span<const NodePair> lines_;
  const Outline& outline_;
  const ItemLoop& loop_;
  std::uint32_t shift_;
  std::vector<TriId> met_;
  std::vector<std::uint32_t> outline_nodes_, joining_;  // numbers, sorted; with an edge that joins
  std::vector<NodePair> outline_keys_, walls_;          // sorted; walls do not join
  std::vector<std::uint32_t> nodes_;                    // the number of each point, ascending
  std::vector<NodePair> edges_;
  std::vector<NodePair> hole_edges_;  // in their direction, sorted
  ChainIndex holes_{ChainIndex::Kind::Rings};
  BoxTree met_tree_;
};

}  // namespace

GapFaces fillGap(const TriMesh& mesh, std::span<const std::uint32_t> same, std::span<const Cover> cover,
                 std::span<const std::vector<VertexId>> holes, std::span<const NodePair> lines, const Outline& outline,
                 const ItemLoop& loop) {
  return GapFiller(mesh, same, cover, holes, lines, outline, loop).fill();
}

}  // namespace coastmesh
