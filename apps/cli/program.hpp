#pragma once

#include "apps/cli/interrupt.hpp"

namespace coastmesh {

// Parses the command line and runs the command it names. Returns an exit code, or throws: UsageText, OptionError,
// InputError, OutputError, Cancelled, and whatever a bug throws.
int runProgram(int argc, char** argv, Interrupt& interrupt);

}  // namespace coastmesh
