#pragma once

#include <string>

#include "tests/fuzz/refine_case.hpp"

namespace coastmesh {

// Runs one case in a process of its own: a crash, a failed assert or a run without an end becomes a failure like any
// other. `cpu_seconds`: how long it may take.
CaseResult runIsolated(const RefineCase& refine_case, const CaseLimits& limits, unsigned cpu_seconds);

// What became of a child process that should have ended by itself, in words; empty where it did.
std::string howItDied(int wait_status);

// Ends this process by a signal once it has used this much processor time.
void limitCpuTime(unsigned cpu_seconds);

}  // namespace coastmesh
