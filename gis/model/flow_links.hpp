#pragma once

#include "gis/grid/grid.hpp"

namespace coastmesh {

// D-Flow FM computes flow along links from a triangle's centre to its neighbour's. A centre is that of the circle
// through the corners, or where it would leave the triangle, the place where the way there from the centre of gravity
// crosses the triangle's boundary.
struct FlowLink {
  double cosine = 0.0;  // of the angle between the link and the edge it crosses, 0 where the link has no length
  // Over half the sum of the square roots of the triangles' areas; between the circles' own centres where that is
  // shorter, since a setting of the model (`Dcenterinside`) lets centres leave their triangles.
  double length = 0.0;
};

// The link across the edge from `a` to `b` between triangles with apexes `left` and `right`, in a plane.
FlowLink flowLinkAcross(const Point& a, const Point& b, const Point& left, const Point& right);

}  // namespace coastmesh
