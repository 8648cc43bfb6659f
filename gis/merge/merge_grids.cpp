#include "gis/merge/merge_grids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "core/union_find.hpp"
#include "gis/cut/cut_boundaries.hpp"
#include "gis/error.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/geometry/ring_area.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/linked_grid.hpp"
#include "gis/merge/covered_triangles.hpp"
#include "gis/merge/enclosed_gaps.hpp"
#include "gis/merge/gap_faces.hpp"
#include "gis/merge/outline.hpp"
#include "gis/merge/seam_boundaries.hpp"
#include "gis/merge/tidy_gap.hpp"

namespace coastmesh {

namespace {

// Nodes nearer than this share of the shortest edge of the outline beside them are the same.
constexpr double kSame = 0.01;

std::string placeText(const Point& p) { return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ")"; }

// For each node of the grid: the node of the outline that is the same, kNone if there is none.
std::vector<std::uint32_t> sameNodes(const Grid& grid, const Outline& outline, const ItemLoop& loop) {
  std::vector<std::pair<std::uint32_t, double>> nodes;  // of the outline, with the square of the distance allowed
  for (const Outline::Edge& edge : outline.edges()) {
    const double squared = kSame * kSame * squaredDistance(outline.place(edge.a), outline.place(edge.b));
    nodes.emplace_back(edge.a, squared);
    nodes.emplace_back(edge.b, squared);
  }
  std::ranges::sort(nodes);  // the shortest edge of each node first
  const auto [repeated, end] = std::ranges::unique(nodes, {}, [](const auto& node) { return node.first; });
  nodes.erase(repeated, end);
  std::vector<Box> boxes;
  for (const auto& [node, squared] : nodes)
    boxes.push_back(Box::of(outline.place(node), outline.place(node)).grownBy(std::sqrt(squared)));
  const BoxTree tree(boxes, BoxTree::Order::Hilbert, loop);
  std::vector<std::uint32_t> same(grid.nodes.size(), kNone);
  forEachByStretches(loop, grid.nodes.size(), [&](std::size_t v) {
    double least = std::numeric_limits<double>::infinity();
    tree.visit(Box::of(grid.nodes[v], grid.nodes[v]), [&](std::uint32_t i) {
      const auto [node, squared] = nodes[i];
      const double between = squaredDistance(grid.nodes[v], outline.place(node));
      if (between <= squared && between < least) {
        least = between;
        same[v] = node;
      }
    });
  });
  // Of several nodes at one place, the nearest is the same.
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::uint32_t v = 0; v < same.size(); ++v)
    if (same[v] != kNone) pairs.push_back({same[v], v});
  std::ranges::sort(pairs, [&](const auto& a, const auto& b) {
    const auto between = [&](const auto& pair) { return squaredDistance(grid.nodes[pair[1]], outline.place(pair[0])); };
    return a[0] != b[0] ? a[0] < b[0] : std::pair(between(a), a[1]) < std::pair(between(b), b[1]);
  });
  for (std::size_t i = 1; i < pairs.size(); ++i)
    if (pairs[i][0] == pairs[i - 1][0]) same[pairs[i][1]] = kNone;
  return same;
}

bool isTurned(const TriMesh& mesh, TriId t) {
  const auto& v = mesh.triangles[t].v;
  return orient2d(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]) <= 0;
}

// Throws InputError for a triangle in the box that is not counter-clockwise. `name`: "the mesh".
void requireTurns(const TriMesh& mesh, const Box& box, const std::string& name) {
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    if (!isTurned(mesh, t)) continue;
    Box own;
    for (const VertexId v : mesh.triangles[t].v) own.add(mesh.points[v]);
    if (!own.meets(box)) continue;
    throw InputError("triangle " + std::to_string(t + 1) + " of " + name + " at " +
                     placeText(mesh.points[mesh.triangles[t].v[0]]) +
                     " is clockwise, flat or jumps at the antimeridian: convert with --target turns clockwise ones");
  }
}

// The loops of the grid's boundary around holes that are open all around, near the outline.
std::vector<std::vector<VertexId>> openHoles(const TriMesh& mesh, const EdgeKinds& kinds, const Outline& outline,
                                             const ItemLoop& loop) {
  std::vector<std::vector<VertexId>> holes = boundaryLoops(mesh, loop);
  std::erase_if(holes, [&](const std::vector<VertexId>& ring) {
    std::vector<Point> places;
    Box box;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const BoundaryKind* const kind = kinds.find(ring[i], ring[(i + 1) % ring.size()]);
      if (kind == nullptr || kind->role != BoundaryRole::Open) return true;
      places.push_back(mesh.points[ring[i]]);
      box.add(places.back());
    }
    return signedAreaOf(places) >= 0.0 || !box.meets(outline.box());
  });
  return holes;
}

// The triangles of both meshes, without those that the outline covers, and of the gap between them. Nodes are numbered
// as in `GapFaces`.
struct Whole {
  TriMesh mesh;
  std::vector<TriId> kept;  // of the grid, ascending: its triangles come first
  TriId first_inserted = 0, first_gap = 0;
};

Whole assemble(const TriMesh& mesh, const TriMesh& inserted, std::span<const std::uint32_t> same,
               std::span<const Cover> cover, const GapFaces& gap, const ItemLoop& loop) {
  Whole whole;
  const auto shift = static_cast<std::uint32_t>(mesh.points.size());
  BulkList<Point> points(mesh.points);
  points.insert(points.end(), inserted.points.begin(), inserted.points.end());
  std::vector<std::array<VertexId, 3>> corners;
  for (TriId t = 0; t < cover.size(); ++t) {
    if (cover[t] != Cover::Free) continue;
    whole.kept.push_back(t);
    auto& own = corners.emplace_back(mesh.triangles[t].v);
    for (VertexId& v : own) v = same[v] == kNone ? v : shift + same[v];
  }
  whole.first_inserted = static_cast<TriId>(corners.size());
  for (const Triangle& t : inserted.triangles) corners.push_back({shift + t.v[0], shift + t.v[1], shift + t.v[2]});
  whole.first_gap = static_cast<TriId>(corners.size());
  corners.insert(corners.end(), gap.triangles.begin(), gap.triangles.end());
  std::vector<EdgeConflict> conflicts;
  whole.mesh = linkTriangles(std::move(points), corners, conflicts, loop);
  // Conflicts within either mesh are not of this.
  for (const EdgeConflict& edge : conflicts)
    if (edge.a >= shift && edge.b >= shift && std::ranges::find(same, edge.a - shift) != same.end() &&
        std::ranges::find(same, edge.b - shift) != same.end())
      throw InputError("the meshes overlap beside the edge at " + placeText(whole.mesh.points[edge.a]) +
                       ", which both have");
  return whole;
}

// Nodes of triangles that are kept and of others, or of the outline, in the whole's numbers.
std::vector<VertexId> changedNodes(const TriMesh& mesh, std::span<const std::uint32_t> same,
                                   std::span<const Cover> cover) {
  std::vector<std::uint8_t> of_kept(same.size(), 0), of_covered(same.size(), 0);
  for (TriId t = 0; t < cover.size(); ++t)
    for (const VertexId v : mesh.triangles[t].v) (cover[t] == Cover::Free ? of_kept : of_covered)[v] = 1;
  std::vector<VertexId> changed;
  for (VertexId v = 0; v < same.size(); ++v)
    if (of_kept[v] != 0 && (of_covered[v] != 0 || same[v] != kNone))
      changed.push_back(same[v] == kNone ? v : static_cast<VertexId>(same.size()) + same[v]);
  return changed;
}

// Clears the flags of triangles of the grid in waters that were connected with the rest only through those that the
// outline covers: neither with the inserted mesh nor, by a boundary of their own, with the sea. Returns how many.
std::size_t leaveOutCutOff(const Whole& whole, const TriMesh& mesh, std::span<const Cover> cover,
                           const EdgeKinds& kinds, std::vector<std::uint8_t>& taken) {
  const std::size_t triangles = whole.mesh.triangles.size();
  UnionFind waters(triangles);
  for (TriId t = 0; t < triangles; ++t)
    for (const EdgeRef across : whole.mesh.triangles[t].adj)
      if (taken[t] != 0 && across != kNone && taken[triOf(across)] != 0) waters.unite(t, triOf(across));
  std::vector<std::uint8_t> is_cut(triangles, 0), stays(triangles, 0);  // by water
  for (TriId i = 0; i < whole.first_inserted; ++i) {
    const TriId t = whole.kept[i];
    for (unsigned k = 0; k < 3; ++k) {
      const EdgeRef e = edgeRef(t, k), across = mesh.twin(e);
      if (across != kNone && cover[triOf(across)] != Cover::Free) is_cut[waters.find(i)] = 1;
      if (across != kNone) continue;
      const BoundaryKind* const kind = kinds.find(mesh.origin(e), mesh.target(e));
      if (kind != nullptr && kind->role == BoundaryRole::Open) stays[waters.find(i)] = 1;
    }
  }
  for (TriId t = whole.first_inserted; t < whole.first_gap; ++t) stays[waters.find(t)] = 1;
  std::size_t left_out = 0;
  for (TriId t = 0; t < triangles; ++t) {
    const std::uint32_t water = waters.find(t);
    if (taken[t] == 0 || stays[water] != 0 || (is_cut[water] == 0 && t < whole.first_inserted)) continue;
    taken[t] = 0;
    if (t < whole.first_inserted) ++left_out;
  }
  return left_out;
}

// Edges of the inserted mesh that end at nothing else, and have another triangle across now.
std::size_t joinedEdges(const Whole& whole, const TriMesh& inserted, const std::vector<std::uint8_t>& taken) {
  std::size_t joined = 0;
  for (TriId t = 0; t < inserted.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      if (inserted.twin(edgeRef(t, i)) != kNone) continue;
      const EdgeRef across = whole.mesh.twin(edgeRef(whole.first_inserted + t, i));
      if (across != kNone && taken[triOf(across)] != 0) ++joined;
    }
  }
  return joined;
}

// Both have features and the same kinds of values, or neither.
void matchValues(Grid& grid, Grid& inserted) {
  if (grid.feature_of.empty() != inserted.feature_of.empty()) {
    Grid& silent = grid.feature_of.empty() ? grid : inserted;
    silent.feature_of.assign(silent.triangles.size(), 0);
    silent.features.assign(1, {});
  }
  const auto clearUnlessBoth = [](auto& a, auto& b) {
    if (!a.empty() && !b.empty()) return;
    a.clear();
    b.clear();
  };
  clearUnlessBoth(grid.size_m, inserted.size_m);
  clearUnlessBoth(grid.min_angle_deg, inserted.min_angle_deg);
  clearUnlessBoth(grid.area_m2, inserted.area_m2);
}

// Leaves out triangles without a flag, and sets `cut` to the edges of the others beyond which some were. Nodes stay.
void cutOut(Grid& grid, const TriMesh& mesh, const std::vector<std::uint8_t>& keeps, const ItemLoop& loop,
            std::vector<NodePair>& cut) {
  CutBoundaries boundaries = boundariesOfPart(grid, mesh, keeps, BoundaryRole::Land, loop);
  grid.boundaries = std::move(boundaries.kept);
  std::ranges::move(boundaries.walls, std::back_inserter(grid.boundaries));
  for (const Boundary& boundary : boundaries.cuts)
    for (const NodePair& edge : edgesOf(boundary)) cut.push_back(edge);
  std::vector<bool> gone(keeps.size());
  for (std::size_t t = 0; t < keeps.size(); ++t) gone[t] = keeps[t] == 0;
  removeTriangles(grid, gone);
}

// Appends the taken triangles of the gap, with the feature of the grid's triangle that is nearest through the gap, else
// of the inserted mesh's. Borders between features are edges that stay.
void appendGap(Grid& grid, const Whole& whole, const std::vector<std::uint8_t>& taken) {
  std::vector<std::uint32_t> source(taken.size(), kNone);  // a triangle of the merged grid
  std::vector<TriId> reached;                              // of the gap, with a source
  const auto reach = [&](TriId t) {
    for (const EdgeRef across : whole.mesh.triangles[t].adj) {
      if (taken[t] == 0 || source[t] != kNone || across == kNone || source[triOf(across)] == kNone) continue;
      source[t] = source[triOf(across)];
      reached.push_back(t);
    }
  };
  const auto spread = [&] {
    for (TriId t = whole.first_gap; t < taken.size(); ++t) reach(t);
    for (std::size_t i = 0; i < reached.size(); ++i)
      for (const EdgeRef across : whole.mesh.triangles[reached[i]].adj)
        if (across != kNone && triOf(across) >= whole.first_gap) reach(triOf(across));
  };
  std::uint32_t number = 0;
  for (TriId t = 0; t < whole.first_inserted; ++t)
    if (taken[t] != 0) source[t] = number++;
  spread();
  for (TriId t = whole.first_inserted; t < whole.first_gap; ++t) source[t] = number++;
  spread();
  for (TriId t = whole.first_gap; t < taken.size(); ++t)
    if (taken[t] != 0) copyTriangle(grid, source[t], whole.mesh.triangles[t].v);
}

}  // namespace

MergeReport mergeGrids(Grid& grid, Grid&& inserted, const ItemLoop& loop) {
  MergeReport report;
  TriMesh mesh = linkGrid(grid, loop).mesh;
  const TriMesh other = linkGrid(inserted, loop).mesh;
  const Outline outline(inserted, other, loop);
  report.has_open = outline.hasOpen();
  requireTurns(other, outline.box(), "the mesh that is put in");
  requireTurns(mesh, outline.box(), "the mesh");
  const std::vector<std::uint32_t> same = sameNodes(grid, outline, loop);
  for (std::uint32_t v = 0; v < same.size(); ++v)
    if (same[v] != kNone) mesh.points[v] = outline.place(same[v]);
  std::vector<Cover> cover = coverOf(mesh, same, outline, loop);
  for (TriId t = 0; t < cover.size(); ++t)
    if (cover[t] == Cover::Free && isTurned(mesh, t)) cover[t] = Cover::Met;  // by a node that moved
  if (std::ranges::find(cover, Cover::Free) == cover.end())
    throw InputError("the mesh that is put in covers all of the other one");
  const EdgeKinds kinds(grid), other_kinds(inserted);
  GapFaces gap = fillGap(mesh, same, cover, openHoles(mesh, kinds, outline, loop), outline, loop);
  Whole whole = assemble(mesh, other, same, cover, gap, loop);
  const auto isOpen = [](const EdgeKinds& of, const TriMesh& whose, EdgeRef e) {
    const BoundaryKind* const kind = of.find(whose.origin(e), whose.target(e));
    return kind != nullptr && kind->role == BoundaryRole::Open;
  };
  const auto enclosed = fillEnclosed(
      whole.mesh,
      [&](EdgeRef e) {
        const TriId t = triOf(e);
        if (t < whole.first_inserted)
          return isOpen(kinds, mesh, edgeRef(whole.kept[t], indexOf(e))) ? EndKind::OpenOfOne : EndKind::Shore;
        if (t >= whole.first_gap) return EndKind::Shore;
        return isOpen(other_kinds, other, e - edgeRef(whole.first_inserted, 0)) ? EndKind::OpenOfOther : EndKind::Shore;
      },
      loop);
  if (!enclosed.empty()) {
    gap.triangles.insert(gap.triangles.end(), enclosed.begin(), enclosed.end());
    whole = assemble(mesh, other, same, cover, gap, loop);
  }
  std::vector<std::uint8_t> taken(whole.mesh.triangles.size(), 1);
  tidyGap(whole.mesh,
          {whole.first_inserted, whole.first_gap, std::move(gap.shore), changedNodes(mesh, same, cover), grid.crs},
          taken);
  report.covered =
      cover.size() - static_cast<std::size_t>(std::count(taken.begin(), taken.begin() + whole.first_inserted, 1));
  report.cut_off = leaveOutCutOff(whole, mesh, cover, kinds, taken);
  report.joined = joinedEdges(whole, other, taken);
  if (report.joined == 0)
    throw InputError(report.has_open
                         ? "no open boundary of the mesh that is put in has water of the other one beside it"
                         : "the mesh that is put in has no water of the other one beside it");

  // The grid without what is covered.
  std::vector<std::uint8_t> keeps(cover.size(), 0), is_united(same.size(), 0);
  for (TriId i = 0; i < whole.first_inserted; ++i) {
    keeps[whole.kept[i]] = taken[i];
    for (const VertexId v : mesh.triangles[whole.kept[i]].v)
      if (taken[i] != 0 && same[v] != kNone) is_united[v] = 1;
  }
  report.united = static_cast<std::size_t>(std::ranges::count(is_united, 1));
  if (std::ranges::find(keeps, 1) == keeps.end())
    throw InputError("the mesh that is put in covers all of the other one's water that is connected with it");
  const auto shift = static_cast<std::uint32_t>(grid.nodes.size());
  std::vector<std::uint32_t> instead(shift + inserted.nodes.size());
  for (std::uint32_t v = 0; v < instead.size(); ++v) instead[v] = v < shift && same[v] != kNone ? shift + same[v] : v;
  SeamOrigin origin;
  cutOut(grid, mesh, keeps, loop, origin.cut);
  for (NodePair& edge : origin.cut) edge = edgeKey(instead[edge[0]], instead[edge[1]]);

  // Both together, with the gap.
  report.partition_dropped = !grid.part_of.empty() || !grid.node_part_of.empty() || !inserted.part_of.empty() ||
                             !inserted.node_part_of.empty();
  for (Grid* const part : {&grid, &inserted}) {
    part->part_of.clear();
    part->node_part_of.clear();
    part->notes.clear();
  }
  matchValues(grid, inserted);
  origin.first_inserted = grid.boundaries.size();
  appendGrid(grid, std::move(inserted));
  replaceNodes(grid, instead);
  origin.first_gap = static_cast<TriId>(grid.triangles.size());
  appendGap(grid, whole, taken);
  report.gap = grid.triangles.size() - origin.first_gap;
  std::vector<std::uint32_t> old_of(instead.size());  // the node of the grid that is node v of the whole
  for (std::uint32_t v = 0; v < instead.size(); ++v) old_of[v] = v;
  for (std::uint32_t v = 0; v < shift; ++v)
    if (instead[v] != v) old_of[instead[v]] = v;
  origin.kind_before = [&](std::uint32_t a, std::uint32_t b) -> const BoundaryKind* {
    return old_of[a] < shift && old_of[b] < shift ? kinds.find(old_of[a], old_of[b]) : nullptr;
  };
  report.walls = setSeamBoundaries(grid, linkGrid(grid, loop).mesh, origin, loop);
  cutLinesOffEdges(grid);

  for (TriId i = 0; i < whole.first_inserted; ++i)
    if (taken[i] != 0) report.triangles.push_back({0, whole.kept[i]});
  for (TriId t = 0; t < other.triangles.size(); ++t) report.triangles.push_back({1, t});
  report.triangles.resize(grid.triangles.size());
  const std::vector<std::uint32_t> index_of = removeUnusedNodes(grid);
  report.nodes.resize(grid.nodes.size());
  for (std::uint32_t v = 0; v < index_of.size(); ++v)
    if (index_of[v] != kNone) report.nodes[index_of[v]] = v < shift ? MergeSource{0, v} : MergeSource{1, v - shift};
  if (!grid.feature_of.empty()) sortFeatures(grid);
  return report;
}

}  // namespace coastmesh
