#include "gis/merge/merge_grids.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <utility>

#include "gis/cut/cut_boundaries.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/linked_grid.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/merge/joined_meshes.hpp"
#include "gis/merge/lost_weirs.hpp"
#include "gis/merge/nearby_shore.hpp"
#include "gis/merge/nest_plane.hpp"
#include "gis/merge/seam_boundaries.hpp"

namespace coastmesh {

namespace {

// Both have features and the same kinds of values, or neither. Where only one has an attribute, the other gets its
// default.
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
  addMissingFields(grid, inserted);
  addMissingFields(inserted, grid);
  clearUnlessBoth(grid.size_m, inserted.size_m);
  clearUnlessBoth(grid.min_angle_deg, inserted.min_angle_deg);
  clearUnlessBoth(grid.area_m2, inserted.area_m2);
}

// A partition, and what is wrong in a file, are of one mesh alone. Returns true if there was a partition.
bool dropPartition(Grid& grid) {
  const bool had_one = !grid.part_of.empty() || !grid.node_part_of.empty();
  grid.part_of.clear();
  grid.node_part_of.clear();
  grid.notes.clear();
  return had_one;
}

// The grid's triangles without a flag, with the depths and fields of their nodes.
Grid partWithout(const Grid& grid, const std::vector<std::uint8_t>& keeps) {
  Grid part;
  part.crs = grid.crs;
  part.nodes = grid.nodes;
  part.z = grid.z;
  part.node_fields = grid.node_fields;
  for (std::size_t t = 0; t < keeps.size(); ++t)
    if (keeps[t] == 0) part.triangles.push_back(grid.triangles[t]);
  removeUnusedNodes(part);
  return part;
}

// Leaves out the grid's triangles that are not in the merged mesh, and puts these into `gone_part`. Nodes stay.
// Returns the edges of the others beyond which some were.
std::vector<NodePair> cutOut(Grid& grid, const JoinedMeshes& joined, Grid& gone_part, const ItemLoop& loop) {
  std::vector<std::uint8_t> keeps(grid.triangles.size(), 0);
  for (TriId i = 0; i < joined.first_inserted; ++i) keeps[joined.kept[i]] = joined.taken[i];
  gone_part = partWithout(grid, keeps);
  CutBoundaries boundaries = boundariesOfPart(grid, joined.mesh, keeps, BoundaryRole::Land, loop);
  grid.boundaries = std::move(boundaries.kept);
  std::ranges::move(boundaries.walls, std::back_inserter(grid.boundaries));
  std::vector<bool> gone(keeps.size());
  for (std::size_t t = 0; t < keeps.size(); ++t) gone[t] = keeps[t] == 0;
  removeTriangles(grid, gone);
  std::vector<NodePair> cut;
  for (const Boundary& boundary : boundaries.cuts) std::ranges::move(edgesOf(boundary), std::back_inserter(cut));
  return cut;
}

// The lines up to nodes of the outline where it passes them. What else is not along edges any more is cut off later.
std::vector<GridLine> upToOutline(std::vector<GridLine>&& lines, const std::vector<LineEnd>& ends) {
  if (ends.empty()) return std::move(lines);
  const auto nodeOf = [&](std::uint32_t from, std::uint32_t gone) {
    const auto at = std::ranges::lower_bound(ends, LineEnd{from, gone, 0});
    return at != ends.end() && at->from == from && at->gone == gone ? at->node : kNone;
  };
  std::vector<GridLine> all;
  for (GridLine& line : lines) {
    if (line.closed) line.nodes.push_back(line.nodes.front());
    bool is_passed = false;
    for (std::size_t i = 1; i < line.nodes.size(); ++i)
      is_passed = is_passed || nodeOf(line.nodes[i - 1], line.nodes[i]) != kNone ||
                  nodeOf(line.nodes[i], line.nodes[i - 1]) != kNone;
    if (!is_passed) {
      if (line.closed) line.nodes.pop_back();
      all.push_back(std::move(line));
      continue;
    }
    GridLine piece{line.kind, line.name, false, {}};
    for (std::size_t i = 0; i < line.nodes.size(); ++i) {
      const std::uint32_t here = line.nodes[i], before = i == 0 ? kNone : line.nodes[i - 1];
      const std::uint32_t last = i == 0 ? kNone : nodeOf(before, here), first = i == 0 ? kNone : nodeOf(here, before);
      if (last != kNone || first != kNone) {
        if (last != kNone) piece.nodes.push_back(last);
        all.push_back(std::exchange(piece, {line.kind, line.name, false, {}}));
        if (first != kNone) piece.nodes.push_back(first);
      }
      piece.nodes.push_back(here);
    }
    all.push_back(std::move(piece));
  }
  std::erase_if(all, [](const GridLine& line) { return line.nodes.size() < 2; });
  return all;
}

// Appends the gap's triangles, with the feature of the grid's triangle that is nearest through the gap. A part of it
// that only the inserted mesh surrounds has the feature of one triangle of that: borders between features are edges
// that stay, so none may wind through the gap.
void appendGap(Grid& grid, const JoinedMeshes& joined) {
  const auto triangles = static_cast<TriId>(joined.taken.size());
  std::vector<std::uint32_t> source(triangles, kNone);  // a triangle of the merged grid
  std::vector<TriId> reached;                           // of the gap, with a source
  const auto reach = [&](TriId t) {
    for (const EdgeRef across : joined.whole.triangles[t].adj) {
      if (!joined.isTaken(t) || source[t] != kNone || across == kNone || source[triOf(across)] == kNone) continue;
      source[t] = source[triOf(across)];
      reached.push_back(t);
    }
  };
  const auto isDue = [&](EdgeRef e) {
    return e != kNone && triOf(e) >= joined.first_gap && joined.isTaken(triOf(e)) && source[triOf(e)] == kNone;
  };
  const auto spreadFrom = [&](std::size_t first) {
    for (std::size_t i = first; i < reached.size(); ++i)
      for (const EdgeRef across : joined.whole.triangles[reached[i]].adj) {
        if (!isDue(across)) continue;
        source[triOf(across)] = source[reached[i]];
        reached.push_back(triOf(across));
      }
  };
  std::uint32_t number = 0;
  for (TriId t = 0; t < joined.first_inserted; ++t)
    if (joined.isTaken(t)) source[t] = number++;
  for (TriId t = joined.first_gap; t < triangles; ++t) reach(t);
  spreadFrom(0);
  for (TriId t = joined.first_inserted; t < joined.first_gap; ++t) source[t] = number++;
  for (TriId t = joined.first_gap; t < triangles; ++t) {
    const std::size_t before = reached.size();
    reach(t);
    spreadFrom(before);
  }
  for (TriId t = joined.first_gap; t < triangles; ++t)
    if (joined.isTaken(t)) copyTriangle(grid, source[t], joined.whole.triangles[t].v);
}

// The node that each becomes, in the numbers of the grid's nodes followed by the inserted mesh's.
std::vector<std::uint32_t> becomes(const std::vector<std::uint32_t>& same, std::size_t inserted_nodes) {
  const auto shift = static_cast<std::uint32_t>(same.size());
  std::vector<std::uint32_t> instead(shift + inserted_nodes);
  for (std::uint32_t v = 0; v < instead.size(); ++v) instead[v] = v < shift && same[v] != kNone ? shift + same[v] : v;
  return instead;
}

void renumber(std::vector<WeirPairs>& weirs, const std::vector<std::uint32_t>& instead, std::size_t first) {
  for (WeirPairs& weir : weirs)
    for (NodePair& pair : weir)
      for (std::uint32_t& node : pair) node = instead[first + node];
}

std::vector<Boundary> renumberedWeirs(const Grid& grid, const std::vector<std::uint32_t>& instead) {
  std::vector<Boundary> weirs;
  for (const Boundary& boundary : grid.boundaries)
    if (!boundary.back_nodes.empty()) weirs.push_back(boundary);
  for (Boundary& weir : weirs)
    for (std::vector<std::uint32_t>* const nodes : {&weir.nodes, &weir.back_nodes})
      for (std::uint32_t& node : *nodes) node = instead[node];
  return weirs;
}

std::size_t countUnited(const JoinedMeshes& joined) {
  std::vector<std::uint8_t> is_united(joined.same.size(), 0);
  for (TriId i = 0; i < joined.first_inserted; ++i)
    for (const VertexId v : joined.mesh.triangles[joined.kept[i]].v)
      if (joined.isTaken(i) && joined.same[v] != kNone) is_united[v] = 1;
  return static_cast<std::size_t>(std::ranges::count(is_united, 1));
}

// `grid` is the mesh that the edges are of.
ClosedSides closedSides(const Grid& grid, const std::vector<NodePair>& edges) {
  ClosedSides closed;
  if (edges.empty()) return closed;
  for (const NodePair& edge : edges) {
    const std::array<Point, 2> ends = localPlane(grid, edge);
    closed.length_m += distance(ends[0], ends[1]);
  }
  const NodePair& edge = edges[edges.size() / 2];
  closed.place = meanPlace(grid.crs, std::array{grid.nodes[edge[0]], grid.nodes[edge[1]]});
  return closed;
}

// Removes nodes that are in no triangle, and notes where all others come from.
void setSources(Grid& grid, const JoinedMeshes& joined, std::size_t inserted_triangles, MergeReport& report) {
  for (TriId i = 0; i < joined.first_inserted; ++i)
    if (joined.isTaken(i)) report.triangles.push_back({0, joined.kept[i]});
  for (TriId t = 0; t < inserted_triangles; ++t) report.triangles.push_back({1, t});
  report.triangles.resize(grid.triangles.size());
  const auto shift = static_cast<std::uint32_t>(joined.same.size());
  const std::vector<std::uint32_t> index_of = removeUnusedNodes(grid);
  report.nodes.resize(grid.nodes.size());
  for (std::uint32_t v = 0; v < index_of.size(); ++v)
    if (index_of[v] != kNone) report.nodes[index_of[v]] = v < shift ? MergeSource{0, v} : MergeSource{1, v - shift};
  report.of_both.assign(grid.nodes.size(), 0);
  for (const std::uint32_t node : joined.same)
    if (node != kNone && index_of[shift + node] != kNone) report.of_both[index_of[shift + node]] = 1;
}

}  // namespace

MergeReport mergeGrids(Grid& grid, Grid&& inserted, const ItemLoop& loop) {
  const std::optional<NestPlane> found = NestPlane::around(grid, inserted, loop);
  const NestPlane* const plane = found ? &*found : nullptr;
  if (plane != nullptr) matchTurn(inserted, grid);
  const JoinedMeshes joined = joinMeshes(grid, inserted, plane, loop);
  MergeReport report;
  report.covered = joined.covered;
  report.cut_off = joined.cut_off;
  report.joined = joined.joined;
  report.joined_land = joined.joined_land;
  report.closed = closedSides(inserted, joined.closed);
  report.has_open = joined.has_open;
  report.united = countUnited(joined);
  for (Grid* const part : {&grid, &inserted})
    report.partition_dropped = dropPartition(*part) || report.partition_dropped;

  const EdgeKinds kinds_before(grid);
  const NearbyShore shore_before(grid, plane, loop);
  const std::vector<std::uint32_t> instead = becomes(joined.same, inserted.nodes.size());
  std::vector<WeirPairs> weirs_before = weirsOf(grid), weirs_inserted = weirsOf(inserted);
  renumber(weirs_before, instead, 0);
  renumber(weirs_inserted, instead, joined.same.size());
  const std::size_t inserted_triangles = inserted.triangles.size();
  SeamOrigin origin;
  origin.weirs = renumberedWeirs(grid, instead);
  std::vector<GridLine> lines = upToOutline(std::exchange(grid.lines, {}), joined.line_ends);
  for (const auto& [a, b] : cutOut(grid, joined, report.gone, loop))
    origin.cut.push_back(edgeKey(instead[a], instead[b]));
  matchValues(grid, inserted);
  origin.first_inserted = grid.boundaries.size();
  appendGrid(grid, std::move(inserted));
  std::ranges::move(grid.lines, std::back_inserter(lines));
  grid.lines = std::move(lines);
  replaceNodes(grid, instead);
  origin.first_gap = static_cast<TriId>(grid.triangles.size());
  appendGap(grid, joined);
  report.gap = grid.triangles.size() - origin.first_gap;

  std::vector<std::uint32_t> node_before(instead.size(), kNone);  // of the grid
  for (std::uint32_t v = 0; v < joined.same.size(); ++v) node_before[instead[v]] = v;
  origin.kind_before = [&](std::uint32_t a, std::uint32_t b) {
    return node_before[a] == kNone || node_before[b] == kNone ? nullptr
                                                              : kinds_before.find(node_before[a], node_before[b]);
  };
  origin.is_at_shore = [&](const Point& a, const Point& b) { return shore_before.passes(a, b); };
  report.walls = setSeamBoundaries(grid, linkGrid(grid, loop).mesh, origin, loop);
  cutLinesOffEdges(grid);
  report.weir_gaps = weirGaps(grid, weirs_before, weirs_inserted);
  setSources(grid, joined, inserted_triangles, report);
  if (!grid.feature_of.empty()) sortFeatures(grid);
  std::vector<std::uint32_t> others;
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t)
    if (report.triangles[t].mesh != 0) others.push_back(t);
  report.lost = lostWater(report.gone, grid, others, plane, loop);
  return report;
}

}  // namespace coastmesh
