#include "gis/model/impossible_depths.hpp"

#include <cmath>
#include <cstdio>

#include "gis/coast/feature_names.hpp"

namespace coastmesh {

std::optional<ImpossibleDepths> impossibleDepths(const Grid& grid) {
  // The deepest place of the sea is 10.9 km deep, the highest mountain 8.8 km high; exactly 9999 means no value.
  constexpr double kDeepest = -12'000.0, kHighest = 9'000.0, kMark = 9'999.0;
  std::optional<ImpossibleDepths> found;
  for (std::size_t i = 0; i < grid.z.size(); ++i) {
    const double z = grid.z[i];
    if (!(z < kDeepest || z > kHighest || std::abs(z) == kMark)) continue;
    if (!found) found = ImpossibleDepths{0, i};
    ++found->nodes;
    if (std::abs(z) > std::abs(grid.z[found->worst])) found->worst = i;
  }
  return found;
}

std::string textOf(const ImpossibleDepths& found, const Grid& grid) {
  char text[140];
  std::snprintf(text, sizeof text, "%zu of %zu nodes %s depths that do not occur on Earth, such as %.10g m",
                found.nodes, grid.nodes.size(), found.nodes == 1 ? "has" : "have", 0.0 - grid.z[found.worst]);
  return text + (" at (" + roughPlaceInWords(grid.nodes[found.worst])) + ")";
}

}  // namespace coastmesh
