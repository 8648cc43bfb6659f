#include "tests/fuzz/placement.hpp"

#include <cmath>

namespace coastmesh {

Placement randomPlacement(Choices& choices) {
  Placement placement;
  if (choices.oneIn(3)) {
    const double turn = choices.oneIn(2) ? toRadians(choices.between(0.0, 360.0)) : toRadians(45.0);
    placement.cosine = std::cos(turn);
    placement.sine = std::sin(turn);
  }
  if (choices.oneIn(3)) placement.scale = std::pow(10.0, static_cast<int>(choices.below(13)) - 6);
  if (choices.oneIn(4)) {
    const double far = placement.scale * std::pow(10.0, choices.below(7));
    const double x = choices.between(-far, far);
    placement.offset = {x, choices.between(-far, far)};
  }
  return placement;
}

}  // namespace coastmesh
