#pragma once

#include <string>
#include <vector>

#include "apps/command_line.hpp"
#include "gis/check_target.hpp"

namespace coastmesh {

// Declares --target, which may be repeated; `names` is what the user gave.
void declareTargets(CommandLine& line, std::vector<std::string>& names, const std::string& help);

// The models so named, each once, in the order of Target. Throws UsageError for a name that is none.
std::vector<Target> targetsNamed(const std::vector<std::string>& names);

}  // namespace coastmesh
