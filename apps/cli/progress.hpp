#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace coastmesh {

// What --progress shows on stderr: a bar on a terminal, now and then a line in a log; or, on stdout, one JSON object a
// line: {"phase":"refine","share":0.42}.
class ProgressDisplay {
 public:
  enum class Style { None, Bar, Log, Json };
  // "auto" is a bar on a terminal that can move its cursor; lines where stderr goes to a file or a pipe, and where the
  // environment says that this is continuous integration; nothing where `quiet`.
  static Style styleFor(const std::string& name, bool quiet);

  explicit ProgressDisplay(Style style) : style_(style) {}
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  // The start and the end of every phase are shown, what lies between at most ten times a second; in a log nothing in
  // the first ten seconds, and a line every ten seconds from then on.
  void show(std::string_view phase, double share);
  // Whether nobody reads the JSON lines any more: who asked for the run is gone.
  // May be called from several threads, and often.
  bool abandoned();
  // Takes the bar off the terminal, so that a message has the line to itself.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  void showBar();
  double secondsSoFar() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  Style style_;
  Clock::time_point start_ = Clock::now();
  std::string phase_;
  double shown_ = -1.0;
  Clock::time_point shown_at_ = start_;
  bool bar_visible_ = false;
  std::atomic<bool> abandoned_{false};
  std::atomic<std::int64_t> asked_ms_{0};  // when `abandoned` last looked, on the steady clock
};

// "refine [#####     ]  50 %  1:05", at most `width` columns; the bar gives way first, then the time.
std::string progressLine(std::string_view phase, double share, double seconds, int width);

}  // namespace coastmesh
