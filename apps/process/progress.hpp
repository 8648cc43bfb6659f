#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

namespace coastmesh {

// What --progress shows: on stderr a bar on a terminal, or occasional lines in a log; on stdout one JSON object per
// line, {"phase":"refine","share":0.42}.
class ProgressDisplay {
 public:
  enum class Style { None, Bar, Log, Json };
  // "auto": a bar on a terminal that can move its cursor; lines if stderr is a file or a pipe, or if the environment
  // variable CI is set; nothing if `quiet`.
  static Style styleFor(const std::string& name, bool quiet);

  explicit ProgressDisplay(Style style) : style_(style) {}
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  // Shows the start and end of every phase, and its progress at most ten times a second. A log has a line every ten
  // seconds instead, the first after ten seconds.
  void show(std::string_view phase, double share);
  // True if nobody reads the JSON lines any more: the caller is gone. May be called often, from several threads.
  bool abandoned();
  // Erases the bar, so that a message gets its own line.
  void clear();
  // Prints a line on stderr where there is a bar or a log. May be called from any thread.
  void note(const std::string& text);

 private:
  using Clock = std::chrono::steady_clock;

  void showBar();
  void clearBar();
  double secondsSoFar() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  Style style_;
  std::mutex mutex_;  // of all that is shown
  Clock::time_point start_ = Clock::now();
  std::string phase_;
  double shown_ = -1.0;
  Clock::time_point shown_at_ = start_;
  bool bar_visible_ = false;
  std::atomic<bool> abandoned_{false};
  std::atomic<std::int64_t> asked_ms_{0};  // last check by `abandoned`, on the steady clock
};

// "refine [#####     ]  50 %  1:05", at most `width` columns; the bar is left out first, then the time.
std::string progressLine(std::string_view phase, double share, double seconds, int width);

}  // namespace coastmesh
