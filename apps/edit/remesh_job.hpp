#pragma once

#include <string>

#include "apps/edit/mesh_edit.hpp"
#include "apps/job/finish_grid.hpp"
#include "apps/job/mesh_job_options.hpp"
#include "apps/remesh/remesh_options.hpp"
#include "gis/cut/cut_region.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// A part of a mesh to mesh anew.
struct RemeshJob {
  CutRegion region;
  RemeshOptions remesh;
  FinishOptions finish;  // targets

  static constexpr const char* kPurpose = "to mesh anew";
};

// `name`: of the mesh, in messages. Throws OptionError, InputError, Cancelled.
EditedMesh runRemeshJob(Grid& grid, const std::string& name, const RemeshJob& job, const JobControl& control = {});

}  // namespace coastmesh
