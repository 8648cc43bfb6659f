#include "apps/process/progress.hpp"

#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace coastmesh {

namespace {

constexpr auto kInterval = std::chrono::milliseconds(100);
constexpr auto kLogInterval = std::chrono::seconds(10);
constexpr int kWidestBar = 40;
constexpr int kNarrowestBar = 5;

bool isSet(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0' && std::string_view(value) != "false" && std::string_view(value) != "0";
}

// True if lines on stderr can be overwritten.
bool hasCursor() {
  const char* terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && terminal != nullptr && std::string_view(terminal) != "dumb" && !isSet("CI");
}

int terminalWidth() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

// A program in the background must not write to the terminal.
bool inForeground() {
  const pid_t foreground = tcgetpgrp(STDERR_FILENO);
  return foreground < 0 || foreground == getpgrp();
}

std::string clockText(double seconds) {
  char text[32];
  const auto whole = static_cast<long>(seconds);
  if (whole < 3600) {
    std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  }
  return text;
}

}  // namespace

std::string progressLine(std::string_view phase, double share, double seconds, int width) {
  share = std::clamp(share, 0.0, 1.0);
  char percent[16];
  std::snprintf(percent, sizeof percent, "%3d %%", static_cast<int>(share * 100));
  char name[64];
  std::snprintf(name, sizeof name, "%-7.*s", static_cast<int>(std::min<std::size_t>(phase.size(), 50)), phase.data());
  std::string line = std::string(name) + percent;
  const std::string time = "  " + clockText(seconds);
  const int room = width - static_cast<int>(line.size() + time.size()) - 3;  // brackets, and a blank after them
  if (room >= kNarrowestBar) {
    const int length = std::min(room, kWidestBar);
    const int filled = static_cast<int>(share * length);
    line = std::string(name) + "[" + std::string(static_cast<std::size_t>(filled), '#') +
           std::string(static_cast<std::size_t>(length - filled), ' ') + "] " + percent;
  }
  if (static_cast<int>(line.size() + time.size()) <= width) line += time;
  return line.substr(0, static_cast<std::size_t>(std::max(0, width)));
}

ProgressDisplay::Style ProgressDisplay::styleFor(const std::string& name, bool quiet) {
  if (name == "json") return Style::Json;
  if (name == "bar") return Style::Bar;
  if (name == "log") return Style::Log;
  if (name != "auto" || quiet) return Style::None;
  return hasCursor() ? Style::Bar : Style::Log;
}

void ProgressDisplay::show(std::string_view phase, double share) {
  if (style_ == Style::None) return;
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  const bool same_phase = phase == phase_;
  const bool finished = share >= 1.0;
  if (style_ == Style::Log) {
    if (now - shown_at_ < kLogInterval || finished) return;
  } else if (same_phase && (share <= shown_ || (!finished && now - shown_at_ < kInterval))) {
    return;
  }
  phase_ = phase;
  shown_ = share;
  shown_at_ = now;
  if (style_ == Style::Json) {
    std::printf("{\"phase\":\"%s\",\"share\":%.4f}\n", phase_.c_str(), share);
    if (std::fflush(stdout) != 0) abandoned_ = true;
  } else if (style_ == Style::Log) {
    std::fprintf(stderr, "coastmesh: %s %d %%, %s\n", phase_.c_str(), static_cast<int>(share * 100),
                 clockText(secondsSoFar()).c_str());
  } else {
    showBar();
  }
}

void ProgressDisplay::showBar() {
  if (!inForeground()) return;
  // One column is left free: some terminals wrap after a full line.
  std::string line = progressLine(phase_, shown_, secondsSoFar(), terminalWidth() - 1);
  // Returns to the start of the line, prints, and erases the rest of a longer one.
  std::fprintf(stderr, "\r%s\033[K", line.c_str());
  std::fflush(stderr);
  bar_visible_ = true;
}

bool ProgressDisplay::abandoned() {
  if (style_ != Style::Json || abandoned_) return abandoned_;
  using namespace std::chrono;
  const std::int64_t now = duration_cast<milliseconds>(Clock::now().time_since_epoch()).count();
  std::int64_t asked = asked_ms_;
  if (now - asked < kInterval.count() || !asked_ms_.compare_exchange_strong(asked, now)) return false;
  // Detects that the reader of a pipe is gone without writing to it.
  pollfd pipe{STDOUT_FILENO, 0, 0};
  if (poll(&pipe, 1, 0) == 1 && (pipe.revents & POLLERR) != 0) abandoned_ = true;
  return abandoned_;
}

void ProgressDisplay::clear() {
  const std::lock_guard lock(mutex_);
  clearBar();
}

void ProgressDisplay::note(const std::string& text) {
  if (style_ != Style::Bar && style_ != Style::Log) return;
  const std::lock_guard lock(mutex_);
  clearBar();
  std::fprintf(stderr, "coastmesh: %s\n", text.c_str());
}

void ProgressDisplay::clearBar() {
  if (!bar_visible_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  bar_visible_ = false;
}

}  // namespace coastmesh
