#pragma once

#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// Area that each feature keeps in the plane, by the even-odd rule and "first come, first served": slab by slab between
// all vertices and all crossings, from the coordinates as given. Slow (quadratic and more); for tests.
std::vector<double> evenOddAreas(const std::vector<Feature>& features);

}  // namespace coastmesh
