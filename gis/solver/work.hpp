#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gis/elements/elements.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// The work of each element or node as whole numbers in proportion to `work`, 1 or more, whose sum fits 32 bits.
// REQUIRES: `work` is finite, not negative and not 0 throughout.
std::vector<std::int32_t> wholeWeights(const std::vector<double>& work);

// The values of a nodal attribute as the work of nodes; that of an element is the mean of its nodes. Throws InputError
// if there is no such attribute, and if a value is unknown or negative, or all are 0.
std::vector<double> workOfNodes(const Grid& grid, const std::string& attribute);
std::vector<double> workOfElements(const Grid& grid, const Elements& elements, const std::string& attribute);

}  // namespace coastmesh
