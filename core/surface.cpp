#include "core/surface.hpp"

namespace coastmesh {

namespace {

// As complex numbers.
Point quotient(const Point& a, const Point& b) {
  const double inverse = 1.0 / (b.x * b.x + b.y * b.y);
  return {(a.x * b.x + a.y * b.y) * inverse, (a.y * b.x - a.x * b.y) * inverse};
}

}  // namespace

// (z - c) / (1 + k z c*), with c the centre, c* its conjugate and k the curvature.
Point Frame::turned(const Point& z) const {
  return quotient({z.x - centre_.x, z.y - centre_.y}, {1.0 + curvature_ * (centre_.x * z.x + centre_.y * z.y),
                                                       curvature_ * (centre_.x * z.y - centre_.y * z.x)});
}

Point Frame::turnedBack(const Point& w) const {
  return quotient({w.x + centre_.x, w.y + centre_.y}, {1.0 - curvature_ * (centre_.x * w.x + centre_.y * w.y),
                                                       -curvature_ * (centre_.x * w.y - centre_.y * w.x)});
}

}  // namespace coastmesh
