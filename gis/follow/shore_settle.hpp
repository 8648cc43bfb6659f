#pragma once

#include <vector>

#include "gis/follow/shore_triangles.hpp"

namespace coastmesh {

// After regions were changed: segments are where water meets land now, and what was a line in water that is still
// there. Where water would touch itself in a vertex, all but the widest part is given a vertex of its own, a little way
// inside. Points that lie on no segment any more go, and those of the domain that lay on none where there is no more
// water. The triangulation is Delaunay again; only what is near to a change is touched. Triangles get other numbers.
// Throws BadPslg where there is no room for a vertex.
void settleShores(ShoreTriangles& triangles, const SizeFunction& size);

// The graph of what `settleShores` makes.
ShoreGraph settledGraph(ShoreTriangles&& triangles, const SizeFunction& size);

// A triangle that holds x: walks from `near`, and looks at all of them where that does not end soon. kNone where x lies
// beyond what is around.
TriId locateIn(const ShoreTriangles& triangles, const Point& x, TriId near);

// Puts helpers into triangles, which are Delaunay afterwards. Those that lie on a segment or at a vertex are left out.
void insertPoints(ShoreTriangles& triangles, const std::vector<Point>& points, const SizeFunction& size);

}  // namespace coastmesh
