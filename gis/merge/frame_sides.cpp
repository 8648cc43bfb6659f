#include "gis/merge/frame_sides.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "gis/fields/plain_field.hpp"
#include "gis/geometry/box.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/boundary_kinds.hpp"

namespace coastmesh {

namespace {

// A side has this many edges at least, and turns by no more than this (its sine) from one to the next: parallels are
// curved in most planes, and places are rounded in files.
constexpr std::size_t kLeastEdges = 3;
const double kMostTurn = std::sin(0.5 * std::numbers::pi / 180.0);
// How far the outline may lie beyond a side, as a share of the side's length.
constexpr double kBeyondSide = 0.01;
// Parts of the outline that the other mesh would show, in its edges beside them.
constexpr double kLong = 2.0;

// The triangles of the other mesh near the outline.
class Surroundings {
 public:
  Surroundings(const Grid& grid, const TriMesh& mesh, std::span<const std::uint8_t> is_far, const Outline& outline,
               const ItemLoop& loop)
      : grid_(grid), mesh_(mesh), land_(landNodes(grid)) {
    const auto boxOf = [&](TriId t) {
      Box box;
      for (const VertexId v : mesh.triangles[t].v) box.add(mesh.points[v]);
      return box;
    };
    const auto isNear = [&](TriId t, const Box& around) {
      return (is_far.empty() || is_far[t] == 0) && boxOf(t).meets(around);
    };
    double reach = 0.0;
    for (TriId t = 0; t < mesh.triangles.size(); ++t)
      if (isNear(t, outline.box())) reach = std::max(reach, longestEdge(t));
    const Box around = outline.box().grownBy(reach);
    std::vector<Box> boxes;
    for (TriId t = 0; t < mesh.triangles.size(); ++t) {
      if (!isNear(t, around)) continue;
      near_.push_back(t);
      boxes.push_back(boxOf(t));
    }
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert, loop);
  }

  std::optional<TriId> triangleAt(const Point& p) const {
    std::optional<TriId> found;
    tree_.visit(Box::of(p, p), [&](std::uint32_t i) {
      const auto [a, b, c] = cornersOf(near_[i]);
      if (orient2d(a, b, p) >= 0 && orient2d(b, c, p) >= 0 && orient2d(c, a, p) >= 0) found = near_[i];
    });
    return found;
  }

  double longestEdge(TriId t) const {
    const auto [a, b, c] = cornersOf(t);
    return std::max({distance(a, b), distance(b, c), distance(c, a)});
  }

  // On the land of a flood plain, or above the water, linear between the corners.
  bool isOnLand(TriId t, const Point& p) const {
    const auto& v = mesh_.triangles[t].v;
    if (!land_.empty() && (land_[v[0]] != 0 || land_[v[1]] != 0 || land_[v[2]] != 0)) return true;
    if (grid_.z.empty()) return false;
    const auto [a, b, c] = cornersOf(t);
    const double sum =
        cross(b - p, c - p) * grid_.z[v[0]] + cross(c - p, a - p) * grid_.z[v[1]] + cross(a - p, b - p) * grid_.z[v[2]];
    return sum > 0.0;  // counter-clockwise, so that weights are positive
  }

 private:
  std::array<Point, 3> cornersOf(TriId t) const {
    const auto& v = mesh_.triangles[t].v;
    return {mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]};
  }

  const Grid& grid_;
  const TriMesh& mesh_;
  const std::vector<std::uint8_t> land_;  // see `landNodes`
  std::vector<TriId> near_;
  BoxTree tree_;
};

// The keys of the edges of shores that are no weirs, with the third corner of their triangles, sorted.
std::vector<std::pair<NodePair, VertexId>> shoreTriangles(const Grid& grid, const TriMesh& mesh) {
  std::vector<NodePair> shores;
  for (const Boundary& boundary : grid.boundaries)
    if (!isOpening(boundary.role) && boundary.back_nodes.empty() && boundary.weir.empty())
      for (const auto& [a, b] : edgesOf(boundary)) shores.push_back(edgeKey(a, b));
  std::ranges::sort(shores);
  std::vector<std::pair<NodePair, VertexId>> all;
  for (TriId t = 0; t < mesh.triangles.size(); ++t)
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      const NodePair key = edgeKey(mesh.origin(e), mesh.target(e));
      if (mesh.twin(e) == kNone && std::ranges::binary_search(shores, key))
        all.emplace_back(key, mesh.triangles[t].v[i]);
    }
  std::ranges::sort(all);
  return all;
}

// A shore's edge, and the other mesh beyond it.
struct Beyond {
  bool is_there = false;  // it has a triangle right beside the edge
  bool goes_on = false;   // and farther away than the longest edge of that
  bool is_land = false;   // and lies above the water there
  bool is_plain =
      false;            // and goes on, is above the water at one of both places, and the edge's own triangle is so too
  double length = 0.0;  // of the edge
  double reach = 0.0;   // longest edge of the triangle beside it
};

class SideFinder {
 public:
  SideFinder(const Grid& grid, const TriMesh& mesh, std::span<const std::uint8_t> is_far, const Grid& inserted,
             const TriMesh& inserted_mesh, const Outline& outline, const ItemLoop& loop)
      : inserted_(inserted),
        inserted_land_(landNodes(inserted)),
        outline_(outline),
        other_(grid, mesh, is_far, outline, loop) {
    const auto shores = shoreTriangles(inserted, inserted_mesh);
    const std::vector<Outline::Edge>& edges = outline.edges();
    beyond_.resize(edges.size());
    forEachByStretches(loop, edges.size(), [&](std::size_t e) {
      const NodePair key = edgeKey(edges[e].a, edges[e].b);
      const auto at = std::ranges::lower_bound(shores, key, {}, &std::pair<NodePair, VertexId>::first);
      if (at != shores.end() && at->first == key) beyond_[e] = beyondEdge(edges[e], at->second);
    });
  }

  FrameSides find() {
    is_taken_.assign(beyond_.size(), 0);
    const std::vector<Outline::Edge>& edges = outline_.edges();
    for (std::size_t first = 0, last = 0; first < edges.size(); first = last + 1) {
      for (last = first; edges[last].b != edges[first].a;) ++last;
      std::vector<std::uint32_t> ring;
      for (std::size_t e = first; e <= last; ++e) ring.push_back(static_cast<std::uint32_t>(e));
      for (const auto& side : stretchesOf(ring, [&](std::uint32_t e, std::uint32_t next) { return goOn(e, next); }))
        judgeSide(side);
      for (const auto& part : partsBeside(ring, true))
        if (isMostly(part, &Beyond::is_land)) close(part);
    }
    for (auto* const list : {&found_.joined, &found_.closed}) std::ranges::sort(*list);
    return std::move(found_);
  }

 private:
  using Edges = std::vector<std::uint32_t>;

  Beyond beyondEdge(const Outline::Edge& edge, VertexId third) const {
    const Point &a = outline_.place(edge.a), &b = outline_.place(edge.b);
    const Point middle = midpoint(a, b);
    Beyond beyond;
    beyond.length = distance(a, b);
    const std::optional<TriId> beside = other_.triangleAt(middle);
    if (!beside || !(beyond.length > 0.0)) return beyond;
    beyond.is_there = true;
    beyond.reach = other_.longestEdge(*beside);
    const Point outwards = Point{b.y - a.y, a.x - b.x};
    const Point there = middle + (beyond.reach / beyond.length) * outwards;
    const std::optional<TriId> farther = other_.triangleAt(there);
    beyond.goes_on = farther.has_value();
    beyond.is_land = farther && other_.isOnLand(*farther, there);
    beyond.is_plain =
        farther && (beyond.is_land || other_.isOnLand(*beside, middle)) && isOnLand({edge.a, edge.b, third});
    return beyond;
  }

  // The same for a triangle of the inserted mesh.
  bool isOnLand(const std::array<std::uint32_t, 3>& corners) const {
    const auto isLand = [this](std::uint32_t node) { return inserted_land_[node] != 0; };
    if (!inserted_land_.empty() && std::ranges::any_of(corners, isLand)) return true;
    return !inserted_.z.empty() && inserted_.z[corners[0]] + inserted_.z[corners[1]] + inserted_.z[corners[2]] > 0.0;
  }

  // True if an edge goes on straight in the next.
  bool goOn(std::uint32_t edge, std::uint32_t next) const {
    const Outline::Edge &one = outline_.edges()[edge], &other = outline_.edges()[next];
    const Point u = outline_.place(one.b) - outline_.place(one.a);
    const Point v = outline_.place(other.b) - outline_.place(other.a);
    return dot(u, v) > 0.0 && std::abs(cross(u, v)) <= kMostTurn * std::sqrt(dot(u, u) * dot(v, v));
  }

  // A ring in stretches of edges that go on.
  static std::vector<Edges> stretchesOf(Edges ring, const std::function<bool(std::uint32_t, std::uint32_t)>& goOn) {
    const std::size_t n = ring.size();
    std::size_t start = 0;
    while (start < n && goOn(ring[(start + n - 1) % n], ring[start])) ++start;
    std::ranges::rotate(ring, ring.begin() + static_cast<std::ptrdiff_t>(start % n));
    std::vector<Edges> all;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == 0 || !goOn(ring[i - 1], ring[i])) all.emplace_back();
      all.back().push_back(ring[i]);
    }
    return all;
  }

  // The parts of a stretch or ring that the other mesh is beside, without what is taken already.
  std::vector<Edges> partsBeside(const Edges& stretch, bool is_ring) const {
    const auto isDue = [&](std::uint32_t e) { return beyond_[e].is_there && is_taken_[e] == 0; };
    std::vector<Edges> all = stretchesOf(stretch, [&](std::uint32_t e, std::uint32_t next) {
      return isDue(e) && isDue(next) && (is_ring || e != stretch.back());
    });
    std::erase_if(all, [&](const Edges& part) { return !isDue(part.front()); });
    return all;
  }

  void judgeSide(const Edges& side) {
    if (side.size() < kLeastEdges || std::ranges::none_of(side, [&](std::uint32_t e) { return beyond_[e].goes_on; }))
      return;
    if (!isOfFrame(side)) return;
    bool joins = std::ranges::any_of(side, [&](std::uint32_t e) { return outline_.edges()[e].joins; });
    for (const Edges& part : partsBeside(side, false)) {
      if (!isMostly(part, &Beyond::is_plain)) continue;
      take(part, found_.joined);
      joins = true;
    }
    for (const Edges& part : partsBeside(side, false)) {
      if (!isMostly(part, &Beyond::goes_on)) continue;
      // Elements of other sizes see other ridges and creeks beside a side that joins elsewhere.
      if (joins && !isLong(part)) {
        take(part, found_.joined);
      } else {
        close(part);
      }
    }
  }

  // True if the outline is to the left of a side.
  bool isOfFrame(const Edges& side) const {
    const Point& from = outline_.place(outline_.edges()[side.front()].a);
    const Point along = outline_.place(outline_.edges()[side.back()].b) - from;
    const double least = -kBeyondSide * dot(along, along);
    return std::ranges::all_of(outline_.edges(), [&](const Outline::Edge& edge) {
      return cross(along, outline_.place(edge.a) - from) >= least;
    });
  }

  bool isMostly(const Edges& part, bool Beyond::*what) const {
    double of_it = 0.0, all = 0.0;
    for (const std::uint32_t e : part) {
      all += beyond_[e].length;
      if (beyond_[e].*what) of_it += beyond_[e].length;
    }
    return 2.0 * of_it >= all;
  }

  bool isLong(const Edges& part) const {
    double length = 0.0, reach = 0.0;
    for (const std::uint32_t e : part) {
      length += beyond_[e].length;
      reach = std::max(reach, beyond_[e].reach);
    }
    return length >= kLong * reach;
  }

  void close(const Edges& part) {
    if (isLong(part)) take(part, found_.closed);
  }

  void take(const Edges& part, Edges& list) {
    for (const std::uint32_t e : part) is_taken_[e] = 1;
    list.insert(list.end(), part.begin(), part.end());
  }

  const Grid& inserted_;
  const std::vector<std::uint8_t> inserted_land_;  // see `landNodes`
  const Outline& outline_;
  const Surroundings other_;
  std::vector<Beyond> beyond_;          // by edge; nothing for other edges than shores
  std::vector<std::uint8_t> is_taken_;  // by edge: it is in a list
  FrameSides found_;
};

}  // namespace

FrameSides frameSides(const Grid& grid, const TriMesh& mesh, std::span<const std::uint8_t> is_far, const Grid& inserted,
                      const TriMesh& inserted_mesh, const Outline& outline, const ItemLoop& loop) {
  if (!outline.hasOpen()) return {};
  return SideFinder(grid, mesh, is_far, inserted, inserted_mesh, outline, loop).find();
}

}  // namespace coastmesh
