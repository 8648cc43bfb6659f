#pragma once

#include <string>
#include <vector>

#include "apps/job/mesh_job_options.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/grid/grid.hpp"
#include "gis/size/size_source.hpp"

namespace coastmesh {

// A warning for each file that was given for sizes, passages, barriers, constraints, weirs or regions and has nothing
// where the mesh lies: mostly it is in another CRS than it says, or of another place; and for each band of depths that
// the mesh has none of.
std::vector<std::string> warningsOfIdleInputs(const MeshJob& job, const SizeInputs& sizes, const Coastline& coastline,
                                              const Grid& grid);

}  // namespace coastmesh
