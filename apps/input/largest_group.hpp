#pragma once

#include <optional>

#include "apps/input/job_input.hpp"

namespace coastmesh {

// The group with the largest area within the frame, and its domain.
struct LargestGroup {
  std::size_t group = 0;
  Domain domain;
  double share = 1.0;  // of the area of all groups, by their polygons as they are, beyond the frame too
};

// Returns nullopt if nothing of the input can be meshed. Of equal groups, returns the first.
std::optional<LargestGroup> largestGroup(const JobInput& input, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
