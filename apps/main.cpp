#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "apps/cli/program.hpp"
#include "apps/process/exit_codes.hpp"
#include "apps/process/interrupt.hpp"
#include "apps/process/keeper.hpp"
#include "apps/process/last_resort.hpp"
#include "apps/process/memory_lacked.hpp"
#include "apps/usage/command_line.hpp"
#include "cluster/cluster.hpp"
#include "cluster/ranks_started.hpp"
#include "cluster/serve.hpp"
#include "core/run_control.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/error.hpp"
#include "parallel/deal.hpp"
#include "parallel/free_memory.hpp"

namespace {

using namespace coastmesh;

int fail(ExitCode code, const std::string& message) {
  beFirstToTell();
  std::fprintf(stderr, "coastmesh: error: %s\n", oneLine(message).c_str());
  return code;
}

// An error after an allocation failed is mostly its consequence, whatever its message.
int failWith(ExitCode code, const std::string& message) {
  if (!memoryLacked()) return fail(code, message);
  return fail(kExitInput, code == kExitBug ? kNoMemory : message + " (memory lacked before that: it may be why)");
}

// A file opened while standard output or error is closed would receive what is printed.
void holdStandardStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) >= 0) continue;
    // Read only, so that writing to it fails as with a closed stream.
    [[maybe_unused]] const int held = open("/dev/null", O_RDONLY);
  }
}

// Returns whether everything printed was written; sets `why` if not.
bool flushOutput(std::string& why) {
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  if (flushed && std::ferror(stdout) == 0) return true;
  why = std::string("cannot write to standard output") + (errno != 0 ? std::string(": ") + std::strerror(errno) : "");
  return false;
}

// Ranks that help in a run: all processes started with this one, if they are to make one mesh.
int ranksOf(int argc, char** argv) {
  const auto isShard = [](const char* argument) { return std::string_view(argument).starts_with("--shard"); };
  const bool together = argc > 1 && std::string_view(argv[1]) == "mesh" && std::none_of(argv + 2, argv + argc, isShard);
  return together ? ranksStarted() : 1;
}

// Rank 0 runs the program, the others help it.
int runAmongRanks(int argc, char** argv, Interrupt& interrupt, int ranks) {
  std::string command;
  for (int i = 1; i < argc; ++i) command.append(argv[i]).push_back('\0');
  const auto stopped = [&interrupt] { return interrupt.signalled(); };
  Post post(joinRanks, ranks, std::hash<std::string>()(command));
  if (post.rank() != 0) return serveRankZero(post, helpIn(interrupt)) ? kExitDone : kExitInterrupted;
  Cluster cluster(post, stopped);
  return runProgram(argc, argv, interrupt, &cluster);
}

// The only place where errors become messages and exit codes.
int guardedMain(int argc, char** argv, Interrupt& interrupt, int ranks) {
  std::string why;
  try {
    int code = kExitDone;
    try {
      code = ranks > 1 ? runAmongRanks(argc, argv, interrupt, ranks) : runProgram(argc, argv, interrupt, nullptr);
    } catch (const UsageText& asked) {
      std::fputs(asked.text.c_str(), stdout);
    }
    if (!flushOutput(why)) return failWith(kExitOutput, why);
    // What was printed may be wrong.
    const bool told = code == kExitDone || code == kExitShort;
    return told && memoryLackedForOutputs() ? fail(kExitInput, kNoMemory) : code;
  } catch (const CannotJoin& error) {
    return failWith(kExitUsage, error.what());
  } catch (const OptionError& error) {
    return failWith(kExitUsage, error.what());
  } catch (const InputError& error) {
    return failWith(kExitInput, error.what());
  } catch (const BadPslg& error) {
    return failWith(kExitInput, error.what());
  } catch (const OutputError& error) {
    return failWith(kExitOutput, error.what());
  } catch (const Cancelled&) {
    // The reader of the progress has ended, or cannot store it.
    if (!interrupt.requested() && !flushOutput(why)) return failWith(kExitOutput, why);
    return fail(kExitInterrupted, "interrupted");
  } catch (const HelperOutOfMemory& error) {
    return fail(kExitInput, error.what());
  } catch (const std::exception& error) {
    if (const char* const lacking = whatLacks(); lacking != nullptr) return fail(kExitInput, lacking);
    return failWith(kExitBug, std::string("this is a bug in coastmesh, please report it: ") + error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  keepFreedMemory();
  holdStandardStreams();
  const int ranks = ranksOf(argc, argv);
  std::optional<Keeper> keeper;
  if (ranks > 1) keeper.emplace(Keeper::Lost{rankStarted(), tellLauncher});
  Interrupt interrupt(keeper ? [&keeper](const auto& folder, bool guarded) { keeper->note(folder, guarded); }
                             : Interrupt::Notes());
  const LastResort last_resort(interrupt);
  const int code = guardedMain(argc, argv, interrupt, ranks);
  finishedWith(code);
  return code;
}
