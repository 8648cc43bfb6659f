#pragma once

#include "gis/coast/coastline.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

// The box of all parts of a feature: rings, lines and points, in the input's CRS.
Box boundsOf(const Feature& feature);

}  // namespace coastmesh
