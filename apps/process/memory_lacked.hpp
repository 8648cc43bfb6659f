#pragma once

namespace coastmesh {

// Libraries in C may carry on after a failed allocation, without the data that it was for: GDAL's GeoJSON reader loses
// points. Hence a run in which any allocation failed writes no output and does not succeed, even if a library coped.
// Requests for more than PTRDIFF_MAX bytes do not count: they fail on every machine.

// Called by `watch_memory` for each failed allocation; may be called from within malloc and from any thread.
void noteMemoryLacked() noexcept;

bool memoryLacked() noexcept;

// Throws std::bad_alloc if an allocation failed. To be called before outputs are moved into place and before success is
// reported.
void requireMemoryHeld();

// The outputs are in place: allocations that fail from now on cannot harm them.
void outputsAreInPlace() noexcept;

// True if an allocation failed before that, or at any time if there are no outputs.
bool memoryLackedForOutputs() noexcept;

}  // namespace coastmesh
