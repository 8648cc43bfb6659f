#pragma once

#include "core/point.hpp"

namespace coastmesh {

struct SizeBox {  // a square
  Point centre;
  double half = 0.0;
};

}  // namespace coastmesh
