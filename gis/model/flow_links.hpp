#pragma once

#include "gis/grid/grid.hpp"

namespace coastmesh {

// D-Flow FM computes flow along links from a triangle's centre to its neighbour's. A centre is the circumcentre, or, if
// that is outside the triangle, the point where the line to it from the centroid crosses the triangle's boundary.
struct FlowLink {
  double cosine = 0.0;  // of the angle between the link and the edge it crosses, 0 if the link has no length
  // Over half the sum of the square roots of the triangles' areas; between the circumcentres if that is shorter, since
  // a setting of the model (`Dcenterinside`) allows centres outside their triangles.
  double length = 0.0;
};

// The link across the edge from `a` to `b` between triangles with apexes `left` and `right`, in a plane.
FlowLink flowLinkAcross(const Point& a, const Point& b, const Point& left, const Point& right);

}  // namespace coastmesh
