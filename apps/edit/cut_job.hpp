#pragma once

#include <string>

#include "apps/edit/mesh_edit.hpp"
#include "apps/job/finish_grid.hpp"
#include "apps/job/mesh_job_options.hpp"
#include "gis/cut/cut_grid.hpp"
#include "gis/cut/cut_region.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// A part to cut out of a mesh.
struct CutJob {
  CutRegion region;
  CutOptions cut;
  FinishOptions finish;  // targets

  static constexpr const char* kPurpose = "to cut out";
};

// `name`: of the mesh, in messages. Throws OptionError, InputError, Cancelled.
EditedMesh runCutJob(Grid& grid, const std::string& name, const CutJob& job, const JobControl& control = {});

}  // namespace coastmesh
