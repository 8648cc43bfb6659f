#pragma once

#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/rules/rule_plane.hpp"

namespace coastmesh {

// A polygon, searchable by places.
class AreaSearch {
 public:
  explicit AreaSearch(Polygon polygon);

  const Box& box() const { return box_; }  // of the outer ring
  // By the even-odd rule, in any turn of each ring. Of two polygons that share a side, one contains a place on it.
  bool contains(const Point& p, const RulePlane& plane) const;

 private:
  // Edge i comes to point i from the one before.
  struct SearchedRing {
    Ring ring;
    BoxTree tree;  // empty for short rings
    double slack = 0.0;

    explicit SearchedRing(Ring points);
    bool contains(const Point& p, const RulePlane& plane) const;
    // True if a ray from `p` eastwards crosses the ring an odd number of times.
    bool crossedOddly(const Point& p) const;
    bool isCrossed(std::size_t edge, const Point& p) const;
    const Point& before(std::size_t i) const { return ring[i == 0 ? ring.size() - 1 : i - 1]; }
  };

  std::vector<SearchedRing> rings_;  // the outer one first
  Box box_;
};

}  // namespace coastmesh
