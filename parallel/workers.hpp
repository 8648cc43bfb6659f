#pragma once

#include <cstddef>
#include <functional>

#include "core/run_control.hpp"

namespace coastmesh {

struct ParallelOptions {
  int threads = 0;  // 0 takes all cores; never changes a result
};

// Runs `work` with so many threads at the service of the calls below.
void withThreads(const ParallelOptions& options, const std::function<void()>& work);

// How many threads there are to share the work out to.
int threadCount();

// Runs `work(i)` for every i below `count` on the threads at hand; large items should come first. May be called from
// within such a piece of work. Every call gets done unless `control.cancelled` returns true (then throws Cancelled) or
// a call throws (then the one with the least i is rethrown once all running ones have ended). `control.progress` is
// called from one thread at a time.
void forEachItem(std::size_t count, const RunControl& control, const std::function<void(std::size_t)>& work);

}  // namespace coastmesh
