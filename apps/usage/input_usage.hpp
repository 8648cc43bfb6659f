#pragma once

#include "apps/job/job_input.hpp"
#include "apps/usage/command_line.hpp"

namespace coastmesh {

// Declares the options that say how an input becomes domains of the plane: --crs, --snap, --simplify,
// --min-island-area.
void declareInputOptions(CommandLine& line, InputOptions& options);

// --pinches; apart, since `check` means something else by it.
void declarePinches(CommandLine& line, InputOptions& options);
void declarePinches(CommandLine& line, const std::string& name, const std::string& help, InputOptions& options);

}  // namespace coastmesh
