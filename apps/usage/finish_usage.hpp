#pragma once

#include "apps/job/finish_grid.hpp"
#include "apps/usage/option_table.hpp"

namespace coastmesh {

// Declares the options of depths from rasters, without --depth-fill; `help` is that of --bathymetry.
void declareDepths(OptionTable& table, DepthOptions& depth, const std::string& help);

// Declares the options of depths, boundaries and models.
void declareFinishOptions(OptionTable& table, FinishOptions& options);

}  // namespace coastmesh
