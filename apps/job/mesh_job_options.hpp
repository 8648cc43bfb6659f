#pragma once

#include <functional>
#include <string_view>

#include "apps/job/finish_grid.hpp"
#include "apps/job/group_exchange.hpp"
#include "apps/job/job_input.hpp"
#include "gis/size/size_source.hpp"
#include "parallel/mesh_regions.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {

// What to mesh, and how.
struct MeshJob {
  InputOptions input;
  MeshOptions mesh;   // `refine.max_vertices` holds for the whole; what it says of sizes is set from `sizes`
  SizeOptions sizes;  // where nothing but `most_m` is asked for, no edge is longer than that
  ParallelOptions parallel;
  FinishOptions finish;
  GroupExchange exchange;
  std::vector<std::string> notes;  // what was chosen for the user, for people
  bool keep_edits = false;         // where what was changed lies, besides how often
};

// How a job talks to whoever started it. Either function may be empty; `progress` is called from one thread at a time,
// with the phases "read", "refine" and "finish" and the share of the phase that is done.
struct JobControl {
  std::function<bool()> cancelled;
  std::function<void(std::string_view, double)> progress;
};

}  // namespace coastmesh
