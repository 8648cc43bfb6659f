#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gis/follow/shore_sizes.hpp"
#include "gis/follow/shore_triangles.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

// A line in the plane along which the user keeps water open or closes it.
struct ShoreLine {
  std::vector<Point> points;
  std::string name;       // empty: none was given
  double elements = 1.0;  // across a passage
  std::size_t file = 0;   // index of the file that it was read from
};

// `elements` of each line.
std::vector<double> elementsOf(const std::vector<ShoreLine>& lines);

struct ShoreGuides {
  std::vector<ShoreLine> passages;  // kept open, and widened to their elements where narrower
  std::vector<ShoreLine> barriers;  // closed
  std::vector<ShoreLine> land{};    // on land that stays

  BoxTree tree() const;  // of the boxes of the segments of passages and barriers
};

// Finds triangles at lines.
class LineZone {
 public:
  explicit LineZone(const std::vector<ShoreLine>& lines);

  // True if a line meets the triangle, or is within `reach` times its elements of the triangle's centroid.
  bool holds(const Point& a, const Point& b, const Point& c, double reach) const;

  // The first of the lines that meet the triangle, by index; nullopt: none.
  std::optional<std::size_t> firstAt(const Point& a, const Point& b, const Point& c) const;

  // True if a line other than `own` is within `reach` of x.
  bool hasAnotherNear(const Point& x, double reach, std::size_t own) const;

 private:
  struct Piece {
    Point a, b;
    double elements;
    std::size_t line;
  };
  std::vector<Piece> pieces_;
  double most_elements_ = 0.0;
  BoxTree tree_;
};

// A passage along which land was removed.
struct WidenedPassage {
  std::size_t line = 0;   // of the guides' passages
  Point place{};          // on the last of the parts that were widened
  RegionId water = 0;     // there
  double length_m = 0.0;  // of the parts that were widened
  double width_m = 0.0;   // the largest width made
  double dug_m = 0.0;     // the longest way through land, if at least an element
  Point dug_at{};         // its middle
};

// Land on a passage before its first or after its last water, at least an element long: it stays.
struct LandAhead {
  std::size_t line = 0;
  Point place;  // nearest to the water
  double length_m = 0.0;
};

struct PassageEffects {
  std::vector<WidenedPassage> widened;
  std::vector<std::size_t> dry;  // passages that meet no water
  std::vector<LandAhead> ends;
};

// Makes land water along passages, where these run over land or through water that is too narrow: from the first water
// on the line to the last, but not beyond open boundaries. Waters that are `small` become part of a larger one that is
// beside them then. Gains of waters are added to `gained`, all else to report to `effects`. Settles the triangles.
void widenPassages(ShoreTriangles& triangles, const ShoreSizes& sizes, const std::vector<ShoreLine>& passages,
                   const SmallWaters& small, const ShoreEdit& edit, WaterAreas& gained, PassageEffects& effects,
                   const ItemLoop& loop = inOrder);

// A barrier that meets no water, or that water goes around: no shore or other barrier is within an element of its end.
struct OpenBarrier {
  std::size_t line = 0;      // of the guides' barriers
  std::optional<Point> end;  // nullopt: it meets no water
};

// Closes the water that barriers run through, half an element wide, and settles the triangles. Barriers that may not
// separate waters are added to `open`.
void closeBarriers(ShoreTriangles& triangles, const ShoreSizes& sizes, const ShoreGuides& guides, const ShoreEdit& edit,
                   std::vector<OpenBarrier>& open);

}  // namespace coastmesh
