#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace coastmesh {

// The gap between the sides of a weir, in metres (in a plane: in its units).
struct WeirGaps {
  double least = 0.0, most = 0.0;
};

// What `openWeirs` made.
struct WeirReport {
  std::size_t boundaries = 0, pairs = 0;
  std::size_t walls = 0;  // edges of these weirs that water does not pass, at their ends and where they meet
  WeirGaps gaps;
  std::vector<std::string> names;     // of the lines that they were, each once
  std::vector<std::string> warnings;  // lines that stay edges

  std::vector<std::string> notes() const;
};

}  // namespace coastmesh
