#pragma once

#include <string>
#include <vector>

#include "apps/usage/command_line.hpp"

namespace coastmesh {

// Declares -o and --format: meshes to write, each with all the files that its format makes.
void declareGridOutputs(CommandLine& line, std::vector<std::string>& outputs, std::string& format);

}  // namespace coastmesh
