#include "gis/globe/fesom_levels.hpp"

#include <algorithm>
#include <cmath>

namespace coastmesh {

std::vector<int> fesomLevelDepths() {
  constexpr int kEvenDown = 100, kThickest = 250, kStep = 5, kDeepest = 6000;
  std::vector<int> depths{0, 5};
  for (int depth = 10; depth <= kEvenDown; depth += 10) depths.push_back(depth);
  for (double thickness = 10.0; depths.back() < kDeepest;) {
    thickness = std::min<double>(1.15 * thickness, kThickest);
    depths.push_back(depths.back() + kStep * static_cast<int>(std::lround(thickness / kStep)));
  }
  return depths;
}

}  // namespace coastmesh
