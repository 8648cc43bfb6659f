#include "gis/remesh/remesh_patch.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "core/union_find.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/error.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/projection/area_outline.hpp"

namespace coastmesh {

namespace {

// Calls `use(from, to)` for each edge of a chain.
void forEachEdge(std::span<const std::uint32_t> nodes, bool closed, const auto& use) {
  for (std::size_t i = 1; i < nodes.size(); ++i) use(nodes[i - 1], nodes[i]);
  if (closed && nodes.size() > 1) use(nodes.back(), nodes.front());
}

// What boundaries and lines say of edges between nodes of patches, in either direction.
struct EdgeUse {
  bool is_open = false;   // of an open boundary
  bool is_whole = false;  // of a weir with two shores or heights
  bool is_boundary = false;
  bool is_line = false;
};

class EdgeUses {
 public:
  EdgeUses(const Grid& grid, const std::vector<std::uint8_t>& in_patch) : named_(grid.nodes.size(), 0) {
    const auto isInside = [&](std::uint32_t a, std::uint32_t b) { return in_patch[a] != 0 && in_patch[b] != 0; };
    for (const Boundary& boundary : grid.boundaries) {
      const bool is_whole = !boundary.back_nodes.empty() || !boundary.weir.empty();
      for (const auto* nodes : {&boundary.nodes, &boundary.back_nodes}) {
        for (const std::uint32_t node : *nodes) named_[node] = 1;
        forEachEdge(*nodes, boundary.closed, [&](std::uint32_t a, std::uint32_t b) {
          if (!isInside(a, b)) return;
          EdgeUse& use = uses_[edgeKey(a, b)];
          use.is_boundary = true;
          use.is_open = use.is_open || boundary.role == BoundaryRole::Open;
          use.is_whole = use.is_whole || is_whole;
        });
      }
    }
    for (const GridLine& line : grid.lines) {
      for (const std::uint32_t node : line.nodes) named_[node] = 1;
      forEachEdge(line.nodes, line.closed, [&](std::uint32_t a, std::uint32_t b) {
        if (isInside(a, b)) uses_[edgeKey(a, b)].is_line = true;
      });
    }
  }

  EdgeUse of(std::uint32_t a, std::uint32_t b) const {
    const auto found = uses_.find(edgeKey(a, b));
    return found == uses_.end() ? EdgeUse{} : found->second;
  }
  // True if a boundary or a line has the node.
  bool isNamed(std::uint32_t node) const { return named_[node] != 0; }

 private:
  std::map<NodePair, EdgeUse> uses_;
  std::vector<std::uint8_t> named_;
};

// The triangles of each part, by their smallest triangle.
std::vector<std::vector<std::uint32_t>> partsOf(const TriMesh& mesh, const std::vector<std::uint8_t>& taken,
                                                const ItemLoop& loop) {
  SharedUnionFind sets(taken.size(), loop);
  forEachByStretches(loop, taken.size(), [&](std::size_t t) {
    for (const EdgeRef across : mesh.triangles[t].adj)
      if (taken[t] != 0 && across != kNone && taken[triOf(across)] != 0)
        sets.unite(static_cast<std::uint32_t>(t), triOf(across));
  });
  std::map<std::uint32_t, std::vector<std::uint32_t>> parts;
  for (std::uint32_t t = 0; t < taken.size(); ++t)
    if (taken[t] != 0) parts[sets.find(t)].push_back(t);
  std::vector<std::vector<std::uint32_t>> all;
  for (auto& [first, triangles] : parts) all.push_back(std::move(triangles));
  return all;
}

class PatchMaker {
 public:
  PatchMaker(const Grid& grid, const TriMesh& mesh, const std::vector<std::uint8_t>& taken, const EdgeUses& uses)
      : grid_(grid), mesh_(mesh), taken_(taken), uses_(uses) {}

  RemeshPatch make(std::vector<std::uint32_t> triangles) const {
    RemeshPatch patch;
    patch.triangles = std::move(triangles);
    std::vector<Kept> kept;
    for (const std::uint32_t t : patch.triangles)
      for (unsigned i = 0; i < 3; ++i) addEdge(edgeRef(t, i), kept);
    numberPoints(kept, patch);
    project(kept, patch);
    addSegments(kept, patch);
    return patch;
  }

 private:
  // An edge that becomes a segment.
  struct Kept {
    EdgeRef edge;
    Segment segment;  // between nodes of the grid
    bool is_shared;   // with a triangle that stays
  };

  RegionId labelOf(TriId t) const { return grid_.feature_of.empty() ? 0 : static_cast<RegionId>(grid_.feature_of[t]); }

  void addEdge(EdgeRef e, std::vector<Kept>& kept) const {
    const std::uint32_t a = mesh_.origin(e), b = mesh_.target(e);
    const EdgeRef twin = mesh_.twin(e);
    const bool is_shared = twin != kNone && taken_[triOf(twin)] == 0;
    Segment segment{a, b, 0, labelOf(triOf(e)), kOutside};
    if (is_shared) {
      segment.divide = Divide::Never;
      kept.push_back({e, segment, true});
      return;
    }
    if (twin != kNone && twin < e) return;
    const EdgeUse use = uses_.of(a, b);
    if (twin != kNone) {
      segment.right = labelOf(triOf(twin));
      if (!use.is_boundary && !use.is_line && segment.left == segment.right) return;
    } else if (use.is_open) {
      segment.tag = kOpenTag;
    }
    // A boundary within the mesh is a mistake, which stays for `check` to find.
    if (use.is_whole || (twin != kNone && use.is_boundary)) segment.divide = Divide::Never;
    kept.push_back({e, segment, false});
  }

  // Points are in the order of the grid's nodes.
  void numberPoints(std::vector<Kept>& kept, RemeshPatch& patch) const {
    std::vector<std::uint32_t>& nodes = patch.nodes;
    for (const Kept& edge : kept) nodes.insert(nodes.end(), {edge.segment.a, edge.segment.b});
    for (const std::uint32_t t : patch.triangles)
      for (const std::uint32_t node : mesh_.triangles[t].v)
        if (uses_.isNamed(node)) nodes.push_back(node);
    std::ranges::sort(nodes);
    const auto repeated = std::ranges::unique(nodes);
    nodes.erase(repeated.begin(), repeated.end());
    std::vector<bool> on_segment(nodes.size(), false);
    const auto numberOf = [&](std::uint32_t node) {
      return static_cast<VertexId>(std::ranges::lower_bound(nodes, node) - nodes.begin());
    };
    for (Kept& edge : kept) {
      for (VertexId* const end : {&edge.segment.a, &edge.segment.b}) {
        *end = numberOf(*end);
        on_segment[*end] = true;
      }
    }
    for (VertexId v = 0; v < nodes.size(); ++v)
      if (!on_segment[v]) patch.domain.asked.push_back(v);
  }

  Projection projectionOf(const std::vector<Kept>& kept, const std::vector<std::uint32_t>& triangles) const {
    constexpr std::size_t kMostWithin = 4096;
    std::vector<NodePair> edges;
    for (const Kept& of_patch : kept)
      if (of_patch.is_shared || mesh_.twin(of_patch.edge) == kNone)
        edges.push_back({mesh_.origin(of_patch.edge), mesh_.target(of_patch.edge)});
    if (edges.empty())
      throw InputError("the part to be meshed anew is a whole globe, which no plane shows: leave some of it out");
    std::vector<Ring> rings;
    for (const Boundary& boundary : chainEdges(edges)) {
      Ring& ring = rings.emplace_back();
      for (const std::uint32_t node : boundary.nodes) ring.push_back(grid_.nodes[node]);
    }
    std::vector<Point> within;
    for (std::size_t i = 0; i < triangles.size(); i += 1 + triangles.size() / kMostWithin)
      within.push_back(grid_.nodes[grid_.triangles[triangles[i]][0]]);
    return fittedWithin(grid_.crs, std::move(rings), std::move(within), "the part to be meshed anew",
                        SurfaceKind::Auto);
  }

  void project(const std::vector<Kept>& kept, RemeshPatch& patch) const {
    Domain& domain = patch.domain;
    domain.input_points.reserve(patch.nodes.size());
    for (const std::uint32_t node : patch.nodes) domain.input_points.push_back(grid_.nodes[node]);
    if (!grid_.crs.isPlane()) domain.projection = projectionOf(kept, patch.triangles);
    double scale = 1.0;
    for (const Point& p : domain.input_points) {
      domain.pslg.points.push_back(domain.projection.forward(p));
      scale = std::max(scale, domain.projection.scaleAt(domain.pslg.points.back()));
    }
    domain.resolution = resolutionOf(domain.pslg.points, domain.input_points, grid_.crs, scale, 0.0);
  }

  void addSegments(const std::vector<Kept>& kept, RemeshPatch& patch) const {
    const std::vector<Point>& points = patch.domain.pslg.points;
    const Projection& projection = patch.domain.projection;
    const auto lengthOf = [&](const Point& a, const Point& b) {
      return distance(a, b) / projection.scaleAt(midpoint(a, b));
    };
    for (const auto& [edge, segment, is_shared] : kept) {
      patch.domain.pslg.segments.push_back(segment);
      const Point &a = points[segment.a], &b = points[segment.b];
      if (is_shared || mesh_.twin(edge) == kNone) requireTurn(edge, projection, a, b);
      if (segment.divide == Divide::Freely) continue;
      double length_m = lengthOf(a, b);
      if (is_shared) {
        const Point beyond = projection.forward(grid_.nodes[mesh_.apex(mesh_.twin(edge))]);
        length_m = (length_m + lengthOf(b, beyond) + lengthOf(beyond, a)) / 3.0;
        patch.shared.push_back(static_cast<SegmentId>(patch.domain.pslg.segments.size() - 1));
      }
      patch.rim.push_back({a, b, length_m, 0.0});
    }
  }

  // The inside of an outline is to the left of its edges.
  void requireTurn(EdgeRef edge, const Projection& projection, const Point& a, const Point& b) const {
    const Point apex = projection.forward(grid_.nodes[mesh_.apex(edge)]);
    if (orient2d(a, b, apex) > 0) return;
    const Point middle = middleOf(grid_, triOf(edge));
    throw InputError("triangle " + std::to_string(triOf(edge) + 1) + " at (" + std::to_string(middle.x) + ", " +
                     std::to_string(middle.y) +
                     "), at the edge of the part to be meshed anew, is clockwise or flat: convert with --target turns "
                     "clockwise triangles");
  }

  const Grid& grid_;
  const TriMesh& mesh_;
  const std::vector<std::uint8_t>& taken_;
  const EdgeUses& uses_;
};

}  // namespace

std::vector<RemeshPatch> patchesOf(const Grid& grid, const TriMesh& mesh, const std::vector<std::uint8_t>& taken,
                                   const ItemLoop& loop) {
  std::vector<std::uint8_t> in_patch(grid.nodes.size(), 0);
  for (std::size_t t = 0; t < taken.size(); ++t)
    if (taken[t] != 0)
      for (const std::uint32_t node : grid.triangles[t]) in_patch[node] = 1;
  const EdgeUses uses(grid, in_patch);
  const PatchMaker maker(grid, mesh, taken, uses);
  std::vector<std::vector<std::uint32_t>> parts = partsOf(mesh, taken, loop);
  std::vector<RemeshPatch> patches(parts.size());
  forItems(loop, parts.size(), [&](std::size_t i) { patches[i] = maker.make(std::move(parts[i])); });
  return patches;
}

}  // namespace coastmesh
