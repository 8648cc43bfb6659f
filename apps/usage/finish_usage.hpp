#pragma once

#include <string>
#include <vector>

#include "apps/job/finish_grid.hpp"
#include "apps/usage/option_table.hpp"

namespace coastmesh {

// Declares the options of depths from rasters, without --depth-fill; `help` is that of --bathymetry. `interpolated`:
// the options with rasters that --depth-method is for.
void declareDepths(OptionTable& table, DepthOptions& depth, const std::string& help,
                   const std::vector<std::string>& interpolated = {"--bathymetry"});

// Declares the nodal attributes.
void declareFields(OptionTable& table, std::vector<FieldSource>& fields);

// Declares the options of depths, attributes, boundaries and models.
void declareFinishOptions(OptionTable& table, FinishOptions& options);

}  // namespace coastmesh
