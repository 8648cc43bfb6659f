#pragma once

#include "apps/cli/interrupt.hpp"

namespace coastmesh {

// Where an error cannot be thrown (memory lacks while another error is on its way, or in a library that ends the
// process then), and where the process crashes: what is half written goes, one line says so, and so does the exit code.
// Where a limit allows one, a crash leaves its core file all the same. One at a time.
class LastResort {
 public:
  explicit LastResort(Interrupt& interrupt);  // which has to stay as long
  ~LastResort();
  LastResort(const LastResort&) = delete;
  LastResort& operator=(const LastResort&) = delete;
};

// All is done, and the process is about to end with this code: memory that lacks after that changes nothing.
void finishedWith(int code);

// What LastResort does about terminate and crashes, from now on: for memory that lacks before main, in constructors of
// libraries. Asks for none itself.
void catchCrashes();

// What the system lacks by the exception that is being handled, in words for the user; null if it is another error.
const char* whatLacks();

// A thread could not be started: a crash after that is its consequence. Called by `watch_memory`, from any thread.
void noteThreadLacked() noexcept;

// To be called before the line that says why the process ends, which several threads may come to at once: all but the
// first wait here for the end, and go on only where it does not come.
void beFirstToTell();

// Somebody calls exit(), which only a library does: ends the process as main would have where that is done, and as one
// that lacked memory where it did. Returns otherwise.
void exitIsCalled();

inline constexpr const char* kNoMemory =
    "this takes more memory than there is; mesh the input in parts, or ask for larger triangles";
inline constexpr const char* kNoThread =
    "the system starts no further thread for this process; ask for fewer --threads, or raise its limits (ulimit -u, "
    "ulimit -v, or those of the container)";

}  // namespace coastmesh
