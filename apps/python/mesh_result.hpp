#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/job/mesh_job_result.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// A mesh that was made, changed or read; Python's arrays are views into it.
struct MeshResult {
  Grid grid;
  std::string report;   // JSON; empty for a mesh that was read
  std::string summary;  // for people; empty for a mesh that was not changed
  std::vector<std::string> warnings;
  std::vector<Refusal> refusals;
  bool complete = true;
  // Of a mesh that was changed, unless repairs for models came after: for each node and triangle its index in the mesh
  // before, and in a merged one which of the meshes that is; -1 for new ones.
  std::vector<std::int64_t> node_source{}, triangle_source{}, node_mesh{}, triangle_mesh{};
};

}  // namespace coastmesh
