#pragma once

#include <cstdint>
#include <functional>

namespace coastmesh {

// The largest growth, in bytes, of a process's resident memory during the work: the peak that getrusage reports for a
// forked child, minus the child's memory at its start. Pages that the parent freed but kept would hide growth, so
// measure before any other work.
std::uint64_t peakGrowth(const std::function<void()>& work);

}  // namespace coastmesh
