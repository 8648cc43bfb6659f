#pragma once

#include <cmath>

#include "core/point.hpp"
#include "gis/crs/lon_lat.hpp"

namespace coastmesh {

// What is near a place, seen from it: longitudes the short way round, and as long as latitudes there.
class LineView {
 public:
  LineView(const Point& from, bool geographic)
      : from_(from), geographic_(geographic), shrink_(geographic ? std::cos(toRadians(from.y)) : 1.0) {}

  Point of(const Point& p) const {
    const double dx = p.x - from_.x;
    return {shrink_ * (geographic_ ? std::remainder(dx, 360.0) : dx), p.y - from_.y};
  }
  Point placeOf(const Point& seen) const { return {from_.x + seen.x / shrink_, from_.y + seen.y}; }

 private:
  Point from_;
  bool geographic_;
  double shrink_;
};

}  // namespace coastmesh
