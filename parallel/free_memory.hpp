#pragma once

namespace coastmesh {

// Gives what was freed back to the system, as far as the library of the C language can be asked to: it keeps pages for
// who allocates next, which is not the same again after a large mesh. Costs some milliseconds a gigabyte, and as much
// for what is taken anew.
void giveBackFreeMemory();

}  // namespace coastmesh
