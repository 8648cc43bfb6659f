#include "apps/process/interrupt.hpp"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <utility>

#include "apps/process/exit_codes.hpp"
#include "core/run_control.hpp"
#include "gis/file/remove_folder.hpp"

namespace coastmesh {

namespace {

constexpr auto kPatience = std::chrono::milliseconds(400);
constexpr int kRemovalTries = 100;

}  // namespace

std::vector<int> stopSignals() {
  std::vector<int> signals;
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    if (sigaction(number, nullptr, &now) != 0 || now.sa_handler != SIG_IGN) signals.push_back(number);
  }
  return signals;
}

sigset_t setOf(const std::vector<int>& signals) {
  sigset_t set;
  sigemptyset(&set);
  for (const int number : signals) sigaddset(&set, number);
  return set;
}

Interrupt::Interrupt(Notes notes) : notes_(std::move(notes)), signals_(stopSignals()) {
  // If the reader of the output ends, or a file reaches its size limit, the write fails like any other.
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  if (signals_.empty()) return;
  const sigset_t signals = setOf(signals_);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  watcher_ = std::thread([this] { watch(); });
}

Interrupt::~Interrupt() {
  if (!watcher_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  ended_changed_.notify_all();
  wakeWatcher();
  watcher_.join();
}

void Interrupt::wakeWatcher() { pthread_kill(watcher_.native_handle(), signals_.front()); }

void Interrupt::check() const {
  if (requested()) throw Cancelled();
}

void Interrupt::guard(const std::filesystem::path& folder) {
  const std::lock_guard lock(mutex_);
  const auto [at, added] = guarded_.emplace(folder, std::filesystem::absolute(folder));
  if (notes_ && added) notes_(at->second, true);
}

void Interrupt::release(const std::filesystem::path& folder) noexcept {
  const std::lock_guard lock(mutex_);
  const auto at = guarded_.find(folder);
  if (at == guarded_.end()) return;
  if (notes_) notes_(at->second, false);
  guarded_.erase(at);
}

// Does not wait: the owner of the lock may be the thread that cannot continue.
void Interrupt::removeGuarded() noexcept {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  emptyGuarded();
}

void Interrupt::close() {
  const std::lock_guard lock(mutex_);
  if (requested_) throw Cancelled();
  closed_ = true;
  // From here on these folders hold replaced files, needed until all outputs are in place.
  if (notes_)
    for (const auto& [given, folder] : guarded_) notes_(folder, false);
}

void Interrupt::reopen() {
  const std::lock_guard lock(mutex_);
  closed_ = false;
  if (notes_)
    for (const auto& [given, folder] : guarded_) notes_(folder, true);
  if (missed_.exchange(false)) wakeWatcher();
}

void Interrupt::watch() {
  const sigset_t signals = setOf(signals_);
  for (;;) {
    int signal_number = 0;
    if (sigwait(&signals, &signal_number) != 0) continue;
    std::unique_lock lock(mutex_);
    if (ended_) return;
    if (closed_) {
      missed_ = true;
      continue;
    }
    requested_ = true;
    if (ended_changed_.wait_for(lock, kPatience, [this] { return ended_; })) return;
    endProcess();
  }
}

// With `mutex_` locked, no folder is added. A thread that is still writing may create files in a folder that is being
// removed, hence the retries; once the folder is gone, nothing can be created in it.
void Interrupt::emptyGuarded() noexcept {
  for (const auto& [given, folder] : guarded_) {
    for (int i = 0; i < kRemovalTries && !removeFolder(folder.c_str()); ++i) {
    }
  }
}

void Interrupt::endProcess() {
  emptyGuarded();
  constexpr char kMessage[] = "coastmesh: error: interrupted\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kMessage, sizeof kMessage - 1);
  _exit(kExitInterrupted);
}

}  // namespace coastmesh
