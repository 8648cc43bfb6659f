#pragma once

#include "core/space_point.hpp"

namespace coastmesh {

// Metres; on Earth from its centre.
struct SpaceBall {
  SpacePoint centre;
  double radius = 0.0;
};

}  // namespace coastmesh
