#pragma once

#include <cstddef>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// Groups that are meshed at the same time.
struct Together {
  std::size_t groups = 1;     // of the run
  std::size_t points = 0;     // of all of them
  std::size_t at_a_time = 1;  // at most this many of them are meshed at once
};

// The part of `whole` bytes that a group may take while others are meshed at the same time: shares of any `at_a_time`
// groups sum to at most `whole`. A group that needs more than its share must be meshed alone.
double memoryShare(double whole, std::size_t points, const Together& together);

// Bytes of a finished grid's arrays.
double bytesHeldBy(const Grid& grid);

}  // namespace coastmesh
