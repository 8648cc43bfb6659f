#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "apps/input/job_input.hpp"
#include "apps/job/finish_grid.hpp"
#include "apps/job/group_exchange.hpp"
#include "gis/size/size_source.hpp"
#include "parallel/mesh_regions.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {

// What to mesh, and how.
struct MeshJob {
  InputOptions input;
  MeshOptions mesh;   // `refine.max_vertices` applies to the whole; its sizes are set from `sizes`
  SizeOptions sizes;  // if only `most_m` is given, no edge is longer
  std::shared_ptr<const SizeLayers> size_layers;  // instead of the vector files of `sizes`; null: they are read
  ParallelOptions parallel;
  FinishOptions finish;
  GroupExchange exchange;
  std::vector<std::string> notes;  // choices made for the user, for messages
  bool keep_edits = false;         // record where changes were made, not only how many
  std::optional<double> memory;    // bytes that it may take; nullopt: `availableMemory()`
};

// Communication of a job with its caller. Each function may be empty; `progress` is called from one thread at a time,
// with the phases "read", "refine" and "finish" and the completed share of the phase. `expects` is called before
// features are meshed whose sizes need so many vertices that it takes a while, from any thread.
struct JobControl {
  std::function<bool()> cancelled;
  std::function<void(std::string_view, double)> progress;
  std::function<void(double vertices)> expects{};
};

}  // namespace coastmesh
