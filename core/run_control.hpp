#pragma once

#include <functional>
#include <stdexcept>

namespace coastmesh {

// Thrown out of any long stage soon after `RunControl::cancelled` returns true. Nothing of the stage's result is kept.
struct Cancelled : std::runtime_error {
  Cancelled() : std::runtime_error("interrupted") {}
};

// How a long stage talks to whoever started it. Both functions may be empty, and are called from the stage's own
// thread, every few thousand steps.
struct RunControl {
  std::function<bool()> cancelled;
  std::function<void(double)> progress;  // share of the stage that is done, 0 to 1, an estimate

  void checkpoint(double share) const {
    if (cancelled && cancelled()) throw Cancelled();
    if (progress) progress(share);
  }
};

}  // namespace coastmesh
