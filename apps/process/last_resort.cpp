#include "apps/process/last_resort.hpp"

#include <cpl_error.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "apps/process/exit_codes.hpp"
#include "apps/process/memory_lacked.hpp"

namespace coastmesh {

namespace {

Interrupt* g_interrupt = nullptr;
std::optional<int> g_finished;
std::atomic<bool> g_thread_lacked = false;

constexpr int kCrashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr unsigned kSecondsToRemove = 10;  // the crashed thread may hold a lock

// Nothing here allocates memory.
void tell(const char* text) { [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, std::strlen(text)); }

void removeWhatIsHalfWritten() {
  if (g_finished) _exit(*g_finished);
  if (g_interrupt != nullptr) g_interrupt->removeGuarded();
}

[[noreturn]] void end(const char* lacking, const char* otherwise) {
  tell("coastmesh: error: ");
  tell(lacking != nullptr ? lacking : otherwise);
  tell("\n");
  _exit(lacking != nullptr ? kExitInput : kExitBug);
}

[[noreturn]] void endAtOnce() {
  // Without an exception it is GDAL that ends the process, which it does if memory runs out.
  const char* const lacking = std::current_exception() ? whatLacks() : kNoMemory;
  removeWhatIsHalfWritten();
  beFirstToTell();
  end(lacking, "this is a bug in coastmesh, please report it: an error where none may be thrown");
}

// A library whose allocation fails may ignore it, or end the process itself.
void crashed(int number) {
  for (const int other : kCrashes) signal(other, SIG_DFL);
  signal(SIGALRM, SIG_DFL);
  alarm(kSecondsToRemove);
  removeWhatIsHalfWritten();
  const bool no_memory = memoryLacked() || CPLGetLastErrorNo() == CPLE_OutOfMemory;
  const char* const lacking = no_memory ? kNoMemory : g_thread_lacked ? kNoThread : nullptr;
  rlimit core{};
  // For users who want to see the cause.
  if (lacking == nullptr && getrlimit(RLIMIT_CORE, &core) == 0 && core.rlim_cur > 0) raise(number);
  end(lacking, "this is a bug in coastmesh, or of a library, please report it: it crashed");
}

// A library ends the process, as HDF5 does if it cannot start. After main has returned there is nothing to remove.
void endedFromWithin() {
  if (g_interrupt == nullptr || g_finished) return;
  removeWhatIsHalfWritten();
  const bool lacking = memoryLacked() || CPLGetLastErrorNo() == CPLE_OutOfMemory;
  end(lacking ? kNoMemory : nullptr, "a library ended the process, possibly for lack of memory");
}

}  // namespace

void noteThreadLacked() noexcept { g_thread_lacked = true; }

void beFirstToTell() {
  static std::atomic_flag told;
  if (told.test_and_set()) sleep(kSecondsToRemove);
}

const char* whatLacks() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return kNoMemory;
  } catch (const std::system_error& error) {
    return error.code() == std::errc::resource_unavailable_try_again ? kNoThread : nullptr;
  } catch (const std::runtime_error& error) {
    // oneTBB throws no type of its own for it: "pthread_create has failed: ...".
    constexpr const char* kOfTbb = "pthread_create";
    return std::strncmp(error.what(), kOfTbb, std::strlen(kOfTbb)) == 0 ? kNoThread : nullptr;
  } catch (...) {
    return nullptr;
  }
}

// Handlers get a stack of their own: after a stack overflow there is no room for them on the other.
void catchCrashes() {
  static bool caught = false;  // set in main at the latest, before there are threads
  if (std::exchange(caught, true)) return;
  std::set_terminate(endAtOnce);
  static char stack[1 << 16];
  stack_t other{};
  other.ss_sp = stack;
  other.ss_size = sizeof stack;
  sigaltstack(&other, nullptr);
  for (const int number : kCrashes) {
    struct sigaction now {};
    // Sanitizers have their own handler for such errors.
    if (sigaction(number, nullptr, &now) != 0 || now.sa_handler != SIG_DFL) continue;
    struct sigaction wanted {};
    wanted.sa_handler = crashed;
    wanted.sa_flags = SA_ONSTACK | SA_NODEFER;
    sigaction(number, &wanted, nullptr);
  }
}

namespace {

// Before main, since initialisers already allocate memory.
[[gnu::constructor(101)]] void beforeMain() {
  std::set_terminate(endAtOnce);
  std::set_new_handler([] {
    noteMemoryLacked();
    throw std::bad_alloc();
  });
}

}  // namespace

LastResort::LastResort(Interrupt& interrupt) {
  g_interrupt = &interrupt;
  catchCrashes();
  std::atexit(endedFromWithin);
  CPLSetErrorHandler([](CPLErr severity, CPLErrorNum code, const char* message) {
    if (severity == CE_Fatal) std::terminate();
    CPLDefaultErrorHandler(severity, code, message);
  });
}

LastResort::~LastResort() { g_interrupt = nullptr; }

void exitIsCalled() {
  if (!g_finished && !memoryLacked()) return;
  removeWhatIsHalfWritten();
  end(kNoMemory, nullptr);
}

void finishedWith(int code) { g_finished = code; }

}  // namespace coastmesh
