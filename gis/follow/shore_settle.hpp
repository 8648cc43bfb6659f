#pragma once

#include <vector>

#include "gis/follow/shore_triangles.hpp"

namespace coastmesh {

// Updates the triangulation after changes of regions. Segments are then edges between regions, and former lines still
// in water. Where water touches itself in a vertex, all parts but one, the widest or one with a line, get vertices of
// their own, slightly inside. Removes vertices that no longer lie on a segment, and points of the domain no longer in
// water. The triangulation is Delaunay again; only surroundings of changes are edited. Triangles are renumbered. Throws
// BadPslg if there is no room for a vertex.
void settleShores(ShoreTriangles& triangles, const SizeFunction& size, const ItemLoop& loop = inOrder);

// The graph of what `settleShores` would make.
ShoreGraph settledGraph(ShoreTriangles&& triangles, const SizeFunction& size, const ItemLoop& loop = inOrder);

// A triangle that contains x; kNone if x is outside the triangulation. Walks from `from`, and searches all triangles if
// that takes too long.
TriId locateIn(const ShoreTriangles& triangles, const Point& x, TriId from);

// Inserts helpers and makes the triangulation Delaunay. Skips points on a segment, at a vertex or outside.
void insertPoints(ShoreTriangles& triangles, const std::vector<Point>& points, const SizeFunction& size);

}  // namespace coastmesh
