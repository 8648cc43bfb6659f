#include "apps/merge/merge_mesh.hpp"

#include <utility>

#include "gis/elements/quads.hpp"
#include "gis/merge/seam_band.hpp"

namespace coastmesh {

namespace {

std::vector<MergeSource> sourcesAfter(const std::vector<MergeSource>& before,
                                      const std::vector<std::uint32_t>& number_before) {
  std::vector<MergeSource> sources;
  sources.reserve(number_before.size());
  for (const std::uint32_t number : number_before) sources.push_back(number == kNone ? MergeSource{} : before[number]);
  return sources;
}

// Quadrilaterals stay where they are not covered.
void keepQuads(const Grid& grid, SeamBand& band) {
  for (const Quad& quad : quadsOf(grid))
    for (const std::uint32_t t : quad.halves) {
      band.triangles -= band.taken[t];
      band.taken[t] = 0;
    }
}

}  // namespace

MergedMesh mergeMesh(Grid& grid, Grid&& inserted, const MergeOptions& options, const RunControl& control,
                     const ItemLoop& loop) {
  MergedMesh result;
  result.merged = mergeGrids(grid, std::move(inserted), loop);
  SeamBand band = seamBand(grid, result.merged, options.gradation, loop);
  keepQuads(grid, band);
  if (band.triangles == 0) {
    result.nodes = result.merged.nodes;
    result.triangles = result.merged.triangles;
    return result;
  }
  RemeshOptions remesh;
  remesh.sizes.most_m = band.largest;
  remesh.sizes.gradation = options.gradation;
  remesh.mesh = options.mesh;
  remesh.depth = options.depth;
  for (const MergeSource& source : result.merged.triangles) remesh.stay.push_back(source.mesh == 1 ? 1 : 0);
  result.band = remeshGrid(grid, std::move(band.taken), remesh, control, loop);
  result.replaced = result.band->replaced.triangles_removed - result.merged.gap;
  result.nodes = sourcesAfter(result.merged.nodes, result.band->replaced.nodes);
  result.triangles = sourcesAfter(result.merged.triangles, result.band->replaced.triangles);
  return result;
}

}  // namespace coastmesh
