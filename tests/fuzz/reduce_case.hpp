#pragma once

#include <functional>

#include "tests/fuzz/refine_case.hpp"

namespace coastmesh {

// Makes a failing case smaller as long as it still fails: plainer options, fewer rings, segments, vertices and hole
// points, coordinates with fewer digits. Asks at most `most_trials` times.
RefineCase reduceCase(RefineCase failing, const std::function<bool(const RefineCase&)>& still_fails, int most_trials);

}  // namespace coastmesh
