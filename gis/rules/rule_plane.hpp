#pragma once

#include <vector>

#include "gis/geometry/box.hpp"

namespace coastmesh {

// Measures in the coordinates of a layer. Degrees of longitude count by the cosine of the latitude, and may be in
// different turns.
class RulePlane {
 public:
  explicit RulePlane(bool geographic);

  bool geographic() const { return geographic_; }
  double shrinkAt(double y) const;
  double distance(const Point& a, const Point& b) const;
  // The distance of `p` from the straight line between `a` and `b`; `share` gets how far along it is nearest, 0 to 1.
  double distance(const Point& p, const Point& a, const Point& b, double* share = nullptr) const {
    return distance(p, a, b, shrinkAt(p.y), share);
  }
  // The same; `shrink` is that at `p`.
  static double distance(const Point& p, const Point& a, const Point& b, double shrink, double* share);
  // All places within `reach` of a box.
  Box around(const Box& box, double reach) const;
  // Shifts of x to try.
  const std::vector<double>& turns() const { return turns_; }

 private:
  bool geographic_;
  std::vector<double> turns_;
};

}  // namespace coastmesh
