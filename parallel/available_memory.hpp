#pragma once

namespace coastmesh {

// Bytes that the process can still allocate: what the machine has left, or less if its control group or RLIMIT_AS allow
// less; infinite if unknown.
double availableMemory();

}  // namespace coastmesh
