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

// Divides lines without a height of their own where the rasters' crests begin and end.
void divideAtCrests(Grid& grid, const std::vector<WeirSource>& sources, const RasterCrests& rasters) {
  std::vector<GridLine> lines;
  for (GridLine& line : grid.lines) {
    const WeirSource* const source = line.kind == LineKind::Weir ? sourceOf(grid, line, sources) : nullptr;
    std::vector<NodePair> edges = edgesOf(line);
    const auto unknown = std::ranges::stable_partition(
        edges, [&](const NodePair& edge) { return rasters.of_edges.contains(edgeKey(edge[0], edge[1])); });
    if (source == nullptr || source->crest.height_m || unknown.empty() || unknown.size() == edges.size()) {
      lines.push_back(std::move(line));
      continue;
    }
    for (const auto& some : {std::vector(edges.begin(), unknown.begin()), std::vector(unknown.begin(), edges.end())})
      std::ranges::move(linesAlong(some, line.kind, line.name), std::back_inserter(lines));
  }
  grid.lines = std::move(lines);
}

// The crests of the weirs that have one.
Crests crestsOf(const Grid& grid, const std::vector<WeirSource>& sources, const RasterCrests& rasters,
                WeirReport& report) {
  Crests crests;
  for (std::uint32_t l = 0; l < grid.lines.size(); ++l) {
    const GridLine& line = grid.lines[l];
    if (line.kind != LineKind::Weir) continue;
    const WeirSource* const source = sourceOf(grid, line, sources);
    const bool in_rasters = rasters.of_edges.contains(edgeKey(line.nodes[0], line.nodes[1]));
    if (source != nullptr && (source->crest.height_m || in_rasters))
      crests.emplace(l, LineCrest{source->crest, !runsAsSource(grid, line, *source)});
    else if (!rasters.searched)
      report.warnings.push_back(lineInWords(grid, line, nullptr) + " stays edges of the mesh: it has no attribute '" +
                                kWeirHeight + "', in metres, for ADCIRC; --weir-heights takes crests from a raster");
  }
  return crests;
}

// The crest at an end of an edge.
struct EndCrest {
  WeirCrest crest;
  double height_m = 0.0;
  bool of_raster = false;
};

// The crest of a pair of nodes between two edges: where a raster has both, water passes over the lower one, as it does
// within an edge; lines with heights of their own end there.
const EndCrest& crestBetween(const EndCrest& before, const EndCrest& after) {
  if (before.of_raster && after.of_raster) return before.height_m < after.height_m ? before : after;
  return before.height_m > after.height_m ? before : after;
}

class WeirOpening {
 public:
  WeirOpening(Grid& grid, const TriMesh& mesh, const WeirCuts& cuts, const Crests& crests, const RasterCrests& rasters)
      : grid_(grid), mesh_(mesh), cuts_(cuts), crests_(crests), rasters_(rasters), before_(grid) {
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

  EndCrest crestAt(EdgeRef e, bool at_target) const {
    const NodePair key = edgeKey(mesh_.origin(e), mesh_.target(e));
    const WeirCrest& crest = crests_.at(cuts_.line_of.at(key)).crest;
    if (crest.height_m) return {crest, *crest.height_m, false};
    const std::uint32_t node = at_target ? mesh_.target(e) : mesh_.origin(e);
    return {crest, rasters_.of_edges.at(key)[node == key[0] ? 0 : 1], true};
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
      const EndCrest of_before = crestAt(i == 0 && !run.closed ? after : before, i > 0 || run.closed);
      const EndCrest of_after = is_end ? of_before : crestAt(after, false);
      const EndCrest& chosen = crestBetween(of_before, of_after);
      weir.weir.insert(weir.weir.end(), {chosen.height_m, chosen.crest.subcritical, chosen.crest.supercritical});
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
  const RasterCrests& rasters_;
  const EdgeKinds before_;
  std::set<NodePair> of_weirs_;                                   // edges that water flows over, by the nodes before
  std::vector<std::uint32_t> origin_;                             // by node: the one before
  std::map<std::uint32_t, std::vector<std::uint32_t>> nodes_of_;  // of each divided node: those of its sectors
};

}  // namespace

WeirReport openWeirs(Grid& grid, const std::vector<WeirSource>& sources, double min_angle_deg, const ItemLoop& loop,
                     const RasterCrests& rasters) {
  WeirReport report;
  if (sources.empty()) return report;
  if (!rasters.of_edges.empty()) divideAtCrests(grid, sources, rasters);
  const Crests crests = crestsOf(grid, sources, rasters, report);
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
    report.warnings.push_back(lineInWords(grid, grid.lines[line], nullptr) + " stays edges of the mesh at " +
                              roughPlaceInWords(place) + ": " + why);
  if (cuts.line_of.empty()) return report;
  std::set<std::string> names;
  for (const auto& [edge, line] : cuts.line_of) names.insert(grid.lines[line].name);
  report.names.assign(names.begin(), names.end());
  WeirOpening(grid, mesh, cuts, crests, rasters).run(min_angle_deg, loop, report);
  requireConsistent(grid, loop);
  return report;
}

}  // namespace coastmesh
