#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>

#include "apps/cli/exit_codes.hpp"
#include "apps/cli/interrupt.hpp"
#include "apps/cli/last_resort.hpp"
#include "apps/cli/program.hpp"
#include "apps/usage/command_line.hpp"
#include "core/delaunay.hpp"
#include "core/run_control.hpp"
#include "gis/error.hpp"

namespace {

using namespace coastmesh;

int fail(ExitCode code, const std::string& message) {
  std::fprintf(stderr, "coastmesh: error: %s\n", oneLine(message).c_str());
  return code;
}

// A file opened where standard output or error was closed would take what is printed.
void holdStandardStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) >= 0) continue;
    // Read only, so that a write to it fails as one to a closed stream does.
    [[maybe_unused]] const int held = open("/dev/null", O_RDONLY);
  }
}

// Whether all that was printed has come out.
bool flushOutput(std::string& why) {
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  if (flushed && std::ferror(stdout) == 0) return true;
  why = std::string("cannot write to standard output") + (errno != 0 ? std::string(": ") + std::strerror(errno) : "");
  return false;
}

// The only place where errors become messages and exit codes.
int guardedMain(int argc, char** argv, Interrupt& interrupt) {
  std::string why;
  try {
    int code = kExitDone;
    try {
      code = runProgram(argc, argv, interrupt);
    } catch (const UsageText& asked) {
      std::fputs(asked.text.c_str(), stdout);
    }
    return flushOutput(why) ? code : fail(kExitOutput, why);
  } catch (const OptionError& error) {
    return fail(kExitUsage, error.what());
  } catch (const InputError& error) {
    return fail(kExitInput, error.what());
  } catch (const BadPslg& error) {
    return fail(kExitInput, error.what());
  } catch (const OutputError& error) {
    return fail(kExitOutput, error.what());
  } catch (const Cancelled&) {
    // Whoever reads the progress is gone, or cannot store it.
    if (!interrupt.requested() && !flushOutput(why)) return fail(kExitOutput, why);
    return fail(kExitInterrupted, "interrupted");
  } catch (const std::bad_alloc&) {
    return fail(kExitInput, kNoMemory);
  } catch (const std::exception& error) {
    return fail(kExitBug, std::string("this is a bug of coastmesh, please report it: ") + error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  holdStandardStreams();
  Interrupt interrupt;
  const LastResort last_resort(interrupt);
  const int code = guardedMain(argc, argv, interrupt);
  finishedWith(code);
  return code;
}
