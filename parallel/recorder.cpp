#include "parallel/recorder.hpp"

#include <ctime>

#include "parallel/workers.hpp"

namespace coastmesh {

double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void Recorder::forEach(std::string_view name, std::size_t count, const RunControl& control,
                       const std::function<void(std::size_t)>& work) {
  Stage stage{name, threadSeconds() - last_, std::vector<double>(count, 0.0)};
  forEachItem(count, control, [&](std::size_t i) {
    const double start = threadSeconds();
    work(i);
    stage.items[i] = threadSeconds() - start;
  });
  log_.stages.push_back(std::move(stage));
  last_ = threadSeconds();
}

WorkLog Recorder::finish(std::string_view rest) {
  const double now = threadSeconds();
  log_.addAlone(rest, now - last_);
  last_ = now;
  return std::exchange(log_, {});
}

}  // namespace coastmesh
