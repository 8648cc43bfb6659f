#pragma once

#include <span>
#include <utility>
#include <vector>

#include "gis/clean/domain.hpp"
#include "gis/coast/coastline.hpp"

namespace coastmesh {

// The sides, in the domain's plane, of the features `frames` that are no farther from the domain than it is long.
std::vector<std::pair<Point, Point>> frameSidesNear(const Coastline& coastline, std::span<const std::size_t> frames,
                                                    const Domain& domain);

}  // namespace coastmesh
