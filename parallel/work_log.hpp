#pragma once

#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace coastmesh {

// A stage of a run: single-threaded work, then pieces of work for all threads. Seconds.
struct Stage {
  std::string_view name;  // of the pieces of work; static lifetime
  double alone = 0.0;
  std::vector<double> items;  // in the order in which threads take them
};

// The stages of a run; no item of a stage begins before the previous stage has ended.
struct WorkLog {
  std::vector<Stage> stages;

  void addAlone(std::string_view name, double seconds) { stages.push_back({name, seconds, {}}); }
  void append(WorkLog&& other);
  // The stages with some names.
  WorkLog only(std::initializer_list<std::string_view> names) const;
  // All work, in single-threaded seconds.
  double work() const;
  // The lower limit for any number of threads.
  double criticalPath() const;
  // The time of the run on `threads` threads, each taking the next item when it has finished one.
  double timeOn(std::size_t threads) const;
};

}  // namespace coastmesh
