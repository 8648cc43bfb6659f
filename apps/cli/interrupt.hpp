#pragma once

#include <signal.h>

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace coastmesh {

// What stops the program: of SIGINT, SIGTERM and SIGHUP those that are not ignored now. Whoever started the program may
// have them ignored, as nohup does with SIGHUP; that has to stay so.
std::vector<int> stopSignals();
sigset_t setOf(const std::vector<int>& signals);

// SIGINT, SIGTERM and SIGHUP, turned into a question that the long stages ask. Where a library call does not come back
// within kPatience, a watcher thread removes the folders under guard and ends the process itself, so that an
// interrupted program is gone within a second and leaves nothing behind. To be made once, in main, before any other
// thread.
class Interrupt {
 public:
  // What is told which folders come under guard (true) and which are released (false), for whoever removes them where
  // this process does not come to that. May be empty.
  using Notes = std::function<void(const std::filesystem::path& folder, bool guarded)>;
  explicit Interrupt(Notes notes = {});
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool requested() const { return requested_.load(std::memory_order_relaxed); }
  // Also after the point of no return: whoever only waits for others then need not.
  bool signalled() const { return requested() || missed_.load(std::memory_order_relaxed); }
  // Throws Cancelled where a signal came.
  void check() const;

  // `folder` holds nothing but files that are not finished; it goes if the watcher has to end the process.
  void guard(const std::filesystem::path& folder);
  void release(const std::filesystem::path& folder) noexcept;
  // At an end that nothing can be done about any more: removes the folders under guard.
  void removeGuarded() noexcept;

  // The point of no return, before finished files are moved to their places: a signal that comes later changes nothing.
  // Throws Cancelled where one came before.
  void close();
  // Where the run goes on after that: from here on a signal counts again, and so does one that came in between.
  void reopen();

 private:
  void watch();
  void wakeWatcher();
  [[noreturn]] void endProcess();
  void emptyGuarded() noexcept;

  std::atomic<bool> requested_{false};
  std::mutex mutex_;
  std::condition_variable ended_changed_;
  bool ended_ = false;
  bool closed_ = false;
  std::atomic<bool> missed_{false};                                 // a signal came while closed
  std::map<std::filesystem::path, std::filesystem::path> guarded_;  // as given, and from the root
  Notes notes_;
  std::vector<int> signals_;  // those that stop the program
  std::thread watcher_;       // none where nothing does
};

}  // namespace coastmesh
