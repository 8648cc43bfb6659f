#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/size_function.hpp"
#include "gis/follow/shore_triangles.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

// A point on a line given by the user.
struct LineSample {
  Point at;
  double size = 0.0, way = 0.0;  // wanted there; distance along the line
  RegionId water = kUnlabelled;  // kUnlabelled on land
  bool wanting = true;           // on land, or in water narrower than wanted
  bool beyond = false;           // on land across an open boundary: nothing is dug
};

inline bool isWet(const LineSample& sample) { return sample.water != kUnlabelled; }

// True if x is in a triangle or on its boundary. REQUIRES: it is counter-clockwise.
bool isIn(const Point& x, const Point& a, const Point& b, const Point& c);

// Samples of the line through these points, a quarter of the size apart.
std::vector<LineSample> samplesOf(const std::vector<Point>& line, const SizeFunction& size);

// Sets `water`, `wanting` and `beyond` of all samples; `elements`: the width wanted for each line.
void locateSamples(std::vector<std::vector<LineSample>>& lines, const std::vector<double>& elements,
                   const ShoreTriangles& triangles);

// Consecutive samples on land, with water before or after them.
struct LandOnLine {
  std::size_t first = 0, last = 0, middle = 0;  // samples
  double length = 0.0;                          // in the plane
  bool at_end = false;                          // no water on one of its sides
};
std::vector<LandOnLine> landsOn(const std::vector<LineSample>& samples);

// A fast test for proximity to any of many boxes, by the squares of a grid that they touch.
class BoxGrid {
 public:
  explicit BoxGrid(const std::vector<Box>& boxes) {
    for (const Box& box : boxes) bounds_.add(box);
    for (const Box& box : boxes) forSquares(box, [&](std::size_t square) { touched_[square] = true; });
  }

  bool mayMeet(const Box& box) const {
    if (!bounds_.meets(box)) return false;
    bool any = false;
    forSquares(box, [&](std::size_t square) { any = any || touched_[square]; });
    return any;
  }

 private:
  static constexpr std::size_t kSide = 512;

  template <typename Visit>
  void forSquares(const Box& box, Visit&& visit) const {
    const auto number = [](double x, double low, double high) {
      const double share = high > low ? (x - low) / (high - low) : 0.0;
      return static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(kSide - 1));
    };
    const std::size_t left = number(box.xmin, bounds_.xmin, bounds_.xmax);
    const std::size_t right = number(box.xmax, bounds_.xmin, bounds_.xmax);
    const std::size_t above = number(box.ymax, bounds_.ymin, bounds_.ymax);
    for (std::size_t j = number(box.ymin, bounds_.ymin, bounds_.ymax); j <= above; ++j)
      for (std::size_t i = left; i <= right; ++i) visit(j * kSide + i);
  }

  Box bounds_;
  std::vector<bool> touched_ = std::vector<bool>(kSide * kSide, false);
};

}  // namespace coastmesh
