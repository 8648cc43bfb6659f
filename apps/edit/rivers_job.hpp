#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/edit/mesh_edit.hpp"
#include "apps/edit/mesh_file.hpp"
#include "apps/job/finish_grid.hpp"
#include "apps/job/mesh_job_options.hpp"
#include "apps/merge/merge_mesh.hpp"
#include "gis/grid/grid.hpp"
#include "gis/rivers/lay_rivers.hpp"
#include "gis/rivers/river_lines.hpp"

namespace coastmesh {

// How rivers are added to a mesh.
struct RiversJob {
  RiverColumns columns;
  std::optional<double> width_m;   // of lines without one
  std::vector<std::string> banks;  // files of polygons of rivers' water, which give widths
  RiverOptions rivers;             // bounds at junctions are those of `merge`
  MergeOptions merge;
  FinishOptions finish;  // targets
};

// Adds rivers along the lines of files to the grid. `name`: of the grid, in messages. Throws OptionError, InputError,
// also if no river is connected with the grid; Cancelled.
EditedMesh runRiversJob(Grid& grid, const std::string& name, const std::vector<std::string>& lines,
                        const RiversJob& job, const Warn& warn, const JobControl& control = {});

}  // namespace coastmesh
