#pragma once

#include <string>
#include <vector>

#include "apps/usage/option_table.hpp"

namespace coastmesh {

// Declares --assume-crs, the CRS of a mesh whose file has none.
void declareAssumedCrs(OptionTable& table, std::string& crs);

// Declares -o and --format: meshes to write, each with all the files that its format makes.
void declareGridOutputs(OptionTable& table, std::vector<std::string>& outputs, std::string& format);

}  // namespace coastmesh
