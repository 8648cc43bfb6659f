#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/job/mesh_job.hpp"
#include "apps/usage/command_line.hpp"
#include "apps/usage/sizing_usage.hpp"

namespace coastmesh {

// What `coastmesh mesh` is given.
struct MeshUsage {
  MeshJob job;
  std::vector<std::string> outputs;
  std::string format;
  SizingUsage sizing;
  std::string algorithm = "relocate";
  std::string quality = "shape";
  bool coarsen_given = false;
  bool cut = true;
  std::uint64_t threads = 0;
  std::string report;
  std::string progress = "auto";
  bool overwrite = false;
  bool quiet = false;
};

// Declares the options of `mesh`, bound to `usage`, which must outlive the parsing.
CommandLine declareMeshUsage(CLI::App& root, MeshUsage& usage);

// Once parsed: makes `usage.job` what the options say.
void settle(MeshUsage& usage);

}  // namespace coastmesh
