#include "apps/usage/remesh_usage.hpp"

#include <cmath>

#include "apps/usage/finish_usage.hpp"
#include "apps/usage/grid_usage.hpp"
#include "apps/usage/part_usage.hpp"
#include "apps/usage/target_usage.hpp"
#include "gis/error.hpp"

namespace coastmesh {

void declareRemeshOptions(OptionTable& table, RemeshUsage& usage) {
  declareAssumedCrs(table, usage.mesh.crs);
  declarePart(table, usage.job.region, {"replace", "keep, except for a few at the edge of the part that angles need,"});
  RemeshOptions& remesh = usage.job.remesh;
  RefineOptions& refine = remesh.mesh.refine;
  table.section(Section::Triangles);
  table.number({"--min-angle", "Minimum angle"}, refine.min_angle_deg, "DEG", {0.0, 45.0},
               "minimum angle of the new triangles");
  table.number({"--max-angle", "Maximum angle"}, refine.max_angle_deg, "DEG", {60.0, 180.0},
               "maximum angle of the new triangles; 180: no limit");
  const SizeHelp help{"no size is smaller, except where triangles around the part are",
                      "no size is larger, except where triangles around the part are",
                      "no element is smaller than --courant allows for this time step, except where triangles around "
                      "the part are; 0: not used"};
  declareSizes(table, remesh.sizes, usage.sizing, help, [] { return SizeChoice::None; });
  declareDepths(table, remesh.depth,
                "raster with the depths of new nodes; can be repeated, the first with a value at a node is used; "
                "without one, depths are linear between nodes of MESH");
  declareTargets(table, usage.job.finish.targets,
                 "repair what the model would reject, in all of the mesh, and report each repair; can be repeated");
}

std::vector<std::string> settle(RemeshUsage& usage) {
  requirePart(usage.job.region, RemeshJob::kPurpose);
  SizeOptions& sizes = usage.job.remesh.sizes;
  if (!sizes.any() && !std::isfinite(sizes.most_m))
    throw OptionError("nothing says how large the new triangles should be: give --size, or others");
  settleSizing(usage.sizing, usage.job.remesh.depth, SizeChoice::None, sizes);
  return notesOnOverriddenSizes(usage.sizing, sizes);
}

}  // namespace coastmesh
