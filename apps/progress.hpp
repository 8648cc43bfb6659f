#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace coastmesh {

// What --progress shows: a bar on stderr, or one JSON object a line on stdout: {"phase":"refine","share":0.42}.
class ProgressDisplay {
 public:
  enum class Style { None, Bar, Json };
  // "auto" is a bar where stderr is a terminal and `quiet` is not asked for.
  static Style styleFor(const std::string& name, bool quiet);

  explicit ProgressDisplay(Style style) : style_(style) {}
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  // The start and the end of every phase are shown, what lies between at most ten times a second.
  void show(std::string_view phase, double share);
  // Whether nobody reads the JSON lines any more: who asked for the run is gone.
  // May be called from several threads, and often.
  bool abandoned();
  // Takes the bar off the terminal, so that a message has the line to itself.
  void clear();

 private:
  Style style_;
  std::string phase_;
  double shown_ = -1.0;
  std::chrono::steady_clock::time_point shown_at_;
  bool bar_visible_ = false;
  std::atomic<bool> abandoned_{false};
  std::atomic<std::int64_t> asked_ms_{0};  // when `abandoned` last looked, on the steady clock
};

}  // namespace coastmesh
