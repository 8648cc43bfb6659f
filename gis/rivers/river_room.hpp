#pragma once

#include <functional>
#include <span>

#include "core/point.hpp"
#include "gis/rivers/river_course.hpp"

namespace coastmesh {

// Limits the rows of each course, where `in_water`, to the distance between its bank and that of another one, or of a
// remote part of its own: the water between them is filled with triangles, which cannot be good beside edges that are
// longer. `longest`: the rows' own length, for each course.
void limitRows(std::span<RiverCourse> courses, std::span<const double> longest,
               const std::function<bool(const Point&)>& in_water);

}  // namespace coastmesh
