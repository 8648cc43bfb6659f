#pragma once

#include "apps/process/interrupt.hpp"

namespace coastmesh {

// Handles errors that cannot be thrown (an allocation fails while another error is thrown, or in a library that then
// ends the process) and crashes: removes unfinished outputs, prints one line, and ends with the matching exit code. If
// a limit allows it, a crash still leaves its core file. One instance at a time.
class LastResort {
 public:
  explicit LastResort(Interrupt& interrupt);  // must outlive this
  ~LastResort();
  LastResort(const LastResort&) = delete;
  LastResort& operator=(const LastResort&) = delete;
};

// All is done and the process is about to end with this code: later failures of allocations have no effect.
void finishedWith(int code);

// Installs the handlers of LastResort for terminate and crashes; also called if an allocation fails before main, in
// constructors of libraries. Allocates nothing itself.
void catchCrashes();

// What the system lacks according to the exception that is being handled, as a message; null for any other exception.
const char* whatLacks();

// A thread could not be started: a crash after that is its consequence. Called by `watch_memory`, from any thread.
void noteThreadLacked() noexcept;

// To be called before printing why the process ends, which several threads may do at once. All but the first wait here
// for the end, and return only if it does not come within ten seconds.
void beFirstToTell();

// Called by exit(), which only libraries call. Ends the process with main's exit code if main is done, and for lack of
// memory if an allocation failed. Returns otherwise.
void exitIsCalled();

inline constexpr const char* kNoMemory =
    "this takes more memory than there is; mesh the input in parts, or ask for larger triangles";
inline constexpr const char* kNoThread =
    "the system starts no further thread for this process; ask for fewer --threads, or raise its limits (ulimit -u, "
    "ulimit -v, or those of the container)";

}  // namespace coastmesh
