#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <utility>

#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "parallel/work_log.hpp"

namespace coastmesh {

// Seconds that the processor has spent on this thread.
double threadSeconds();

// Runs parallel loops and writes down, under a name that lives as long as the program, how long each of their items
// took: seconds of the processor's, so that other programs on the machine do not count. What lies between two loops is
// work that was done alone. Used from one thread.
class Recorder {
 public:
  void forEach(std::string_view name, std::size_t count, const RunControl& control,
               const std::function<void(std::size_t)>& work);

  // The same as a loop to lend.
  ItemLoop loop(std::string_view name, const RunControl& control = {}) {
    return [this, name, control](std::size_t count, const auto& work) { forEach(name, count, control, work); };
  }

  // What was written down; `rest` names what was done alone since the last loop.
  WorkLog finish(std::string_view rest = "rest");

 private:
  WorkLog log_;
  double last_ = threadSeconds();
};

}  // namespace coastmesh
