#include "apps/remesh/mesh_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "apps/job/judge_mesh.hpp"
#include "apps/remesh/shore_near.hpp"
#include "core/refine/check.hpp"
#include "core/size/estimate_vertices.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/error.hpp"
#include "gis/places.hpp"
#include "gis/projection/smooth_table.hpp"
#include "gis/size/node_sizes.hpp"
#include "parallel/available_memory.hpp"

namespace coastmesh {

namespace {

// Bytes of the whole program for each vertex.
constexpr double kBytesPerVertex = 600.0;

double possibleVertices() { return std::min(static_cast<double>(kMostVertices), availableMemory() / kBytesPerVertex); }

[[noreturn]] void refuse(const VertexDemand& demand, double most) {
  std::string text = "these sizes ask for about " + roundAmount(demand.vertices, 2) + " vertices, most of them near " +
                     pointText(demand.place);
  if (std::isfinite(demand.size_m))
    text += ", where " + demand.option + " asks for " + roundAmount(demand.size_m, 3) + " m";
  throw InputError(text + "; there is memory for about " + roundAmount(most, 2) + ": request larger sizes");
}

void requireSound(const MeshedRegion& region, const RemeshPatch& patch, const ItemLoop& loop) {
  CheckOptions options;
  if (region.cover) options.cover = &*region.cover;
  std::vector<MeshDefect> defects = checkMesh(region.mesh, &patch.domain.pslg, options, loop);
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

}  // namespace

PatchMesher::PatchMesher(const Grid& grid, const TriMesh& links, const RemeshOptions& options, const SizeInputs& inputs,
                         const ItemLoop& loop)
    : grid_(grid),
      shore_(shoreEdges(grid, links)),
      coast_(coastEdges(grid, links)),
      options_(options),
      inputs_(inputs),
      loop_(loop) {}

void PatchMesher::setCoast(Domain& domain) const {
  if (coast_.empty() || !std::isfinite(options_.sizes.shore_m)) return;
  const Pslg coast = edgesNear(grid_, coast_, domain, options_.sizes);
  for (const Segment& s : coast.segments) domain.coast.emplace_back(coast.points[s.a], coast.points[s.b]);
}

MeshedPatch PatchMesher::mesh(const RemeshPatch& patch, const RunControl& control) const {
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
    MeshedRegion region = meshRegion(domain.pslg, std::move(options), control);
    const GroundPlaces ground = projection.groundPlaces(region.mesh.points, loop_);
    requireSound(region, patch, loop_);
    MeshJudgement judgement =
        judgeMesh(region.mesh, {projection, std::numeric_limits<double>::infinity()}, asked, 0.0, ground.space, loop_);
    result.short_of = std::move(judgement.short_of);
    const SmoothTable table = measureTable(
        projection, ground.empty() ? std::span<const Point>(region.mesh.points) : std::span<const Point>(), loop_);
    result.made.size_m = nodeSizes(
        region.mesh, *size, options_.sizes.gradation,
        [&](VertexId v) { return ground.empty() ? table.at(region.mesh.points[v]).x : ground.measure[v]; },
        projection.surface(), loop_);
    result.at_rim = rimShortfall(patch, region.mesh, asked);
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

std::unique_ptr<SizeFunction> PatchMesher::sizesOf(const RemeshPatch& patch, MeshedPatch& result) const {
  const double most = possibleVertices();
  SizeInputs inputs = inputs_;
  inputs.rim = patch.rim;
  inputs.shoreOf = [&](const Domain& domain, const SizeOptions& sizes, const ItemLoop&) {
    return edgesNear(grid_, shore_, domain, sizes);
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

}  // namespace coastmesh
