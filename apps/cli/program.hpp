#pragma once

#include "apps/cli/interrupt.hpp"

namespace coastmesh {

class Cluster;
struct ServeOptions;

// Parses the command line and runs the command it names. `cluster`: the other ranks, where there are some. Returns an
// exit code, or throws: UsageText, OptionError, InputError, OutputError, Cancelled, and whatever a bug throws.
int runProgram(int argc, char** argv, Interrupt& interrupt, Cluster* cluster);

// How a rank helps the one that runs the program. `interrupt` has to outlive it.
ServeOptions helpIn(const Interrupt& interrupt);

}  // namespace coastmesh
