#include "gis/weirs/open_weirs.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "core/quality.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/grid/linked_grid.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/places.hpp"
#include "gis/weirs/weir_cuts.hpp"
#include "gis/weirs/weir_gaps.hpp"

namespace coastmesh {
namespace {

constexpr int kInternalBarrier = 24;  // ADCIRC's type: water flows over it as a natural condition

struct LineCrest {
  WeirCrest crest;
  bool runs_back = false;  // the grid's line runs against that of the input
};
using Crests = std::map<std::uint32_t, LineCrest>;  // by line

std::string lineInWords(const Grid& grid, const GridLine& line) {
  return (line.name.empty() ? "the weir" : "weir '" + line.name + "'") + " from " +
         roughPlaceInWords(grid.nodes[line.nodes.front()]);
}

// The crests of the weirs that have one.
Crests crestsOf(const Grid& grid, const std::vector<WeirSource>& sources, WeirReport& report) {
  Crests crests;
  for (std::uint32_t l = 0; l < grid.lines.size(); ++l) {
    const GridLine& line = grid.lines[l];
    if (line.kind != LineKind::Weir) continue;
    const WeirSource* const source = sourceOf(grid, line, sources);
    if (source != nullptr && source->crest)
      crests.emplace(l, LineCrest{*source->crest, !runsAsSource(grid, line, *source)});
    else
      report.warnings.push_back(lineInWords(grid, line) + " stays edges of the mesh: it has no attribute '" +
                                kWeirHeight + "', in metres, for ADCIRC");
  }
  return crests;
}

class WeirOpening {
 public:
  WeirOpening(Grid& grid, const TriMesh& mesh, const WeirCuts& cuts, const Crests& crests)
      : grid_(grid), mesh_(mesh), cuts_(cuts), crests_(crests), before_(grid) {
    for (std::uint32_t node = 0; node < grid.nodes.size(); ++node) origin_.push_back(node);
    for (const WeirRun& run : cuts.runs)
      for (const EdgeRef e : run.edges) of_weirs_.insert(edgeKey(mesh.origin(e), mesh.target(e)));
  }

  void run(double min_angle_deg, const ItemLoop& loop, WeirReport& report) {
    takeLinesOut();
    divideNodes();
    for (const auto& [node, sectors] : cuts_.sectors)
      moveApart(grid_, sectors, nodes_of_.at(node), min_angle_deg, report.gaps);
    reassembleBoundaries(loop);
    for (const WeirRun& run : cuts_.runs) addBoundary(run, report);
    std::ranges::stable_sort(grid_.boundaries, {}, [](const Boundary& boundary) {
      return !boundary.weir.empty() ? 2 : boundary.role == BoundaryRole::Island ? 1 : 0;
    });
    measureAgain(loop);
    report.walls += cuts_.line_of.size() - of_weirs_.size();
  }

 private:
  // The edges that are cut belong to no line any more.
  void takeLinesOut() {
    std::vector<GridLine> left;
    for (GridLine& line : grid_.lines) {
      std::vector<NodePair> edges = edgesOf(line);
      const auto isCut = [this](const NodePair& edge) { return cuts_.line_of.contains(edgeKey(edge[0], edge[1])); };
      if (std::ranges::none_of(edges, isCut)) {
        left.push_back(std::move(line));
        continue;
      }
      std::erase_if(edges, isCut);
      std::ranges::move(linesAlong(edges, line.kind, line.name), std::back_inserter(left));
    }
    grid_.lines = std::move(left);
  }

  void divideNodes() {
    for (const auto& [node, sectors] : cuts_.sectors) {
      std::vector<std::uint32_t>& nodes = nodes_of_[node];
      nodes.push_back(node);
      for (std::size_t s = 1; s < sectors.size(); ++s) {
        const Point place = grid_.nodes[node];
        nodes.push_back(detachTriangles(grid_, node, sectors[s].triangles, place));
        origin_.push_back(node);
      }
    }
  }

  void reassembleBoundaries(const ItemLoop& loop) {
    const auto kindOf = [this](std::uint32_t a, std::uint32_t b) -> BoundaryKind {
      const NodePair key = edgeKey(origin_[a], origin_[b]);
      if (of_weirs_.contains(key)) return {BoundaryRole::Land, kInternalBarrier};
      return cuts_.line_of.contains(key) ? BoundaryKind{} : before_.forCutting(key[0], key[1]);
    };
    grid_.boundaries = cutLoops(grid_, boundaryLoops(grid_, loop), kindOf);
    std::erase_if(grid_.boundaries, [](const Boundary& boundary) { return boundary.ibtype == kInternalBarrier; });
  }

  // The present nodes of an edge of the mesh before.
  NodePair present(EdgeRef e) const {
    const GridCorners& v = grid_.triangles[triOf(e)];
    return {v[next3(indexOf(e))], v[prev3(indexOf(e))]};
  }

  const WeirCrest& crestOf(EdgeRef e) const {
    return crests_.at(cuts_.line_of.at(edgeKey(mesh_.origin(e), mesh_.target(e)))).crest;
  }

  void addBoundary(const WeirRun& run, WeirReport& report) {
    Boundary& weir = grid_.boundaries.emplace_back(Boundary{BoundaryRole::Land, false, {}, kInternalBarrier});
    const std::size_t count = run.edges.size();
    for (std::size_t i = 0; i <= count; ++i) {
      const EdgeRef after = run.edges[run.closed ? i % count : std::min(i, count - 1)];
      const EdgeRef before = run.edges[i > 0 ? i - 1 : run.closed ? count - 1 : 0];
      const bool is_end = i == count && !run.closed;
      weir.nodes.push_back(present(after)[is_end ? 1 : 0]);
      weir.back_nodes.push_back(present(mesh_.twin(after))[is_end ? 0 : 1]);
      const bool first_is_higher = crestOf(before).height_m > crestOf(after).height_m;
      const WeirCrest& crest = crestOf(first_is_higher ? before : after);
      weir.weir.insert(weir.weir.end(), {crest.height_m, crest.subcritical, crest.supercritical});
    }
    ++report.boundaries;
    report.pairs += run.closed ? count : count + 1;
  }

  void measureAgain(const ItemLoop& loop) {
    std::set<std::uint32_t> changed;
    for (const auto& [node, sectors] : cuts_.sectors)
      for (const NodeSector& sector : sectors) changed.insert(sector.triangles.begin(), sector.triangles.end());
    std::vector<GridCorners> corners;
    for (const std::uint32_t t : changed) {
      corners.push_back(grid_.triangles[t]);
      const auto [a, b, c] = localPlane(grid_, grid_.triangles[t]);
      if (!grid_.min_angle_deg.empty()) grid_.min_angle_deg[t] = leastAngleDeg(a, b, c);
    }
    if (grid_.area_m2.empty()) return;
    const std::vector<double> areas = areasOfFew(grid_.nodes, corners, grid_.crs, loop);
    for (std::size_t k = 0; const std::uint32_t t : changed) grid_.area_m2[t] = areas[k++];
  }

  Grid& grid_;
  const TriMesh& mesh_;  // before
  const WeirCuts& cuts_;
  const Crests& crests_;
  const EdgeKinds before_;
  std::set<NodePair> of_weirs_;                                   // edges that water flows over, by the nodes before
  std::vector<std::uint32_t> origin_;                             // by node: the one before
  std::map<std::uint32_t, std::vector<std::uint32_t>> nodes_of_;  // of each divided node: those of its sectors
};

}  // namespace

WeirReport openWeirs(Grid& grid, const std::vector<WeirSource>& sources, double min_angle_deg, const ItemLoop& loop) {
  WeirReport report;
  if (sources.empty()) return report;
  const Crests crests = crestsOf(grid, sources, report);
  if (crests.empty()) return report;
  std::vector<std::uint32_t> lines;
  for (const auto& [line, crest] : crests) {
    lines.push_back(line);
    if (crest.runs_back) std::ranges::reverse(grid.lines[line].nodes);
  }
  const TriMesh mesh = linkGrid(grid, loop).mesh;
  std::vector<ClosedLine> closed;
  const WeirCuts cuts = planWeirCuts(grid, mesh, std::move(lines), closed);
  for (const auto& [line, place, why] : closed)
    report.warnings.push_back(lineInWords(grid, grid.lines[line]) + " stays edges of the mesh at " +
                              roughPlaceInWords(place) + ": " + why);
  if (cuts.line_of.empty()) return report;
  std::set<std::string> names;
  for (const auto& [edge, line] : cuts.line_of) names.insert(grid.lines[line].name);
  report.names.assign(names.begin(), names.end());
  WeirOpening(grid, mesh, cuts, crests).run(min_angle_deg, loop, report);
  requireConsistent(grid, loop);
  return report;
}

}  // namespace coastmesh
