#pragma once

namespace coastmesh {

// Returns freed memory to the system, if the C library can (glibc). It keeps freed pages for later allocations, which
// may not need them after a large mesh. Does nothing if little is free: faulting in a new page costs as much as copying
// some hundred triangles.
void giveBackFreeMemory();

// Makes the C library keep freed memory, including large blocks, for later allocations until `giveBackFreeMemory` is
// called. Only for programs: affects the whole process.
void keepFreedMemory();

}  // namespace coastmesh
