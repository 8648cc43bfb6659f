#pragma once

#include <span>

#include "gis/rivers/mesh_water.hpp"
#include "gis/rivers/river_course.hpp"

namespace coastmesh {

// Limits the rows of each course, where it is in the water, to the distance between its bank and that of another one, or
// of a remote part of its own, or the shore: the water between them is filled with triangles, which cannot be good beside edges that are
// longer. `longest`: the rows' own length, for each course.
void limitRows(std::span<RiverCourse> courses, std::span<const double> longest, const MeshWater& water);

}  // namespace coastmesh
