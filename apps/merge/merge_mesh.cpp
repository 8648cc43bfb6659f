#include "apps/merge/merge_mesh.hpp"

#include <limits>
#include <utility>
#include <vector>

#include "gis/elements/measure_unknown.hpp"
#include "gis/elements/quads.hpp"
#include "gis/merge/seam_band.hpp"

namespace coastmesh {

namespace {

constexpr double kUnmeasured = std::numeric_limits<double>::quiet_NaN();

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

// The other mesh gets the values that the grid has, to be measured.
void addMeasures(const Grid& grid, Grid& inserted) {
  const auto add = [&](auto& values, const auto& given) {
    if (values.empty() && !given.empty()) values.assign(inserted.triangles.size(), kUnmeasured);
  };
  add(inserted.min_angle_deg, grid.min_angle_deg);
  add(inserted.area_m2, grid.area_m2);
}

// Triangles of the gap have those of others.
void unmeasureGap(Grid& grid, const std::vector<MergeSource>& sources) {
  for (auto* values : {&grid.min_angle_deg, &grid.area_m2})
    for (std::size_t t = 0; t < values->size(); ++t)
      if (sources[t].mesh == kNone) (*values)[t] = kUnmeasured;
}

}  // namespace

MergedMesh mergeMesh(Grid& grid, Grid&& inserted, const MergeOptions& options, const RunControl& control,
                     const ItemLoop& loop) {
  MergedMesh result;
  addMeasures(grid, inserted);
  result.merged = mergeGrids(grid, std::move(inserted), loop);
  unmeasureGap(grid, result.merged.triangles);
  SeamBand band = seamBand(grid, result.merged, options.gradation, loop);
  keepQuads(grid, band);
  if (band.triangles == 0) {
    measureUnknown(grid, loop);
    result.nodes = result.merged.nodes;
    result.triangles = result.merged.triangles;
    return result;
  }
  RemeshOptions remesh;
  remesh.sizes.most_m = band.largest;
  remesh.sizes.gradation = options.gradation;
  remesh.mesh = options.mesh;
  remesh.depth = options.depth;
  remesh.before = &result.merged.gone;
  for (const MergeSource& source : result.merged.triangles) remesh.stay.push_back(source.mesh == 1 ? 1 : 0);
  result.band = remeshGrid(grid, std::move(band.taken), remesh, control, loop);
  measureUnknown(grid, loop);
  result.replaced = result.band->replaced.triangles_removed - result.merged.gap;
  result.nodes = sourcesAfter(result.merged.nodes, result.band->replaced.nodes);
  result.triangles = sourcesAfter(result.merged.triangles, result.band->replaced.triangles);
  return result;
}

}  // namespace coastmesh
