#include "apps/process/memory_lacked.hpp"

#include <atomic>
#include <new>

namespace coastmesh {

namespace {

// Initialised before any constructor runs.
constinit std::atomic<bool> g_lacked{false}, g_lacked_for_outputs{false}, g_in_place{false};

}  // namespace

void noteMemoryLacked() noexcept {
  g_lacked = true;
  if (!g_in_place) g_lacked_for_outputs = true;
}

bool memoryLacked() noexcept { return g_lacked; }

void requireMemoryHeld() {
  if (g_lacked) throw std::bad_alloc();
}

void outputsAreInPlace() noexcept { g_in_place = true; }

bool memoryLackedForOutputs() noexcept { return g_lacked_for_outputs; }

}  // namespace coastmesh
