#include "gis/model/impossible_depths.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "gis/places.hpp"

namespace coastmesh {

std::optional<ImpossibleDepths> impossibleDepths(const Grid& grid) {
  // The deepest place of the sea is 10.9 km deep, the highest mountain 8.8 km high.
  constexpr double kDeepest = -12'000.0, kHighest = 9'000.0;
  const auto isImpossible = [](double z) { return z < kDeepest || z > kHighest; };
  const auto count = static_cast<std::size_t>(std::ranges::count_if(grid.z, isImpossible));
  if (count == 0) return std::nullopt;
  const auto worst = std::ranges::max_element(grid.z, [](double a, double b) {
    const auto size = [](double z) { return std::isnan(z) ? 0.0 : std::abs(z); };
    return size(a) < size(b);
  });
  return ImpossibleDepths{count, static_cast<std::size_t>(worst - grid.z.begin())};
}

std::string textOf(const ImpossibleDepths& found, const Grid& grid) {
  char text[140];
  std::snprintf(text, sizeof text, "%zu of %zu nodes %s depths that do not occur on Earth, such as %.10g m",
                found.nodes, grid.nodes.size(), found.nodes == 1 ? "has" : "have", 0.0 - grid.z[found.worst]);
  return text + (" at (" + roughPlaceInWords(grid.nodes[found.worst])) + ")";
}

}  // namespace coastmesh
