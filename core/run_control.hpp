#pragma once

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace coastmesh {

// Thrown from any long stage soon after `RunControl::cancelled` returns true. The stage's result is discarded.
struct Cancelled : std::runtime_error {
  Cancelled() : std::runtime_error("interrupted") {}
};

// Communication of a long stage with its caller. Both functions may be empty, and are called from the stage's own
// thread, every few thousand steps.
struct RunControl {
  std::function<bool()> cancelled;
  std::function<void(double)> progress;  // completed share of the stage, 0 to 1, an estimate

  void checkpoint(double share) const {
    if (cancelled && cancelled()) throw Cancelled();
    if (progress) progress(share);
  }
};

// A part of the progress of a whole run, from 0 to 1.
struct ProgressPart {
  double from = 0.0, to = 1.0;

  // The share of the whole at which this share of the part is done.
  double at(double share) const { return from + (to - from) * std::clamp(share, 0.0, 1.0); }
  // A part of this part.
  ProgressPart part(double first, double last) const { return {at(first), at(last)}; }
};

// The control of a stage whose progress is this part of the progress that `control` reports. REQUIRES: `control`
// outlives the result.
inline RunControl stageControl(const RunControl& control, const ProgressPart& part) {
  if (!control.progress) return control;
  return {control.cancelled, [&control, part](double share) { control.progress(part.at(share)); }};
}

}  // namespace coastmesh
