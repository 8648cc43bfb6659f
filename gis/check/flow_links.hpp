#pragma once

#include <span>

#include "core/point.hpp"

namespace coastmesh {

// D-Flow FM computes flow along links from an element's centre to its neighbour's. A centre is the circumcentre, or, if
// that is outside the element, the point where the line to it from the centroid crosses the element's boundary. Four
// corners need not lie on a circle: the centre is where the distances along the sides to their middles are least, by
// their squares.
struct FlowLink {
  double cosine = 0.0;  // of the angle between the link and the edge it crosses, 0 if the link has no length
  // Over half the sum of the square roots of the elements' areas; between the circumcentres if that is shorter, since
  // a setting of the model (`Dcenterinside`) allows centres outside their elements.
  double length = 0.0;
};

// The link between two elements in a plane, each with three or four corners, counter-clockwise. The first two of `left`
// are the edge between them, the second and the first of `right`.
FlowLink flowLinkAcross(std::span<const Point> left, std::span<const Point> right);
// The same for triangles on both sides of the edge from `a` to `b`, with apexes `left` and `right`.
FlowLink flowLinkAcross(const Point& a, const Point& b, const Point& left, const Point& right);

}  // namespace coastmesh
