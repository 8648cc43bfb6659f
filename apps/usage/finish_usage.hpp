#pragma once

#include "apps/job/finish_grid.hpp"
#include "apps/usage/command_line.hpp"

namespace coastmesh {

// Declares the options of depths, boundaries and models.
void declareFinishOptions(CommandLine& line, FinishOptions& options);

}  // namespace coastmesh
