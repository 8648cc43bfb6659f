#include "tests/fuzz/isolated.hpp"

#include <signal.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "tests/fuzz/shared_block.hpp"

namespace coastmesh {

namespace {

struct Answer {
  Verdict verdict;
  std::uint64_t vertices;
  char failure[200];
  char detail[1000];
};

template <std::size_t n>
void copyText(const std::string& text, char (&to)[n]) {
  const std::size_t length = std::min(text.size(), n - 1);
  std::memcpy(to, text.data(), length);
  to[length] = '\0';
}

}  // namespace

void limitCpuTime(unsigned cpu_seconds) {
  const itimerval limit{{0, 0}, {static_cast<time_t>(cpu_seconds), 0}};
  setitimer(ITIMER_PROF, &limit, nullptr);
}

std::string howItDied(int wait_status) {
  if (WIFSIGNALED(wait_status)) {
    if (WTERMSIG(wait_status) == SIGPROF) return "does not end";
    return std::string("crash: ") + strsignal(WTERMSIG(wait_status));
  }
  return WEXITSTATUS(wait_status) == 0 ? "" : "crash: exit code " + std::to_string(WEXITSTATUS(wait_status));
}

CaseResult runIsolated(const RefineCase& refine_case, const CaseLimits& limits, unsigned cpu_seconds) {
  SharedBlock<Answer> answer;
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a child process");
  if (child == 0) {
    limitCpuTime(cpu_seconds);
    const CaseResult result = runCase(refine_case, limits);
    answer->verdict = result.verdict;
    answer->vertices = result.vertices;
    copyText(result.failure, answer->failure);
    copyText(result.detail, answer->detail);
    _exit(0);
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child) throw std::runtime_error("cannot wait for a child process");
  CaseResult result;
  result.failure = howItDied(status);
  if (!result.failure.empty()) {
    result.verdict = Verdict::Failed;
    return result;
  }
  return {answer->verdict, answer->failure, answer->detail, answer->vertices};
}

}  // namespace coastmesh
