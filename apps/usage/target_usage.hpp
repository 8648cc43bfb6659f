#pragma once

#include <string>
#include <vector>

#include "apps/usage/command_line.hpp"

namespace coastmesh {

// Declares --target, which may be repeated; `names` is what the user gave.
void declareTargets(CommandLine& line, std::vector<std::string>& names, const std::string& help);

}  // namespace coastmesh
