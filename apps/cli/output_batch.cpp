#include "apps/cli/output_batch.hpp"

#include <utility>

#include "apps/process/waiting_threads.hpp"

namespace coastmesh {

void OutputBatch::add(std::unique_ptr<RunOutputs> part) {
  constexpr double kTimesCommit = 10.0;
  constexpr std::size_t kMostParts = 256;  // each has a folder of its own
  parts_.push_back(std::move(part));
  if (since_commit_.seconds() >= kTimesCommit * commit_seconds_ || parts_.size() >= kMostParts) commit();
}

void OutputBatch::commit() {
  const std::vector<std::unique_ptr<RunOutputs>> parts = std::exchange(parts_, {});
  const Stopwatch watch;
  commitInTurn(parts, onWaitingThreads);
  commit_seconds_ = watch.seconds();
  since_commit_ = {};
}

}  // namespace coastmesh
