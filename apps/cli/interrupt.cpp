#include "apps/cli/interrupt.hpp"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <new>
#include <utility>

#include "apps/cli/exit_codes.hpp"
#include "core/run_control.hpp"

namespace coastmesh {

namespace {

constexpr auto kPatience = std::chrono::milliseconds(400);
constexpr int kRemovalTries = 100;

sigset_t stopSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGHUP);
  return signals;
}

}  // namespace

Interrupt::Interrupt() {
  // Whoever reads our output may go away first, and a file may come to its limit: such a write then fails as any other
  // does.
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  const sigset_t signals = stopSignals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  watcher_ = std::thread([this] { watch(); });
}

Interrupt::~Interrupt() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  ended_changed_.notify_all();
  pthread_kill(watcher_.native_handle(), SIGTERM);
  watcher_.join();
}

void Interrupt::check() const {
  if (requested()) throw Cancelled();
}

void Interrupt::guard(const std::filesystem::path& folder) {
  const std::lock_guard lock(mutex_);
  guarded_.emplace(folder, std::filesystem::absolute(folder));
}

void Interrupt::release(const std::filesystem::path& folder) noexcept {
  const std::lock_guard lock(mutex_);
  guarded_.erase(folder);
}

// Whoever holds the lock may be the one that cannot go on.
void Interrupt::removeGuarded() noexcept {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  try {
    emptyGuarded();
  } catch (const std::bad_alloc&) {
    return;
  }
}

void Interrupt::close() {
  const std::lock_guard lock(mutex_);
  if (requested_) throw Cancelled();
  closed_ = true;
}

void Interrupt::reopen() {
  const std::lock_guard lock(mutex_);
  closed_ = false;
  if (std::exchange(missed_, false)) pthread_kill(watcher_.native_handle(), SIGTERM);
}

void Interrupt::watch() {
  const sigset_t signals = stopSignals();
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

// The caller holds `mutex_`, so no folder comes under guard any more. A thread that is still writing may put another
// file into a folder that is being emptied: hence the tries. Once a folder is gone nothing can be made in it.
void Interrupt::emptyGuarded() {
  for (const auto& [given, folder] : guarded_) {
    std::error_code error;
    for (int i = 0; i < kRemovalTries && std::filesystem::exists(folder, error); ++i) {
      std::filesystem::remove_all(folder, error);
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
