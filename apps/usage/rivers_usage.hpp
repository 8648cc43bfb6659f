#pragma once

#include <cstdint>
#include <limits>

#include "apps/edit/mesh_file.hpp"
#include "apps/edit/rivers_job.hpp"
#include "apps/usage/option_table.hpp"

namespace coastmesh {

// How rivers are added to a mesh, as options say it. Files to write belong to the command alone.
struct RiversUsage {
  MeshFile mesh;
  RiversJob job;
  double width_m = std::numeric_limits<double>::infinity();  // infinite: none
  std::uint64_t elements = 2;
};

// Declares all options but those of files to write; `usage` must outlive the table.
void declareRiversOptions(OptionTable& table, RiversUsage& usage);

// To be called once all is set.
void settle(RiversUsage& usage);

}  // namespace coastmesh
