#pragma once

#include <span>

#include "core/triangulate/triangulation.hpp"

namespace coastmesh {

// Triangulates some of the points on their own, inserting them in rounds, each in the given order, which should be
// along a curve: each point is near the previous one, and no input order creates many temporary triangles. The 2 n - 2
// triangles of n points, with ghosts, take consecutive slots from `first`; those must exist. Returns a ghost; kNone if
// all points are on one line. Throws Clash if two points coincide.
TriId insertPoints(Triangulation& triangulation, std::span<const VertexId> points, TriId first);

}  // namespace coastmesh
