#include "apps/usage/cut_usage.hpp"

#include <string>

#include "apps/usage/grid_usage.hpp"
#include "apps/usage/part_usage.hpp"
#include "apps/usage/target_usage.hpp"

namespace coastmesh {

void declareCutOptions(OptionTable& table, CutUsage& usage) {
  declareAssumedCrs(table, usage.mesh.crs);
  declarePart(table, usage.job.region, {"keep", "leave out"});
  CutOptions& cut = usage.job.cut;
  table.choice(
      {"--keep-water", "Waters to keep"}, "all", {"largest", "all"},
      [&cut](const std::string& chosen) { cut.largest_water = chosen == "largest"; },
      "which parts of the water to keep if the cut divides it");
  table.section(Section::Boundaries);
  table.choice(
      {"--cut-boundary", "Type of the cut"}, "open", {"open", "land"},
      [&cut](const std::string& chosen) { cut.cut_role = chosen == "land" ? BoundaryRole::Land : BoundaryRole::Open; },
      "type of the boundaries along the cut; all others keep theirs");
  declareTargets(table, usage.job.finish.targets,
                 "repair what the model would reject, and report each repair; can be repeated");
}

void settle(CutUsage& usage) { requirePart(usage.job.region, CutJob::kPurpose); }

}  // namespace coastmesh
