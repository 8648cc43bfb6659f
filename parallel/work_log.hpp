#pragma once

#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace coastmesh {

// A stretch of a run: what one thread did alone, then pieces of work for as many threads as there are. Seconds.
struct Stage {
  std::string_view name;  // of the pieces of work; lives as long as the program
  double alone = 0.0;
  std::vector<double> items;  // in the order in which threads take them
};

// What a run did, stage after stage; no item of a stage begins before the stage before it has ended.
struct WorkLog {
  std::vector<Stage> stages;

  void addAlone(std::string_view name, double seconds) { stages.push_back({name, seconds, {}}); }
  void append(WorkLog&& other);
  // The stages of some names.
  WorkLog only(std::initializer_list<std::string_view> names) const;
  // All the work, in seconds of one thread.
  double work() const;
  // What any number of threads has to wait for.
  double criticalPath() const;
  // How long the run takes with so many threads: each takes the next item when it has ended one.
  double timeOn(std::size_t threads) const;
};

}  // namespace coastmesh
