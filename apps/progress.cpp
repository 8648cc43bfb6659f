#include "apps/progress.hpp"

#include <poll.h>
#include <unistd.h>

#include <cstdio>

namespace coastmesh {

namespace {

constexpr auto kInterval = std::chrono::milliseconds(100);
constexpr int kBarWidth = 40;

}  // namespace

ProgressDisplay::Style ProgressDisplay::styleFor(const std::string& name, bool quiet) {
  if (name == "json") return Style::Json;
  if (name == "bar") return Style::Bar;
  if (name == "auto" && !quiet && isatty(STDERR_FILENO) == 1) return Style::Bar;
  return Style::None;
}

void ProgressDisplay::show(std::string_view phase, double share) {
  if (style_ == Style::None) return;
  const auto now = std::chrono::steady_clock::now();
  const bool same_phase = phase == phase_;
  const bool finished = share >= 1.0;
  if (same_phase && (share <= shown_ || (!finished && now - shown_at_ < kInterval))) return;
  phase_ = phase;
  shown_ = share;
  shown_at_ = now;
  if (style_ == Style::Json) {
    std::printf("{\"phase\":\"%s\",\"share\":%.4f}\n", phase_.c_str(), share);
    if (std::fflush(stdout) != 0) abandoned_ = true;
    return;
  }
  const int filled = static_cast<int>(share * kBarWidth);
  std::fprintf(stderr, "\r%-6s [%-*s] %3d %%", phase_.c_str(), kBarWidth,
               std::string(static_cast<std::size_t>(filled), '#').c_str(), static_cast<int>(share * 100));
  std::fflush(stderr);
  bar_visible_ = true;
}

bool ProgressDisplay::abandoned() {
  if (style_ != Style::Json || abandoned_) return abandoned_;
  using namespace std::chrono;
  const std::int64_t now = duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
  std::int64_t asked = asked_ms_;
  if (now - asked < kInterval.count() || !asked_ms_.compare_exchange_strong(asked, now)) return false;
  // A pipe whose reader is gone shows as an error, without a line that would have to be written to it.
  pollfd pipe{STDOUT_FILENO, 0, 0};
  if (poll(&pipe, 1, 0) == 1 && (pipe.revents & POLLERR) != 0) abandoned_ = true;
  return abandoned_;
}

void ProgressDisplay::clear() {
  if (!bar_visible_) return;
  std::fprintf(stderr, "\r%*s\r", kBarWidth + 20, "");
  std::fflush(stderr);
  bar_visible_ = false;
}

}  // namespace coastmesh
