#pragma once

#include <cstdint>
#include <string>

#include "apps/job/mesh_job.hpp"
#include "apps/usage/option_table.hpp"
#include "apps/usage/sizing_usage.hpp"

namespace coastmesh {

// What a job of meshing is given, whoever gives it: the program or Python.
struct MeshUsage {
  MeshJob job;
  SizingUsage sizing;
  std::string algorithm = "relocate";
  std::string quality = "shape";
  bool coarsen_given = false;
  bool max_angle_given = false;
  bool cut = true;
  std::uint64_t threads = 0;
};

// Declares its options, bound to `usage`, which must outlive the table.
void declareMeshOptions(OptionTable& table, MeshUsage& usage);

// Once all is set: makes `usage.job` what the options say.
void settle(MeshUsage& usage);

}  // namespace coastmesh
