#pragma once

#include <functional>
#include <vector>

#include "core/point.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

// A table of a smooth map of the plane: a projection takes longer than all other work on a place. Usable from several
// threads.
class PlaneTable {
 public:
  // Interpolated values differ by at most `tolerance` in either coordinate, which is checked halfway between the
  // table's points; if no table of moderate size is accurate enough, or the map is not finite everywhere, the map
  // itself is evaluated.
  PlaneTable(std::function<Point(const Point&)> map, const Box& box, double tolerance);

  Point at(const Point& x) const;
  bool isTabulated() const { return !values_.empty(); }

 private:
  bool tabulate(std::size_t cells, double tolerance);

  std::function<Point(const Point&)> map_;
  Box box_;
  std::size_t cells_ = 0;  // along each side
  double per_x_ = 0.0, per_y_ = 0.0;
  std::vector<Point> values_;
};

}  // namespace coastmesh
