#pragma once

#include <cstdint>
#include <vector>

#include "core/ids.hpp"
#include "core/point.hpp"

namespace coastmesh {

// Points of a growing list, found again by place: a hash over square cells.
class PointGrid {
 public:
  // `tolerance`: how near a point has to be in order to be found; 0 finds equal points only. `points` outlives the
  // grid.
  PointGrid(const std::vector<Point>& points, double tolerance, std::size_t expected_size);

  void add(VertexId v);  // REQUIRES: v is the next that was not added yet
  // The nearest of the points added within the tolerance of `p`, of equally near ones the first; kNone if there is
  // none.
  VertexId find(const Point& p) const;

 private:
  struct Cell {
    std::int64_t x, y;
  };
  Cell cellOf(double x, double y) const;
  std::size_t bucketOf(const Cell& cell) const;
  void grow();

  const std::vector<Point>* points_;
  double tolerance_;
  std::vector<VertexId> first_;  // by bucket
  std::vector<VertexId> next_;   // by vertex
};

}  // namespace coastmesh
