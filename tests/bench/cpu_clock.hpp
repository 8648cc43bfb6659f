#pragma once

#include <ctime>

namespace coastmesh {

// Processor time of this process, in seconds. The measured work runs on one thread and reads no files, so this is the
// wall-clock time on an idle machine, even if the machine is busy.
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
