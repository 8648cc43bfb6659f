#include "apps/process/keeper.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/ioctl.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "apps/process/exit_codes.hpp"
#include "apps/process/interrupt.hpp"
#include "gis/file/remove_folder.hpp"

namespace coastmesh {

namespace {

constexpr char kGuarded = '+', kReleased = '-';

volatile sig_atomic_t g_child = 0;

void passOn(int signal_number) {
  const int before = errno;
  if (g_child > 0) kill(g_child, signal_number);
  errno = before;
}

// Applies the complete notes in `text` and leaves the beginning of the next one.
void takeNotes(std::string& text, std::set<std::string>& folders) {
  std::size_t end = 0;
  while ((end = text.find('\0')) != std::string::npos) {
    const std::string folder = text.substr(1, end - 1);
    text.front() == kGuarded ? void(folders.insert(folder)) : void(folders.erase(folder));
    text.erase(0, end + 1);
  }
}

// The folders to remove once the child has ended.
std::set<std::string> foldersLeft(int from_child) {
  std::set<std::string> folders;
  std::string text;
  std::array<char, 4096> some{};
  for (;;) {
    const ssize_t count = read(from_child, some.data(), some.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return folders;
    text.append(some.data(), static_cast<std::size_t>(count));
    takeNotes(text, folders);
  }
}

// Under another name, so that users who look for the working process do not find the others.
void nameAs([[maybe_unused]] const char* name) {
#ifdef __linux__
  prctl(PR_SET_NAME, name);
#endif
}

// Forks a sweeper, which removes the guarded folders once the child has ended, for any reason. No signal to the run or
// its group reaches it, and it holds no file by which the run's end is detected.
pid_t makeSweeper(int from_child, int to_sweeper) {
  const pid_t sweeper = fork();
  if (sweeper != 0) return sweeper;
  nameAs("coastmesh-sweep");
  setsid();
  for (const int signal_number : stopSignals()) signal(signal_number, SIG_IGN);
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
  close(to_sweeper);
  constexpr int kMostOpen = 1024;
  for (int other = STDERR_FILENO + 1; other < kMostOpen; ++other)
    if (other != from_child) close(other);
  for (const std::string& folder : foldersLeft(from_child)) removeFolder(folder.c_str());
  _exit(0);
}

int statusOf(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  return status;
}

// Launchers forward the output of ranks, and drop what they have not read once a rank has ended.
void awaitReaderOfErrors() {
  constexpr useconds_t kLook = 20'000, kPassedOn = 200'000;  // microseconds
  constexpr int kMostLooks = 100;
  struct stat stream {};
  if (fstat(STDERR_FILENO, &stream) != 0 || !S_ISFIFO(stream.st_mode)) return;
  int unread = 0;
  for (int i = 0; i < kMostLooks && ioctl(STDERR_FILENO, FIONREAD, &unread) == 0 && unread > 0; ++i) usleep(kLook);
  usleep(kPassedOn);
}

// MPI may crash a rank that reads from one that was just killed. The launcher ends the run when it sees the first rank
// end: let that be the killed one, whose end is the cause.
void awaitReportOfOthers() { sleep(1); }

[[noreturn]] void keep(pid_t child, pid_t sweeper, const Keeper::Lost& lost) {
  nameAs("coastmesh-keep");
  signal(SIGPIPE, SIG_IGN);
  const int status = statusOf(child);
  if (sweeper > 0) statusOf(sweeper);
  if (WIFEXITED(status)) {
    if (WEXITSTATUS(status) == kExitBug) awaitReportOfOthers();
    _exit(WEXITSTATUS(status));
  }
  std::fprintf(
      stderr,
      "coastmesh: error: rank %d was ended by signal %d (%s), which ends the run: outputs are complete or absent\n",
      lost.rank, WTERMSIG(status), strsignal(WTERMSIG(status)));
  awaitReaderOfErrors();
  lost.tell(kExitInterrupted);
  _exit(kExitInterrupted);
}

}  // namespace

Keeper::Keeper(const Lost& lost) {
  std::array<int, 2> pipe_ends{};
  if (pipe(pipe_ends.data()) != 0) return;
  const auto [from_child, to_sweeper] = pipe_ends;
  const pid_t parent = getpid();
  // Until the child is known, no signal may end only the parent.
  const std::vector<int> stopping = stopSignals();
  const sigset_t signals = setOf(stopping);
  sigset_t before;
  sigprocmask(SIG_BLOCK, &signals, &before);
  const pid_t sweeper = makeSweeper(from_child, to_sweeper);
  close(from_child);
  const pid_t child = fork();
  if (child > 0) {
    close(to_sweeper);
    g_child = child;
    struct sigaction action {};
    action.sa_handler = passOn;
    for (const int signal_number : stopping) sigaction(signal_number, &action, nullptr);
    sigprocmask(SIG_UNBLOCK, &signals, nullptr);
    keep(child, sweeper, lost);
  }
  if (child < 0) {
    close(to_sweeper);
    sigprocmask(SIG_SETMASK, &before, nullptr);
    return;
  }
  fcntl(to_sweeper, F_SETFD, FD_CLOEXEC);
  to_sweeper_ = to_sweeper;
  // A signal that ends the parent's group must not end the child before it has cleaned up.
  setpgid(0, 0);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
  if (getppid() != parent) raise(SIGTERM);
  sigprocmask(SIG_SETMASK, &before, nullptr);
}

Keeper::~Keeper() {
  if (to_sweeper_ >= 0) close(to_sweeper_);
}

void Keeper::note(const std::filesystem::path& folder, bool guarded) const noexcept {
  if (to_sweeper_ < 0) return;
  std::string_view path = folder.native();
  const char kind = guarded ? kGuarded : kReleased;
  // If this fails, the sweeper is gone.
  [[maybe_unused]] ssize_t written = write(to_sweeper_, &kind, 1);
  written = write(to_sweeper_, path.data(), path.size());
  written = write(to_sweeper_, "", 1);
}

}  // namespace coastmesh
