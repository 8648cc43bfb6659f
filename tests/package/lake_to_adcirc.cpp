// Makes a grid for ADCIRC from a lake and a raster of its depths: smaller elements at the shore, depths at the nodes.
// usage: lake_to_adcirc LAKE DEM OUTPUT
#include <cstdio>
#include <exception>

#include "apps/job/mesh_job.hpp"
#include "gis/format/grid_io.hpp"

int main(int argc, char** argv) {
  using namespace coastmesh;
  if (argc != 4) return 2;
  MeshJob job;
  job.input.files = {argv[1]};
  job.sizes.shore_m = 4000;
  job.sizes.most_m = 20000;
  job.sizes.coast = CoastDetail::Follow;
  job.mesh.refine.min_angle_deg = 30;
  job.finish.depth.files = {argv[2]};
  job.finish.depth.min_depth_m = 2;
  job.finish.targets = {"adcirc"};
  JobControl control;
  control.progress = [](std::string_view phase, double share) {
    std::fprintf(stderr, "%.*s %.0f %%\n", static_cast<int>(phase.size()), phase.data(), 100 * share);
  };
  try {
    const MeshJobResult result = runMeshJob(job, control);
    StagedOutput output(argv[3], gridFormatFor(argv[3]), true);
    output.write(result.grid);
    output.commit();
    std::printf("%zu nodes, %zu triangles, depths from %g to %g m\n", result.grid.nodes.size(),
                result.grid.triangles.size(), result.finish.depth.least_m, result.finish.depth.greatest_m);
    return result.complete() && result.finish.depth.least_m >= 2 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
