#pragma once

#include <array>

#include "core/triangulate/triangulation.hpp"

namespace coastmesh {

// A direction in which points are ordered: to the right, or upwards and, among points of equal height, to the left.
enum class Sweep { Right, Up };

bool isBefore(Sweep sweep, const Point& a, const Point& b);

// Merges the Delaunay triangulations of two sets of points in the same array, of which all points of the first lie
// before all of the second: fills the space between their hulls from one end to the other, and removes triangles that
// are not Delaunay in the whole on the way (Guibas, Stolfi, "Primitives for the manipulation of general subdivisions
// and the computation of Voronoi diagrams", 1985, Section 9). Reuses the slots of ghosts and two more. `first` and
// `second` are any ghosts of theirs. Touches only triangles and vertices of the two. Returns a ghost of the whole.
TriId mergeHalves(Triangulation& triangulation, Sweep sweep, TriId first, TriId second, std::array<TriId, 2> slots);

}  // namespace coastmesh
