#pragma once

#include "apps/process/interrupt.hpp"

namespace coastmesh {

class Cluster;
struct ServeOptions;

// Parses the command line and runs the command that it names. `cluster`: the other ranks; null if there are none.
// Returns an exit code, or throws: UsageText, OptionError, InputError, OutputError, Cancelled, and whatever a bug
// throws.
int runProgram(int argc, char** argv, Interrupt& interrupt, Cluster* cluster);

// Options for a rank that helps the one that runs the program. `interrupt` must outlive them.
ServeOptions helpIn(const Interrupt& interrupt);

}  // namespace coastmesh
