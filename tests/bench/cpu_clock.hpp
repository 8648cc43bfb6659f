#pragma once

#include <ctime>

namespace coastmesh {

// Processor time of this process, in seconds. What is measured runs on one thread and reads no files, so on an idle
// machine it is the time on the wall; on a busy one it is what the wall would show on an idle one.
inline double cpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <typename Work>
double cpuSecondsOf(const Work& work) {
  const double before = cpuSeconds();
  work();
  return cpuSeconds() - before;
}

}  // namespace coastmesh
