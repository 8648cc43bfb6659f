#pragma once

namespace coastmesh {

// Gives what was freed back to the system, as far as the library of the C language can be asked to: it keeps pages for
// who allocates next, which is not the same again after a large mesh. Does nothing where that is little: a page taken
// anew costs as much as some hundred triangles copied.
void giveBackFreeMemory();

// Lets the library keep what was freed, large blocks too, for who allocates next, until `giveBackFreeMemory` is asked
// for. For programs alone: it holds for the whole process.
void keepFreedMemory();

}  // namespace coastmesh
