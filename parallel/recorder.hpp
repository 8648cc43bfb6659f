#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <utility>

#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "parallel/work_log.hpp"

namespace coastmesh {

// Processor seconds of this thread.
double threadSeconds();

// Runs parallel loops and records, under a name with static lifetime, how long each of their items took: in processor
// seconds, so that other programs on the machine do not count. The time between two loops is single-threaded work. To
// be used from one thread.
class Recorder {
 public:
  void forEach(std::string_view name, std::size_t count, const RunControl& control,
               const std::function<void(std::size_t)>& work);

  // The same as a loop to pass on, which can be cancelled but reports no progress: a stage consists of many loops.
  ItemLoop loop(std::string_view name, const RunControl& control = {}) {
    return [this, name, inner = RunControl{control.cancelled, {}}](std::size_t count, const auto& work) {
      forEach(name, count, inner, work);
    };
  }

  // The records; `rest` is the name of the single-threaded work since the last loop.
  WorkLog finish(std::string_view rest = "rest");

 private:
  WorkLog log_;
  double last_ = threadSeconds();
};

}  // namespace coastmesh
