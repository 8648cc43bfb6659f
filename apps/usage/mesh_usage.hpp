#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "apps/job/mesh_job.hpp"
#include "apps/usage/option_table.hpp"
#include "apps/usage/sizing_usage.hpp"

namespace coastmesh {

// The options of a meshing job, set by the program or by Python.
struct MeshUsage {
  MeshJob job;
  SizingUsage sizing;
  std::string algorithm = "relocate";
  std::string quality = "shape";
  bool coarsen_given = false;
  bool max_angle_given = false;
  double flood_height_m = std::numeric_limits<double>::infinity();  // no flood plain
  bool cut = true;
  std::uint64_t threads = 0;
};

// Declares its options, bound to `usage`, which must outlive the table.
void declareMeshOptions(OptionTable& table, MeshUsage& usage);

// To be called once all is set: completes `usage.job` from the options. Throws OptionError.
void settle(MeshUsage& usage);

}  // namespace coastmesh
