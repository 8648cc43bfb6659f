#pragma once

#include <cstddef>
#include <functional>

#include "core/run_control.hpp"

namespace coastmesh {

struct ParallelOptions {
  int threads = 0;  // 0: all cores; does not change results
};

// Runs `work` with this number of threads available to the functions below.
void withThreads(const ParallelOptions& options, const std::function<void()>& work);

// The number of threads that share the work.
int threadCount();

// Runs `work(i)` for every i below `count` on the available threads; large items should come first. May be called from
// within such work. Every call is made unless `control.cancelled` returns true (then throws Cancelled) or a call throws
// (then the exception with the smallest i is rethrown once all running calls have ended). `control.progress` is called
// from one thread at a time.
void forEachItem(std::size_t count, const RunControl& control, const std::function<void(std::size_t)>& work);

}  // namespace coastmesh
