#include "gis/cut/cut_grid.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "core/bulk_list.hpp"
#include "core/union_find.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/cut/cut_boundaries.hpp"
#include "gis/elements/quads.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/linked_grid.hpp"

namespace coastmesh {

namespace {

// The first triangle of each water among the taken triangles, and for each triangle that of its water.
struct Waters {
  BulkList<std::uint32_t> of;
  std::vector<std::uint32_t> firsts;
};

Waters watersOf(const TriMesh& mesh, const std::vector<std::uint8_t>& taken, const ItemLoop& loop) {
  const std::size_t triangles = mesh.triangles.size();
  SharedUnionFind sets(triangles, loop);
  forEachByStretches(loop, triangles, [&](std::size_t t) {
    for (const EdgeRef across : mesh.triangles[t].adj)
      if (taken[t] != 0 && across != kNone && taken[triOf(across)] != 0)
        sets.unite(static_cast<std::uint32_t>(t), triOf(across));
  });
  Waters waters{unsetList<std::uint32_t>(triangles), {}};
  waters.firsts = joined(overStretches(loop, triangles, [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> firsts;
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
      waters.of[t] = sets.find(t);
      if (taken[t] != 0 && waters.of[t] == t) firsts.push_back(t);
    }
    return firsts;
  }));
  return waters;
}

// The largest by area; of equal ones the first.
std::uint32_t largestOf(const Waters& waters, const Grid& grid, const std::vector<std::uint8_t>& taken,
                        const ItemLoop& loop) {
  BulkList<double> measured;
  if (grid.area_m2.empty()) measured = triangleAreas(grid.nodes, grid.triangles, grid.crs, loop);
  const BulkList<double>& areas = grid.area_m2.empty() ? measured : grid.area_m2;
  std::map<std::uint32_t, double> area_of;
  for (std::uint32_t t = 0; t < taken.size(); ++t)
    if (taken[t] != 0) area_of[waters.of[t]] += areas[t];
  const auto smaller = [](const auto& a, const auto& b) { return a.second < b.second; };
  return std::ranges::max_element(area_of, smaller)->first;
}

// The old index of each new item.
std::vector<std::uint32_t> sourcesOf(const std::vector<std::uint32_t>& index_of) {
  std::vector<std::uint32_t> sources;
  for (std::uint32_t i = 0; i < index_of.size(); ++i)
    if (index_of[i] != kNone) sources.push_back(i);
  return sources;
}

void setBoundaries(Grid& grid, CutBoundaries&& found, CutReport& report) {
  report.boundaries_kept = found.kept.size();
  report.boundaries_cut = found.cuts.size();
  report.walls = found.walls.size();
  report.stray_edges = found.stray_edges;
  grid.boundaries = std::move(found.kept);
  std::ranges::move(found.walls, std::back_inserter(grid.boundaries));
  std::ranges::move(found.cuts, std::back_inserter(grid.boundaries));
}

}  // namespace

CutReport cutGrid(Grid& grid, std::vector<std::uint8_t> taken, const CutOptions& options, const ItemLoop& loop) {
  CutReport report;
  report.nodes_before = grid.nodes.size();
  report.triangles_before = grid.triangles.size();
  {
    const TriMesh mesh = linkGrid(grid, loop).mesh;
    includeOtherHalves(grid, taken);
    const std::vector<std::uint32_t> other_half = otherHalves(grid);
    const std::optional<EvenedCut> evened = evenCut(mesh, other_half, taken, loop);
    report.evened = evened.value_or(EvenedCut{});
    report.tidied = (evened ? tidyEvenCut : tidyCut)(mesh, other_half, taken, loop);
    const Waters waters = watersOf(mesh, taken, loop);
    report.waters = waters.firsts.size();
    if (options.largest_water && report.waters > 1) {
      const std::uint32_t largest = largestOf(waters, grid, taken, loop);
      for (std::uint32_t t = 0; t < taken.size(); ++t)
        if (waters.of[t] != largest) taken[t] = 0;
      report.left_out = report.waters - 1;
    }
    setBoundaries(grid, boundariesOfPart(grid, mesh, taken, options.cut_role, loop), report);
  }
  std::vector<bool> gone(taken.size());
  for (std::size_t t = 0; t < taken.size(); ++t) gone[t] = taken[t] == 0;
  report.triangles = sourcesOf(removeTriangles(grid, gone));
  report.nodes = sourcesOf(removeUnusedNodes(grid));
  if (!grid.feature_of.empty()) sortFeatures(grid);
  report.partition_dropped = !grid.part_of.empty() || !grid.node_part_of.empty();
  grid.part_of.clear();
  grid.node_part_of.clear();
  grid.notes.clear();
  return report;
}

}  // namespace coastmesh
