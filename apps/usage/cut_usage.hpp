#pragma once

#include "apps/edit/cut_job.hpp"
#include "apps/edit/mesh_file.hpp"
#include "apps/usage/option_table.hpp"

namespace coastmesh {

// A part to cut out of a mesh, as options say it. Files to write belong to the command alone.
struct CutUsage {
  MeshFile mesh;
  CutJob job;
};

// Declares all options but those of files to write; `usage` must outlive the table.
void declareCutOptions(OptionTable& table, CutUsage& usage);

// To be called once all is set. Throws OptionError.
void settle(CutUsage& usage);

}  // namespace coastmesh
