#include "apps/remesh/remesh_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "apps/job/available_memory.hpp"
#include "apps/job/judge_mesh.hpp"
#include "apps/job/places.hpp"
#include "apps/remesh/shore_near.hpp"
#include "core/quality.hpp"
#include "core/refine/bound_violations.hpp"
#include "core/refine/check.hpp"
#include "core/size/estimate_vertices.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/error.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/grid/linked_grid.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/projection/smooth_table.hpp"
#include "gis/remesh/remesh_patch.hpp"
#include "gis/size/node_sizes.hpp"

namespace coastmesh {

namespace {

// Bytes of the whole program for each vertex.
constexpr double kBytesPerVertex = 600.0;

double possibleVertices() { return std::min(static_cast<double>(kMostVertices), availableMemory() / kBytesPerVertex); }

// Throws InputError if more than two triangles, or two of opposite orientation, share an edge of a taken one.
void requireLinks(const Grid& grid, const std::vector<EdgeConflict>& conflicts,
                  const std::vector<std::uint8_t>& taken) {
  if (conflicts.empty()) return;
  std::vector<std::uint8_t> in_part(grid.nodes.size(), 0);
  for (std::size_t t = 0; t < taken.size(); ++t)
    if (taken[t] != 0)
      for (const std::uint32_t node : grid.triangles[t]) in_part[node] = 1;
  for (const EdgeConflict& edge : conflicts)
    if (in_part[edge.a] != 0 && in_part[edge.b] != 0)
      throw InputError("the edge between nodes " + std::to_string(edge.a + 1) + " and " + std::to_string(edge.b + 1) +
                       " at " + pointText(grid.nodes[edge.a]) +
                       ", in the part to be meshed anew, is not that of one or two triangles of one orientation: "
                       "check finds such edges");
}

// The new mesh of a patch, and what is known of it.
struct MeshedPatch {
  PatchMesh made;
  RimReach rim;
  bool has_shore = true;
  Shortfall short_of;
};

[[noreturn]] void refuse(const VertexDemand& demand, double most) {
  std::string text = "these sizes ask for about " + amount("%.2g", demand.vertices) + " vertices, most of them near " +
                     pointText(demand.place);
  if (std::isfinite(demand.size_m)) text += ", where " + demand.option + amount(" asks for %.3g m", demand.size_m);
  throw InputError(text + "; there is memory for about " + amount("%.2g", most) + ": request larger sizes");
}

class PatchMesher {
 public:
  PatchMesher(const Grid& grid, std::vector<NodePair> shore, const RemeshOptions& options, const SizeInputs& inputs,
              const RunControl& control, const ItemLoop& loop)
      : grid_(grid), shore_(std::move(shore)), options_(options), inputs_(inputs), control_(control), loop_(loop) {}

  MeshedPatch mesh(const RemeshPatch& patch) const {
    const Domain& domain = patch.domain;
    const Projection& projection = domain.projection;
    MeshedPatch result;
    try {
      const std::unique_ptr<SizeFunction> size = sizesOf(patch, result);
      MeshOptions options = options_.mesh;
      options.list_violations = false;
      options.refine.surface = projection.surface();
      options.refine.size = size.get();
      options.refine.most_in_memory = static_cast<std::uint64_t>(possibleVertices());
      if (std::isfinite(domain.resolution.grain)) options.refine.resolution = domain.resolution.grain;
      const RefineOptions asked = options.refine;
      MeshedRegion region = meshRegion(domain.pslg, std::move(options), {control_.cancelled, {}});
      const GroundPlaces ground = projection.groundPlaces(region.mesh.points, loop_);
      requireSound(region, patch);
      MeshJudgement judgement = judgeMesh(region.mesh, {projection, std::numeric_limits<double>::infinity()}, asked,
                                          0.0, ground.space, loop_);
      result.short_of = std::move(judgement.short_of);
      const SmoothTable table = measureTable(
          projection, ground.empty() ? std::span<const Point>(region.mesh.points) : std::span<const Point>(), loop_);
      result.made.size_m = nodeSizes(
          region.mesh, *size, options_.sizes.gradation,
          [&](VertexId v) { return ground.empty() ? table.at(region.mesh.points[v]).x : ground.measure[v]; },
          projection.surface(), loop_);
      result.made.mesh = std::move(region.mesh);
    } catch (const TooManyVertices& error) {
      refuse(error.demand, possibleVertices());
    } catch (const OutOfRoom& error) {
      throw InputError("the bounds on angles take more vertices than fit in memory, the last of them near " +
                       pointText(projection.inverse(error.place)));
    } catch (const BadPslg& error) {
      throw InputError(std::string("the part to be meshed anew has an outline that triangles cannot fill: ") +
                       error.what() + " at " + pointText(projection.inverse(error.defect.place)) +
                       "; check finds such places");
    }
    return result;
  }

 private:
  std::unique_ptr<SizeFunction> sizesOf(const RemeshPatch& patch, MeshedPatch& result) const {
    const double most = possibleVertices();
    SizeInputs inputs = inputs_;
    inputs.rim = patch.rim;
    inputs.shoreOf = [&](const Domain& domain, const SizeOptions& sizes, const ItemLoop&) {
      return shoreNear(grid_, shore_, domain, sizes);
    };
    DomainSizes sized = makeSizeFunction(options_.sizes, inputs, patch.domain, most, loop_);
    sized.demand.vertices +=
        verticesOfSegments(patch.domain.pslg, *sized.function, std::max(0.0, 2.0 * most - sized.demand.vertices),
                           patch.domain.projection.surface(), loop_);
    if (sized.demand.vertices > most) throw TooManyVertices(sized.demand);
    result.rim = sized.rim;
    result.has_shore = sized.has_shore;
    return std::move(sized.function);
  }

  void requireSound(const MeshedRegion& region, const RemeshPatch& patch) const {
    CheckOptions options;
    if (region.cover) options.cover = &*region.cover;
    std::vector<MeshDefect> defects = checkMesh(region.mesh, &patch.domain.pslg, options, loop_);
    // An edge that is to stay may still have been divided only by a mistake of ours.
    for (const Triangle& t : region.mesh.triangles)
      for (unsigned i = 0; i < 3; ++i)
        if (const SegmentId s = t.seg[i]; s < patch.domain.pslg.segments.size() && !mayDivide(patch.domain.pslg, s))
          if (t.v[next3(i)] >= patch.nodes.size() || t.v[prev3(i)] >= patch.nodes.size())
            defects.push_back({DefectKind::MissingSegment, patch.domain.pslg.points[patch.domain.pslg.segments[s].a]});
    if (defects.empty()) return;
    throw BadMesh("the new mesh of a part has " + std::to_string(defects.size()) + " defects, the first one " +
                  std::string(toString(defects.front().kind)) + " at " +
                  pointText(patch.domain.projection.inverse(defects.front().place)));
  }

  const Grid& grid_;
  std::vector<NodePair> shore_;
  const RemeshOptions& options_;
  const SizeInputs& inputs_;
  const RunControl& control_;
  const ItemLoop& loop_;
};

// Figures of the triangles for which `isWanted(t)`.
template <typename IsWanted>
TriangleFigures figuresOf(const Grid& grid, const ItemLoop& loop, const IsWanted& isWanted) {
  TriangleFigures all;
  for (const TriangleFigures& some :
       overStretches(loop, grid.triangles.size(), [&](std::size_t first, std::size_t last) {
         TriangleFigures figures;
         for (std::size_t t = first; t < last; ++t) {
           if (!isWanted(t)) continue;
           const auto [a, b, c] = localPlane(grid, grid.triangles[t]);
           figures.add({1, leastAngleDeg(a, b, c), std::min({distance(a, b), distance(b, c), distance(c, a)}),
                        std::max({distance(a, b), distance(b, c), distance(c, a)})});
         }
         return figures;
       }))
    all.add(some);
  return all;
}

// Sets the depths of new nodes from rasters.
DepthReport setNewDepths(Grid& grid, const ReplaceReport& replaced, const DepthOptions& options,
                         const RunControl& control, const ItemLoop& loop) {
  Grid part;
  part.crs = grid.crs;
  if (grid.z.empty()) grid.z.assign(grid.nodes.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<std::uint32_t> number(grid.nodes.size(), kNone), nodes;
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    if (replaced.triangles[t] != kNone) continue;
    auto& corners = part.triangles.emplace_back(grid.triangles[t]);
    for (std::uint32_t& node : corners) {
      if (number[node] == kNone) {
        number[node] = static_cast<std::uint32_t>(nodes.size());
        nodes.push_back(node);
        part.nodes.push_back(grid.nodes[node]);
        part.z.push_back(grid.z[node]);
      }
      node = number[node];
    }
  }
  DepthOptions own = options;
  own.keep_known = true;
  DepthReport report = setDepths(part, own, control, loop);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (replaced.nodes[nodes[i]] == kNone) grid.z[nodes[i]] = part.z[i];
  return report;
}

}  // namespace

void TriangleFigures::add(const TriangleFigures& other) {
  triangles += other.triangles;
  min_angle_deg = std::min(min_angle_deg, other.min_angle_deg);
  shortest_m = std::min(shortest_m, other.shortest_m);
  longest_m = std::max(longest_m, other.longest_m);
}

RemeshReport remeshGrid(Grid& grid, std::vector<std::uint8_t> taken, const RemeshOptions& options,
                        const RunControl& control, const ItemLoop& loop) {
  RemeshReport report;
  std::vector<RemeshPatch> patches;
  std::vector<MeshedPatch> meshed;
  {
    const LinkedGrid linked = linkGrid(grid, loop);
    if (options.tidy) report.tidied = tidyCut(linked.mesh, taken, loop);
    requireLinks(grid, linked.conflicts, taken);
    patches = patchesOf(grid, linked.mesh, taken, loop);
    const SizeInputs inputs = readSizeInputs(options.sizes, grid.crs);
    const PatchMesher mesher(grid, shoreEdges(grid, linked.mesh), options, inputs, control, loop);
    meshed.resize(patches.size());
    forItems(loop, patches.size(), [&](std::size_t p) { meshed[p] = mesher.mesh(patches[p]); });
  }
  report.patches = patches.size();
  std::vector<PatchMesh> made;
  double triangles = 0.0, changed = 0.0;
  report.has_shore = false;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    report.whole_edges += patches[p].rim.size() - patches[p].shared_edges;
    report.rim.width_m = std::max(report.rim.width_m, meshed[p].rim.width_m);
    const auto count = static_cast<double>(meshed[p].made.mesh.triangles.size());
    triangles += count;
    changed += meshed[p].rim.share * count;
    report.has_shore = report.has_shore || meshed[p].has_shore;
    report.below_bounds += meshed[p].short_of.count;
    for (const BoundViolationPlace& below : meshed[p].short_of.places)
      if (!report.worst_below || below.min_angle_deg < report.worst_below->min_angle_deg) report.worst_below = below;
    made.push_back(std::move(meshed[p].made));
  }
  report.rim.share = changed / triangles;
  report.replaced = replacePatches(grid, patches, std::move(made), loop);
  if (!options.depth.files.empty()) report.depth = setNewDepths(grid, report.replaced, options.depth, control, loop);
  const std::vector<std::uint32_t>& sources = report.replaced.triangles;
  report.inside = figuresOf(grid, loop, [&](std::size_t t) { return sources[t] == kNone; });
  report.outside = figuresOf(grid, loop, [&](std::size_t t) { return sources[t] != kNone; });
  return report;
}

}  // namespace coastmesh
