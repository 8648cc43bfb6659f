#include "gis/model/flow_links.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/quality.hpp"

namespace coastmesh {
namespace {

Point circumcentre(const Point& a, const Point& b, const Point& c) {
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
  const double d = 2.0 * (bx * cy - by * cx), b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  return {a.x + (cy * b2 - by * c2) / d, a.y + (bx * c2 - cx * b2) / d};
}

Point centreWithin(const Point& a, const Point& b, const Point& c) {
  const Point circle = circumcentre(a, b, c);
  const Point mass{(a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0};
  double reach = 1.0;  // share of the way from centroid to circumcentre that lies in the triangle
  for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    const auto side = [&](const Point& x) { return (q.x - p.x) * (x.y - p.y) - (q.y - p.y) * (x.x - p.x); };
    const double from = side(mass), to = side(circle);
    if (to < 0.0) reach = std::min(reach, from / (from - to));
  }
  return {mass.x + reach * (circle.x - mass.x), mass.y + reach * (circle.y - mass.y)};
}

}  // namespace

FlowLink flowLinkAcross(const Point& a, const Point& b, const Point& left, const Point& right) {
  const Point from = centreWithin(a, b, left), to = centreWithin(b, a, right);
  const double ex = b.x - a.x, ey = b.y - a.y, lx = to.x - from.x, ly = to.y - from.y;
  const double length = std::hypot(lx, ly), lengths = std::hypot(ex, ey) * length;
  const double size =
      0.5 * (std::sqrt(std::abs(signedArea(a, b, left))) + std::sqrt(std::abs(signedArea(b, a, right))));
  const Point circle = circumcentre(a, b, left), other = circumcentre(b, a, right);
  const double shorter = std::min(length, std::hypot(other.x - circle.x, other.y - circle.y));
  return {lengths > 0.0 ? std::abs(ex * lx + ey * ly) / lengths : 0.0, size > 0.0 ? shorter / size : 0.0};
}

}  // namespace coastmesh
