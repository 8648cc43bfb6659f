#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string_view>
#include <utility>

#include "core/run_control.hpp"
#include "parallel/work_log.hpp"

namespace coastmesh {

// Runs parallel loops and writes down, under a name that lives as long as the program, how long each of their items took. What lies between two loops is work that was done alone.
class Recorder {
 public:
  void forEach(std::string_view name, std::size_t count, const RunControl& control,
               const std::function<void(std::size_t)>& work);

  // The same for `work(first, last)` on stretches that make up 0 to `count`; their number depends on nothing but `count`.
  void forEachStretch(std::string_view name, std::size_t count,
                      const std::function<void(std::size_t, std::size_t)>& work);

  WorkLog finish();

 private:
  using Clock = std::chrono::steady_clock;

  WorkLog log_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace coastmesh
