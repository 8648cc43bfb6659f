#pragma once

#include <vector>

namespace coastmesh {

// Depths in metres, positive down, of the levels that are written for FESOM2: layers of 5 m down to 10 m and of 10 m
// down to 100 m; then each is 1.15 times as thick as the one above, rounded to 5 m and at most 250 m, until the levels
// are deeper than all but trenches.
std::vector<int> fesomLevelDepths();

}  // namespace coastmesh
