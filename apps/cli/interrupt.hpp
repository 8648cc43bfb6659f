#pragma once

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <set>
#include <thread>

namespace coastmesh {

// SIGINT, SIGTERM and SIGHUP, turned into a question that the long stages ask. Where a library call does not come back
// within kPatience, a watcher thread removes the folders under guard and ends the process itself, so that an
// interrupted program is gone within a second and leaves nothing behind. To be made once, in main, before any other
// thread.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool requested() const { return requested_.load(std::memory_order_relaxed); }
  // Throws Cancelled where a signal came.
  void check() const;

  // `folder` holds nothing but files that are not finished; it goes if the watcher has to end the process.
  void guard(const std::filesystem::path& folder);
  void release(const std::filesystem::path& folder);

  // The point of no return, before finished files are moved to their places: a signal that comes later changes nothing.
  // Throws Cancelled where one came before.
  void close();

 private:
  void watch();
  void endProcess();

  std::atomic<bool> requested_{false};
  std::mutex mutex_;
  std::condition_variable ended_changed_;
  bool ended_ = false;
  bool closed_ = false;
  std::set<std::filesystem::path> guarded_;
  std::thread watcher_;
};

}  // namespace coastmesh
