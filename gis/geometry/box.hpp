#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "core/item_loop.hpp"
#include "core/point.hpp"

namespace coastmesh {

// An axis-parallel box, its sides included. An empty box has its limits reversed.
struct Box {
  double xmin = std::numeric_limits<double>::infinity();
  double ymin = std::numeric_limits<double>::infinity();
  double xmax = -std::numeric_limits<double>::infinity();
  double ymax = -std::numeric_limits<double>::infinity();

  static Box of(const Point& a, const Point& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y)};
  }
  bool empty() const { return xmin > xmax; }
  void add(const Point& p) {
    xmin = std::min(xmin, p.x);
    ymin = std::min(ymin, p.y);
    xmax = std::max(xmax, p.x);
    ymax = std::max(ymax, p.y);
  }
  void add(const Box& other) {
    xmin = std::min(xmin, other.xmin);
    ymin = std::min(ymin, other.ymin);
    xmax = std::max(xmax, other.xmax);
    ymax = std::max(ymax, other.ymax);
  }
  bool meets(const Box& other) const {
    return xmin <= other.xmax && other.xmin <= xmax && ymin <= other.ymax && other.ymin <= ymax;
  }
  bool contains(const Box& other) const {
    return xmin <= other.xmin && other.xmax <= xmax && ymin <= other.ymin && other.ymax <= ymax;
  }
  Box grownBy(double margin) const { return {xmin - margin, ymin - margin, xmax + margin, ymax + margin}; }
};

// The box of all points.
inline Box boxAround(std::span<const Point> points, const ItemLoop& loop) {
  Box all;
  for (const Box& some : overStretches(loop, points.size(), [&](std::size_t first, std::size_t last) {
         Box box;
         for (std::size_t i = first; i < last; ++i) box.add(points[i]);
         return box;
       }))
    all.add(some);
  return all;
}

}  // namespace coastmesh
