#pragma once

#include <string>

#include "tests/fuzz/refine_case.hpp"

namespace coastmesh {

// Runs one case in a process of its own, so that a crash, a failed assert or an endless run becomes a failure like any
// other. `cpu_seconds`: the time limit.
CaseResult runIsolated(const RefineCase& refine_case, const CaseLimits& limits, unsigned cpu_seconds);

// Describes how a child process ended; empty if it ended with exit code 0.
std::string howItDied(int wait_status);

// Ends this process by a signal when it has used this much processor time.
void limitCpuTime(unsigned cpu_seconds);

}  // namespace coastmesh
