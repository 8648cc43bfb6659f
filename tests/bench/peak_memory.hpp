#pragma once

#include <cstdint>
#include <functional>

namespace coastmesh {

// By how many bytes the resident memory of a process grows at most while it does the work: what getrusage reports of a
// forked child, less what the child held when it started. Pages that the parent has freed but kept would hide growth:
// measure before anything else is done.
std::uint64_t peakGrowth(const std::function<void()>& work);

}  // namespace coastmesh
