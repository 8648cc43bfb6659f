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

// The signals that stop the program: SIGINT, SIGTERM and SIGHUP, without those that are ignored now. The caller of the
// program may have had them ignored, as nohup does with SIGHUP; they must stay ignored.
std::vector<int> stopSignals();
sigset_t setOf(const std::vector<int>& signals);

// Turns SIGINT, SIGTERM and SIGHUP into a flag that long stages check. If a library call does not return within
// kPatience, a watcher thread removes the guarded folders and ends the process, so that an interrupted program ends
// within a second and leaves no file. To be created once, in main, before any other thread.
class Interrupt {
 public:
  // Called when a folder comes under guard (true) or is released (false), so that another process can remove folders if
  // this one cannot. May be empty.
  using Notes = std::function<void(const std::filesystem::path& folder, bool guarded)>;
  explicit Interrupt(Notes notes = {});
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool requested() const { return requested_.load(std::memory_order_relaxed); }
  // Also true for a signal after `close()`: there is no need to wait for other processes then.
  bool signalled() const { return requested() || missed_.load(std::memory_order_relaxed); }
  // Throws Cancelled if a signal came.
  void check() const;

  // `folder` holds only unfinished files; it is removed if the watcher has to end the process.
  void guard(const std::filesystem::path& folder);
  void release(const std::filesystem::path& folder) noexcept;
  // For an end that cannot be prevented: removes the guarded folders.
  void removeGuarded() noexcept;

  // The point of no return, before finished files are moved into place: later signals have no effect. Throws Cancelled
  // if one came before.
  void close();
  // For runs that continue after that: signals take effect again, including one that came in between.
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
  std::map<std::filesystem::path, std::filesystem::path> guarded_;  // as given, and absolute
  Notes notes_;
  std::vector<int> signals_;  // those that stop the program
  std::thread watcher_;       // not started if there are none
};

}  // namespace coastmesh
