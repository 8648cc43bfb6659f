#pragma once

#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// The area in the plane that each feature keeps by the even-odd rule, with earlier features taking precedence: sums
// slabs between all vertices and all crossings, from the coordinates as given. Quadratic or slower; for tests.
std::vector<double> evenOddAreas(const std::vector<Feature>& features);

}  // namespace coastmesh
