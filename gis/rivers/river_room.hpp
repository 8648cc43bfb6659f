#pragma once

#include <span>

#include "gis/rivers/mesh_water.hpp"
#include "gis/rivers/river_course.hpp"

namespace coastmesh {

// Limits the rows of each course: where a shore passes it, to the length of the shore's edges; and, with `in_water`,
// to the distance between its bank and that of another course, or of a remote part of its own, or the shore, where it
// is in the water. The water beside rows is filled with triangles, which cannot be good beside edges that are longer.
// `longest`: the rows' own length, for each course.
void limitRows(std::span<RiverCourse> courses, std::span<const double> longest, const MeshWater& water, bool in_water);

}  // namespace coastmesh
