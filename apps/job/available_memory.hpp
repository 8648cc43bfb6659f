#pragma once

namespace coastmesh {

// Bytes that the process may still take: what the machine has left, less where its control group or RLIMIT_AS allow
// less; infinite where nothing says.
double availableMemory();

}  // namespace coastmesh
