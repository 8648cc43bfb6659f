#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gis/follow/shore_graph.hpp"
#include "gis/follow/shore_sizes.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

// A line of the plane along which the user decides what becomes of the water.
struct ShoreLine {
  std::vector<Point> points;
  std::string name;  // empty: none was given
};

struct ShoreGuides {
  std::vector<ShoreLine>
      passages;  // kept open, and made as wide as `elements` of the size wanted where they are narrower
  std::vector<ShoreLine> barriers;  // closed
  double elements = 1.0;

  BoxTree tree() const;  // of the boxes of what the lines are made of
};

// Finds what lies at lines.
class LineZone {
 public:
  explicit LineZone(const std::vector<ShoreLine>& lines);

  // Whether a line comes as near to the triangle's centroid, or meets the triangle.
  bool holds(const Point& a, const Point& b, const Point& c, double reach) const;

 private:
  std::vector<std::pair<Point, Point>> pieces_;
  BoxTree tree_;
};

// A passage where land gave way.
struct WidenedPassage {
  std::size_t line = 0;  // of the guides' passages
  Point place;
  double length_m = 0.0;  // along which it did
  double width_m = 0.0;   // what it has become, at most
};

// Where a passage runs over land, or through water narrower than it has to be, land beside it becomes water: from the first water on
// the line to the last. `dry` is given the passages that meet no water.
ShoreGraph widenPassages(const ShoreGraph& graph, const ShoreSizes& sizes, const ShoreGuides& guides,
                         const ShoreEdit& edit, std::vector<WidenedPassage>& widened, std::vector<std::size_t>& dry);

// Closes the water that barriers run through, half an element wide.
ShoreGraph closeBarriers(const ShoreGraph& graph, const ShoreSizes& sizes, const ShoreGuides& guides,
                         const ShoreEdit& edit);

}  // namespace coastmesh
