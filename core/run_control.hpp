#pragma once

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

}  // namespace coastmesh
