#include "apps/usage/merge_usage.hpp"

#include "apps/usage/finish_usage.hpp"
#include "apps/usage/grid_usage.hpp"
#include "apps/usage/target_usage.hpp"

namespace coastmesh {

void declareMergeOptions(OptionTable& table, MergeUsage& usage) {
  declareAssumedCrs(table, usage.mesh.crs);
  MergeOptions& merge = usage.job.merge;
  RefineOptions& refine = merge.mesh.refine;
  table.section(Section::Triangles);
  table.number({"--min-angle", "Minimum angle"}, refine.min_angle_deg, "DEG", {0.0, 45.0},
               "minimum angle of the new triangles between the meshes");
  table.number({"--max-angle", "Maximum angle"}, refine.max_angle_deg, "DEG", {60.0, 180.0},
               "maximum angle of the new triangles; 180: no limit");
  table.section(Section::Sizes);
  table.number({"--grade", "Gradation of sizes"}, merge.gradation, "G", {0.0, 1.0, true},
               "between the meshes, sizes at two places differ by at most this times their distance: a smaller number "
               "replaces more triangles of MESH");
  declareDepths(table, merge.depth,
                "raster with the depths of new nodes; can be repeated, the first with a value at a node is used; "
                "without one, depths are linear between nodes of the meshes");
  declareTargets(table, usage.job.finish.targets,
                 "repair what the model would reject, in all of the mesh, and report each repair; can be repeated");
}

}  // namespace coastmesh
