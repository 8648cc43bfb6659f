#include "gis/merge/covered_triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "gis/geometry/chain_index.hpp"
#include "gis/grid/boundary_chains.hpp"

namespace coastmesh {

namespace {

// Nearer than this share of the shorter edge, a triangle between an outline and a triangle would be a sliver. Less is
// enough where both share a node: there the meshes may continue one another.
constexpr double kNear = 0.45, kNearAtNode = 0.25;

struct Corners {
  std::array<Point, 3> at;
  std::array<std::uint32_t, 3> same;
  double shortest = 0.0;  // squared
};

bool holds(const Corners& t, const Point& p) {
  return orient2d(t.at[0], t.at[1], p) >= 0 && orient2d(t.at[1], t.at[2], p) >= 0 && orient2d(t.at[2], t.at[0], p) >= 0;
}

bool isAhead(const Point& from, const Point& a, const Point& b) { return dot(a - from, b - from) > 0.0; }

// True if the edge from corner `i` to `q` enters the triangle or runs along one of its sides.
bool entersAt(const Corners& t, unsigned i, const Point& q) {
  const Point &p = t.at[i], &right = t.at[next3(i)], &left = t.at[prev3(i)];
  const int of_right = orient2d(p, right, q), of_left = orient2d(p, left, q);
  if (of_right > 0 && of_left < 0) return true;
  return (of_right == 0 && isAhead(p, right, q)) || (of_left == 0 && isAhead(p, left, q));
}

class Tester {
 public:
  Tester(const TriMesh& mesh, std::span<const std::uint32_t> same, const Outline& outline)
      : mesh_(mesh), same_(same), outline_(outline), is_shore_(mesh.points.size(), 0) {
    for (TriId t = 0; t < mesh.triangles.size(); ++t)
      for (unsigned i = 0; i < 3; ++i)
        if (const EdgeRef e = edgeRef(t, i); mesh.twin(e) == kNone)
          is_shore_[mesh.origin(e)] = is_shore_[mesh.target(e)] = 1;
    std::vector<std::uint32_t> shared;
    for (const std::uint32_t node : same)
      if (node != kNone) shared.push_back(node);
    std::ranges::sort(shared);
    const auto isShared = [&](std::uint32_t node) { return std::ranges::binary_search(shared, node); };
    const std::vector<NodePair> of_mesh = edgesBetweenShared();
    for (const Outline::Edge& edge : outline.edges()) {
      stays_.push_back(edge.joins && !isShared(edge.a) && !isShared(edge.b) ? 1 : 0);
      fits_.push_back(std::ranges::binary_search(of_mesh, edgeKey(edge.a, edge.b)) ? 1 : 0);
    }
    addFittingShores();
  }

  bool isMet(TriId t) const {
    Corners corners;
    Box box;
    for (unsigned i = 0; i < 3; ++i) {
      const VertexId v = mesh_.triangles[t].v[i];
      corners.at[i] = mesh_.points[v];
      corners.same[i] = same_[v];
      box.add(corners.at[i]);
    }
    const auto& [a, b, c] = corners.at;
    corners.shortest = std::min({squaredDistance(a, b), squaredDistance(b, c), squaredDistance(c, a)});
    bool met = false;
    outline_.visit(box.grownBy(kNear * std::sqrt(corners.shortest)),
                   [&](std::uint32_t e) { met = met || isMetBy(corners, e); });
    for (const VertexId v : mesh_.triangles[t].v) met = met || (is_shore_[v] != 0 && isBesideEdge(v));
    return met;
  }

 private:
  // The keys of edges of the mesh whose nodes are both the outline's, in its numbers, sorted.
  std::vector<NodePair> edgesBetweenShared() const {
    std::vector<NodePair> edges;
    for (const Triangle& t : mesh_.triangles)
      for (unsigned i = 0; i < 3; ++i)
        if (const std::uint32_t a = same_[t.v[i]], b = same_[t.v[next3(i)]]; a != kNone && b != kNone)
          edges.push_back(edgeKey(a, b));
    std::ranges::sort(edges);
    return edges;
  }

  // A shore that begins or ends where the meshes continue one another: there the mesh's own shore goes on from it, so
  // that water close to it is across land, as it was.
  void addFittingShores() {
    const std::vector<Outline::Edge>& edges = outline_.edges();
    const auto spread = [&](std::size_t from, std::size_t to) {
      if (fits_[from] != 0 && !edges[to].joins) fits_[to] = 1;
    };
    for (std::size_t first = 0, last = 0; first < edges.size(); first = last + 1) {
      for (last = first; edges[last].b != edges[first].a;) ++last;
      const std::size_t n = last - first + 1;
      for (std::size_t i = 0; i < 2 * n; ++i) {
        spread(first + i % n, first + (i + 1) % n);
        spread(last - i % n, last - (i + 1) % n);
      }
    }
  }

  bool isMetBy(const Corners& t, std::uint32_t e) const {
    const Outline::Edge& edge = outline_.edges()[e];
    const Point &a = outline_.place(edge.a), &b = outline_.place(edge.b);
    unsigned shared = 0, last = 0;  // the number of corners that are ends of the edge, and the last of them
    for (unsigned i = 0; i < 3; ++i) {
      if (t.same[i] == kNone || (t.same[i] != edge.a && t.same[i] != edge.b)) continue;
      ++shared;
      last = i;
    }
    if (shared == 2) {
      const unsigned free = t.same[next3(last)] == edge.a || t.same[next3(last)] == edge.b ? prev3(last) : next3(last);
      return orient2d(a, b, t.at[free]) >= 0;
    }
    if (shared == 1) {
      if (entersAt(t, last, t.same[last] == edge.a ? b : a)) return true;
    } else if (holds(t, a) || holds(t, b) || segmentsMeet(a, b, t.at[0], t.at[1]) ||
               segmentsMeet(a, b, t.at[1], t.at[2]) || segmentsMeet(a, b, t.at[2], t.at[0])) {
      return true;
    }
    if (fits_[e] != 0) return false;
    const bool shares = std::ranges::any_of(t.same, [](std::uint32_t node) { return node != kNone; });
    const double share = shares ? kNearAtNode : kNear;
    const double near = share * share * std::min(t.shortest, squaredDistance(a, b));
    for (unsigned i = 0; i < 3; ++i) {
      if (t.same[i] == kNone && squaredDistanceToSegment(t.at[i], a, b) < near) return true;
      const Point &from = t.at[next3(i)], &to = t.at[prev3(i)];
      for (const std::uint32_t end : {edge.a, edge.b})
        if (std::ranges::find(t.same, end) == t.same.end() &&
            squaredDistanceToSegment(outline_.place(end), from, to) < near)
          return true;
    }
    return false;
  }

  // True for a node of a shore, which would stay, that is close to an edge that stays too, for its length: of a coarser
  // mesh. Edges at which the meshes continue one another do not count.
  bool isBesideEdge(VertexId v) const {
    return outline_.isNear(mesh_.points[v], kNear, [&](std::uint32_t e) { return stays_[e] != 0; });
  }

  const TriMesh& mesh_;
  std::span<const std::uint32_t> same_;
  const Outline& outline_;
  std::vector<std::uint8_t> is_shore_;  // for each node
  std::vector<std::uint8_t> stays_;     // for each edge of the outline: it joins, and no node of the mesh is its end
  // For each edge of the outline: the mesh has it too, or it is of a shore that fits the mesh's. What lies between it
  // and a triangle is as it was in the mesh.
  std::vector<std::uint8_t> fits_;
};

// The edges of the outline between nodes of the mesh, sorted.
std::vector<NodePair> sharedEdges(const TriMesh& mesh, std::span<const std::uint32_t> same, const Outline& outline) {
  std::vector<NodePair> edges;
  if (std::ranges::all_of(same, [](std::uint32_t node) { return node == kNone; })) return edges;
  std::vector<NodePair> node_of;  // of the outline, and the mesh's
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v)
    if (same[v] != kNone) node_of.push_back({same[v], v});
  std::ranges::sort(node_of);
  const auto find = [&](std::uint32_t node) {
    const auto at = std::ranges::lower_bound(node_of, node, {}, [](const NodePair& pair) { return pair[0]; });
    return at != node_of.end() && (*at)[0] == node ? (*at)[1] : kNone;
  };
  for (const Outline::Edge& edge : outline.edges())
    if (const std::uint32_t a = find(edge.a), b = find(edge.b); a != kNone && b != kNone)
      edges.push_back(edgeKey(a, b));
  std::ranges::sort(edges);
  return edges;
}

}  // namespace

std::vector<Cover> coverOf(const TriMesh& mesh, std::span<const std::uint32_t> same,
                           std::span<const std::uint8_t> is_far, const Outline& outline, const ItemLoop& loop) {
  const Tester tester(mesh, same, outline);
  std::vector<Cover> cover(mesh.triangles.size(), Cover::Free);
  forEachByStretches(loop, mesh.triangles.size(), [&](std::size_t t) {
    if ((is_far.empty() || is_far[t] == 0) && tester.isMet(static_cast<TriId>(t))) cover[t] = Cover::Met;
  });
  // Between triangles that the outline does not meet, only its own edges separate inside from outside.
  const std::vector<NodePair> shared = sharedEdges(mesh, same, outline);
  std::vector<std::uint8_t> seen(is_far.begin(), is_far.end());
  seen.resize(mesh.triangles.size(), 0);
  std::vector<TriId> reached;
  for (TriId first = 0; first < mesh.triangles.size(); ++first) {
    if (seen[first] != 0 || cover[first] == Cover::Met) continue;
    const auto& v = mesh.triangles[first].v;
    const bool inside = outline.surrounds(centroid(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]));
    reached.assign(1, first);
    seen[first] = 1;
    while (!reached.empty()) {
      const TriId t = reached.back();
      reached.pop_back();
      if (inside) cover[t] = Cover::Inside;
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(t, i), across = mesh.twin(e);
        if (across == kNone || seen[triOf(across)] != 0 || cover[triOf(across)] == Cover::Met) continue;
        if (std::ranges::binary_search(shared, edgeKey(mesh.origin(e), mesh.target(e)))) continue;
        seen[triOf(across)] = 1;
        reached.push_back(triOf(across));
      }
    }
  }
  return cover;
}

}  // namespace coastmesh
