#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/edit/mesh_edit.hpp"
#include "apps/edit/mesh_file.hpp"
#include "apps/job/finish_grid.hpp"
#include "apps/job/mesh_job_options.hpp"
#include "apps/merge/merge_mesh.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// How meshes are put into another one.
struct MergeJob {
  MergeOptions merge;
  FinishOptions finish;  // targets
};

// A mesh to put in: its name in messages, and how it is read when its turn comes.
struct MeshToInsert {
  std::string name;
  std::function<Grid()> read;
};

// Puts the meshes into the grid, one after another. `name`: of the grid, in messages. Throws OptionError, InputError,
// Cancelled.
EditedMesh runMergeJob(Grid& grid, const std::string& name, const std::vector<MeshToInsert>& inserted,
                       const MergeJob& job, const Warn& warn, const JobControl& control = {});

}  // namespace coastmesh
