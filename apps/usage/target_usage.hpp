#pragma once

#include <string>
#include <vector>

#include "apps/usage/option_table.hpp"

namespace coastmesh {

// Declares --target, which may be repeated; `names` is what the user gave.
void declareTargets(OptionTable& table, std::vector<std::string>& names, const std::string& help);

}  // namespace coastmesh
