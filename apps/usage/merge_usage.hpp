#pragma once

#include "apps/edit/merge_job.hpp"
#include "apps/edit/mesh_file.hpp"
#include "apps/usage/option_table.hpp"

namespace coastmesh {

// How meshes are put into another one, as options say it. Files to write belong to the command alone.
struct MergeUsage {
  MeshFile mesh;  // its CRS is that of the others too
  MergeJob job;
};

// Declares all options but those of files to write; `usage` must outlive the table.
void declareMergeOptions(OptionTable& table, MergeUsage& usage);

}  // namespace coastmesh
