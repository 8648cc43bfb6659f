#include "gis/check/flow_links.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/quality.hpp"

namespace coastmesh {
namespace {

Point circumcentre(const Point& a, const Point& b, const Point& c) {
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
  const double d = 2.0 * (bx * cy - by * cx), b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  return {a.x + (cy * b2 - by * c2) / d, a.y + (bx * c2 - cx * b2) / d};
}

// The least squares over the sides of the distance, along a side, from its middle.
Point centreOfSides(std::span<const Point> p) {
  double xx = 0.0, xy = 0.0, yy = 0.0, x = 0.0, y = 0.0;  // of the normal equations, from the first corner
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point &from = p[i], &to = p[(i + 1) % p.size()];
    const double dx = to.x - from.x, dy = to.y - from.y, squared = dx * dx + dy * dy;
    const double along = dx * ((from.x + to.x) / 2.0 - p[0].x) + dy * ((from.y + to.y) / 2.0 - p[0].y);
    xx += dx * dx / squared;
    xy += dx * dy / squared;
    yy += dy * dy / squared;
    x += dx * along / squared;
    y += dy * along / squared;
  }
  const double d = xx * yy - xy * xy;
  return {p[0].x + (yy * x - xy * y) / d, p[0].y + (xx * y - xy * x) / d};
}

Point circleOf(std::span<const Point> p) { return p.size() == 3 ? circumcentre(p[0], p[1], p[2]) : centreOfSides(p); }

double areaOf(std::span<const Point> p) {
  double area = 0.0;
  for (std::size_t i = 2; i < p.size(); ++i) area += signedArea(p[0], p[i - 1], p[i]);
  return std::abs(area);
}

Point centreWithin(std::span<const Point> corners, const Point& circle) {
  Point mass{};
  for (const Point& corner : corners) mass = {mass.x + corner.x, mass.y + corner.y};
  mass = {mass.x / static_cast<double>(corners.size()), mass.y / static_cast<double>(corners.size())};
  double reach = 1.0;  // share of the way from centroid to circumcentre that lies in the element
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point &p = corners[i], &q = corners[(i + 1) % corners.size()];
    const auto side = [&](const Point& x) { return (q.x - p.x) * (x.y - p.y) - (q.y - p.y) * (x.x - p.x); };
    const double from = side(mass), to = side(circle);
    if (to < 0.0) reach = std::min(reach, from / (from - to));
  }
  return {mass.x + reach * (circle.x - mass.x), mass.y + reach * (circle.y - mass.y)};
}

}  // namespace

FlowLink flowLinkAcross(std::span<const Point> left, std::span<const Point> right) {
  const Point circle = circleOf(left), other = circleOf(right);
  const Point from = centreWithin(left, circle), to = centreWithin(right, other);
  const double ex = left[1].x - left[0].x, ey = left[1].y - left[0].y, lx = to.x - from.x, ly = to.y - from.y;
  const double length = std::hypot(lx, ly), lengths = std::hypot(ex, ey) * length;
  const double size = 0.5 * (std::sqrt(areaOf(left)) + std::sqrt(areaOf(right)));
  const double shorter = std::min(length, std::hypot(other.x - circle.x, other.y - circle.y));
  return {lengths > 0.0 ? std::abs(ex * lx + ey * ly) / lengths : 0.0, size > 0.0 ? shorter / size : 0.0};
}

FlowLink flowLinkAcross(const Point& a, const Point& b, const Point& left, const Point& right) {
  return flowLinkAcross(std::array{a, b, left}, std::array{b, a, right});
}

}  // namespace coastmesh
