#pragma once

namespace coastmesh {

// Libraries in C may go on without memory that they were not given, and without the data that it was for (so GDAL's
// GeoJSON reader loses points). Hence a run in which any allocation failed, whoever asked, makes no output and is no
// success, even where a library did well without. What no process can have, more than PTRDIFF_MAX bytes, does not
// count: such a request fails on every machine alike.

// Called by `watch_memory`, for each allocation that fails; may be called from within malloc and from any thread.
void noteMemoryLacked() noexcept;

bool memoryLacked() noexcept;

// Throws std::bad_alloc where memory lacked: before anything is moved into place, and before success is told.
void requireMemoryHeld();

// The outputs are in place: what memory lacks after that can harm none of them.
void outputsAreInPlace() noexcept;

// Whether it lacked before that, or there were none.
bool memoryLackedForOutputs() noexcept;

}  // namespace coastmesh
