#pragma once

#include <string>
#include <vector>

#include "apps/edit/mesh_file.hpp"
#include "apps/edit/remesh_job.hpp"
#include "apps/usage/option_table.hpp"
#include "apps/usage/sizing_usage.hpp"

namespace coastmesh {

// A part of a mesh to mesh anew, as options say it. Files to write belong to the command alone.
struct RemeshUsage {
  MeshFile mesh;
  RemeshJob job;
  SizingUsage sizing;
};

// Declares all options but those of files to write; `usage` must outlive the table.
void declareRemeshOptions(OptionTable& table, RemeshUsage& usage);

// To be called once all is set. Returns warnings. Throws OptionError for options that say nothing, or that cannot be
// combined.
std::vector<std::string> settle(RemeshUsage& usage);

}  // namespace coastmesh
