#pragma once

#include <utility>
#include <vector>

#include "core/point.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

// The sides of a frame that shores may reach.
class ShoreFrame {
 public:
  ShoreFrame() = default;
  explicit ShoreFrame(const std::vector<std::pair<Point, Point>>& sides);

  // True if the straight way from a to b crosses sides an odd number of times: two parts of a frame may share a side.
  bool parts(const Point& a, const Point& b) const;
  bool empty() const { return sides_.empty(); }

 private:
  std::vector<std::pair<Point, Point>> sides_;
  BoxTree tree_;
};

}  // namespace coastmesh
