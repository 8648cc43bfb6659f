#pragma once

#include <string>
#include <vector>

#include "apps/usage/option_table.hpp"

namespace coastmesh {

// Declares -o and --format: meshes to write, each with all the files that its format makes.
void declareGridOutputs(OptionTable& table, std::vector<std::string>& outputs, std::string& format);

}  // namespace coastmesh
