#include "apps/python/background.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace py = pybind11;

namespace coastmesh {

namespace {

constexpr auto kPollEvery = std::chrono::milliseconds(50);  // maximum delay of Ctrl-C and of progress calls

// Work on a thread of its own, and what it reports.
class Background {
 public:
  explicit Background(const std::function<void(const JobControl&)>& work) : thread_([this, &work] { run(work); }) {}
  ~Background() {
    cancelled_ = true;
    thread_.join();
  }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  // True once the work has ended; false after kPollEvery.
  bool wait() {
    std::unique_lock lock(mutex_);
    return ended_changed_.wait_for(lock, kPollEvery, [this] { return ended_; });
  }

  // Gets the last phase and share reported; false if nothing is new.
  bool takeProgress(std::string& phase, double& share) {
    const std::lock_guard lock(mutex_);
    phase = phase_;
    share = share_;
    return std::exchange(news_, false);
  }

  // To be called once it has ended. Throws what the work threw.
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void run(const std::function<void(const JobControl&)>& work) {
    const JobControl control{[this] { return cancelled_.load(std::memory_order_relaxed); },
                             [this](std::string_view phase, double share) {
                               const std::lock_guard lock(mutex_);
                               phase_ = phase;
                               share_ = share;
                               news_ = true;
                             }};
    try {
      work(control);
    } catch (...) {
      error_ = std::current_exception();
    }
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    ended_changed_.notify_all();
  }

  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
  std::condition_variable ended_changed_;
  bool ended_ = false;
  std::string phase_;
  double share_ = 0.0;
  bool news_ = false;
  std::exception_ptr error_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace

void runInBackground(const std::function<void(const JobControl& control)>& work, const py::object& progress) {
  Background background(work);
  const auto reportProgress = [&] {
    std::string phase;
    double share = 0.0;
    if (!progress.is_none() && background.takeProgress(phase, share)) progress(phase, share);
  };
  // If a signal or `progress` raises, the destructor stops the work. It waits with the GIL held, which is safe: the
  // work's threads never take it.
  for (bool ended = false; !ended;) {
    {
      const py::gil_scoped_release release;
      ended = background.wait();
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    reportProgress();
  }
  background.rethrow();
}

}  // namespace coastmesh
