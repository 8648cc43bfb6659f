#include "parallel/mesh_regions.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <utility>

#include "core/delaunay.hpp"

namespace coastmesh {

namespace {

// The first error by index, whatever order the items ran in.
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

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void forEachRegion(std::size_t count, const ParallelOptions& options, const RunControl& control,
                   const std::function<void(std::size_t)>& work) {
  FirstError failure;
  std::atomic<bool> stop = false;
  std::atomic<std::size_t> next = 0;
  std::mutex progress_mutex;
  std::size_t done = 0;

  // Workers take the items in order, one at a time: the large ones come first and no worker waits behind another's
  // share.
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

  const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  // More threads than cores are given when asked for: what they change can then be seen on any machine.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        0, threads, [&](int) { worker(); }, tbb::simple_partitioner());
  });
  failure.rethrow();
}

MeshedRegion meshRegion(const Pslg& pslg, const MeshOptions& options, const RunControl& control) {
  MeshedRegion region;
  auto start = std::chrono::steady_clock::now();
  region.mesh = constrainedDelaunay(pslg);
  region.seconds.triangulate = secondsSince(start);

  start = std::chrono::steady_clock::now();
  region.stats = refine(region.mesh, pslg, options.refine, control);
  region.seconds.refine = secondsSince(start);
  if (!options.shrink) return region;

  start = std::chrono::steady_clock::now();
  RefineStats shrunk = shrink(region.mesh, pslg, options.refine, control);
  region.seconds.shrink = secondsSince(start);
  region.stats.unresolved.clear();
  region.stats.add(shrunk);
  region.stats.steiner_points = region.mesh.points.size() - region.mesh.input_vertices;
  return region;
}

}  // namespace coastmesh
