#include "gis/rules/rule_plane.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coastmesh {
namespace {

constexpr double kTurn = 360.0;

}  // namespace

RulePlane::RulePlane(bool geographic)
    : geographic_(geographic), turns_(geographic ? std::vector{0.0, -kTurn, kTurn} : std::vector{0.0}) {}

double RulePlane::shrinkAt(double y) const {
  return geographic_ ? std::max(1e-6, std::cos(y * std::numbers::pi / 180.0)) : 1.0;
}

double RulePlane::distance(const Point& a, const Point& b) const {
  return std::hypot((b.x - a.x) * shrinkAt((a.y + b.y) / 2.0), b.y - a.y);
}

double RulePlane::distance(const Point& p, const Point& a, const Point& b, double shrink, double* share) {
  const double dx = (b.x - a.x) * shrink, dy = b.y - a.y, px = (p.x - a.x) * shrink, py = p.y - a.y;
  const double square = dx * dx + dy * dy;
  const double t = square > 0.0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0.0;
  if (share != nullptr) *share = t;
  return std::hypot(px - t * dx, py - t * dy);
}

Box RulePlane::around(const Box& box, double reach) const {
  const double shrink = std::min(shrinkAt(box.ymin), shrinkAt(box.ymax));
  return {box.xmin - reach / shrink, box.ymin - reach, box.xmax + reach / shrink, box.ymax + reach};
}

}  // namespace coastmesh
