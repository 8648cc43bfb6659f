#include "parallel/recorder.hpp"

#include <algorithm>

#include "parallel/workers.hpp"

namespace coastmesh {

namespace {

double secondsBetween(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

void Recorder::forEach(std::string_view name, std::size_t count, const RunControl& control,
                       const std::function<void(std::size_t)>& work) {
  Stage stage{name, secondsBetween(last_, Clock::now()), std::vector<double>(count, 0.0)};
  forEachItem(count, control, [&](std::size_t i) {
    const Clock::time_point start = Clock::now();
    work(i);
    stage.items[i] = secondsBetween(start, Clock::now());
  });
  log_.stages.push_back(std::move(stage));
  last_ = Clock::now();
}

void Recorder::forEachStretch(std::string_view name, std::size_t count,
                              const std::function<void(std::size_t, std::size_t)>& work) {
  constexpr std::size_t kLeast = 8192, kMostStretches = 256;
  const std::size_t stretches = std::clamp<std::size_t>(count / kLeast, 1, kMostStretches);
  forEach(name, stretches, {}, [&](std::size_t s) { work(count * s / stretches, count * (s + 1) / stretches); });
}

WorkLog Recorder::finish() {
  log_.addAlone("rest", secondsBetween(last_, Clock::now()));
  last_ = Clock::now();
  return std::exchange(log_, {});
}

}  // namespace coastmesh
