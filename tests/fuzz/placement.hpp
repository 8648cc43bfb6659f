#pragma once

#include "core/metric.hpp"
#include "core/point.hpp"
#include "tests/fuzz/choices.hpp"

namespace coastmesh {

// Rotates, scales and translates, in this order.
struct Placement {
  double cosine = 1.0;
  double sine = 0.0;
  double scale = 1.0;
  Point offset;

  Point operator()(const Point& p) const {
    return offset + scale * Point{cosine * p.x - sine * p.y, sine * p.x + cosine * p.y};
  }
};

// Scales from 1e-6 to 1e6, and offsets up to a million times the scale.
Placement randomPlacement(Choices& choices);

}  // namespace coastmesh
