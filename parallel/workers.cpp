#include "parallel/workers.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <utility>

namespace coastmesh {

namespace {

// The error with the smallest index, in whatever order the items ran.
class FirstError {
 public:
  void keep(std::size_t index, std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    if (error_ && index_ < index) return;
    index_ = index;
    error_ = std::move(error);
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  std::size_t index_ = 0;
  std::exception_ptr error_;
};

}  // namespace

void withThreads(const ParallelOptions& options, const std::function<void()>& work) {
  const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  // More threads than cores are allowed, so that their effect can be tested on any machine.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute(work);
}

int threadCount() { return tbb::this_task_arena::max_concurrency(); }

void forEachItem(std::size_t count, const RunControl& control, const std::function<void(std::size_t)>& work) {
  FirstError failure;
  std::atomic<bool> stop = false;
  std::atomic<std::size_t> next = 0;
  std::mutex progress_mutex;
  std::size_t done = 0;

  // Workers take items in order, one at a time: large items come first, and none waits in a busy worker's share.
  const auto worker = [&] {
    while (!stop) {
      const std::size_t i = next.fetch_add(1);
      if (i >= count) return;
      try {
        if (control.cancelled && control.cancelled()) throw Cancelled();
        work(i);
      } catch (...) {
        failure.keep(i, std::current_exception());
        stop = true;
        return;
      }
      const std::lock_guard lock(progress_mutex);
      ++done;
      if (control.progress) control.progress(static_cast<double>(done) / static_cast<double>(count));
    }
  };
  // Small regions run many loops of one item.
  if (count == 1) {
    worker();
    failure.rethrow();
    return;
  }
  // Isolated: a thread that waits here for the last item must not start another item of an enclosing loop.
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(
        0, threadCount(), [&](int) { worker(); }, tbb::simple_partitioner());
  });
  failure.rethrow();
}

}  // namespace coastmesh
