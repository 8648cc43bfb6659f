#include "gis/check/check_weirs.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace coastmesh {

std::vector<TargetDefect> checkWeirs(const Grid& grid) {
  // Of the values at a node: the crest and its two coefficients, then the height of a pipe.
  constexpr std::size_t kPipe = 3;
  std::vector<TargetDefect> found;
  if (grid.z.empty()) return found;
  for (const Boundary& weir : grid.boundaries) {
    if (weir.weir.empty()) continue;
    const std::size_t values = weir.weir.size() / weir.nodes.size();
    for (std::size_t i = 0; i < weir.nodes.size(); ++i) {
      const double* const at = &weir.weir[i * values];
      const double lowest = values > kPipe ? std::min(at[0], at[kPipe]) : at[0];
      for (const auto* const shore : {&weir.nodes, &weir.back_nodes}) {
        if (shore->empty()) continue;
        const std::uint32_t node = (*shore)[i];
        if (grid.z[node] > lowest)
          found.push_back({TargetDefectKind::BedAboveCrest, grid.nodes[node], -1, node, grid.z[node] - lowest, {}});
      }
    }
  }
  return found;
}

}  // namespace coastmesh
