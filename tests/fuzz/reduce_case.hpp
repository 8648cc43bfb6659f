#pragma once

#include <functional>

#include "tests/fuzz/refine_case.hpp"

namespace coastmesh {

// Reduces a failing case while it still fails: simpler options, fewer rings, segments, vertices and hole points,
// coordinates with fewer digits. Calls `still_fails` at most `most_trials` times.
RefineCase reduceCase(RefineCase failing, const std::function<bool(const RefineCase&)>& still_fails, int most_trials);

}  // namespace coastmesh
