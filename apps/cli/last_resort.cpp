#include "apps/cli/last_resort.hpp"

#include <cpl_error.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <new>
#include <optional>

#include "apps/cli/exit_codes.hpp"

namespace coastmesh {

namespace {

Interrupt* g_interrupt = nullptr;
std::optional<int> g_finished;

// Without an exception it is GDAL that ends the process, which it does where memory lacks.
bool memoryLacks() {
  const std::exception_ptr current = std::current_exception();
  if (!current) return true;
  try {
    std::rethrow_exception(current);
  } catch (const std::bad_alloc&) {
    return true;
  } catch (...) {
    return false;
  }
}

[[noreturn]] void endAtOnce() {
  if (g_finished) _exit(*g_finished);
  const bool memory = memoryLacks();
  if (g_interrupt != nullptr) g_interrupt->removeGuarded();
  std::fprintf(stderr, "coastmesh: error: %s\n",
               memory ? kNoMemory : "this is a bug of coastmesh, please report it: an error where none may be thrown");
  _exit(memory ? kExitInput : kExitBug);
}

}  // namespace

LastResort::LastResort(Interrupt& interrupt) {
  g_interrupt = &interrupt;
  std::set_terminate(endAtOnce);
  CPLSetErrorHandler([](CPLErr severity, CPLErrorNum code, const char* message) {
    if (severity == CE_Fatal) std::terminate();
    CPLDefaultErrorHandler(severity, code, message);
  });
}

LastResort::~LastResort() { g_interrupt = nullptr; }

void finishedWith(int code) { g_finished = code; }

}  // namespace coastmesh
