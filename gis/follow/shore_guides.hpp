#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gis/follow/shore_sizes.hpp"
#include "gis/follow/shore_triangles.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

// A line of the plane along which the user decides what becomes of the water.
struct ShoreLine {
  std::vector<Point> points;
  std::string name;       // empty: none was given
  double elements = 1.0;  // across a passage
  std::size_t file = 0;   // that it was read from: an index of those given
};

// Of each line.
std::vector<double> elementsOf(const std::vector<ShoreLine>& lines);

struct ShoreGuides {
  std::vector<ShoreLine> passages;  // kept open, and made as wide as their elements where they are narrower
  std::vector<ShoreLine> barriers;  // closed

  BoxTree tree() const;  // of the boxes of what the lines are made of
};

// Finds what lies at lines.
class LineZone {
 public:
  explicit LineZone(const std::vector<ShoreLine>& lines);

  // Whether a line comes as near to the triangle's centroid as `reach` for each of its elements, or meets the triangle.
  bool holds(const Point& a, const Point& b, const Point& c, double reach) const;

 private:
  struct Piece {
    Point a, b;
    double elements;
  };
  std::vector<Piece> pieces_;
  double most_elements_ = 0.0;
  BoxTree tree_;
};

// A passage where land gave way.
struct WidenedPassage {
  std::size_t line = 0;  // of the guides' passages
  Point place{};
  double length_m = 0.0;  // along which it did
  double width_m = 0.0;   // what it has become, at most
  double dug_m = 0.0;     // the longest way through land, if there is one of more than an element
  Point dug_at{};         // the middle of it
};

// Land beyond the last water on a passage, more than an element long: it stays.
struct LandAhead {
  std::size_t line = 0;
  Point place;  // where it begins
  double length_m = 0.0;
};

struct PassageEffects {
  std::vector<WidenedPassage> widened;
  std::vector<std::size_t> dry;  // passages that meet no water
  std::vector<LandAhead> ends;
};

// Where a passage runs over land, or through water narrower than it has to be, land beside it becomes water: from the
// first water on the line to the last, but not beyond open boundaries. What waters gain is added to `gained`, what else
// there is to tell to `effects`. The triangles are settled.
void widenPassages(ShoreTriangles& triangles, const ShoreSizes& sizes, const std::vector<ShoreLine>& passages,
                   const ShoreEdit& edit, WaterAreas& gained, PassageEffects& effects);

// A barrier that meets no water, or that water goes round: no shore and no other barrier within an element of its end.
struct OpenBarrier {
  std::size_t line = 0;      // of the guides' barriers
  std::optional<Point> end;  // none: it meets no water
};

// Closes the water that barriers run through, half an element wide. The triangles are settled. `open` is given the
// barriers that may not close what they are to close.
void closeBarriers(ShoreTriangles& triangles, const ShoreSizes& sizes, const ShoreGuides& guides, const ShoreEdit& edit,
                   std::vector<OpenBarrier>& open);

}  // namespace coastmesh
