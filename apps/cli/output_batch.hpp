#pragma once

#include <memory>
#include <vector>

#include "apps/cli/run_outputs.hpp"
#include "apps/job/stopwatch.hpp"

namespace coastmesh {

// Outputs of a run with many parts, each moved into place on its own, but several after a single wait for the disk:
// for small files that would take longer than all else. What it holds when it is destroyed is removed.
class OutputBatch {
 public:
  // `part` is written completely. Commits at once, unless that would make more than a tenth of the run wait for the
  // disk; then with a later one. Throws as `commitInTurn`.
  void add(std::unique_ptr<RunOutputs> part);
  // Moves into place what is held. To be called in the end, also if another output cannot be written.
  void commit();

 private:
  std::vector<std::unique_ptr<RunOutputs>> parts_;
  Stopwatch since_commit_;
  double commit_seconds_ = 0.0;  // of the last commit
};

}  // namespace coastmesh
