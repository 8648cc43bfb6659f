#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/size/size_box.hpp"
#include "gis/size/domain_mask.hpp"
#include "gis/size/gap_fill.hpp"
#include "gis/size/size_field.hpp"

namespace coastmesh {

// Depths of water for which no raster has any. A quadtree finds it: squares without a depth, the largest of which lie
// in the middle of a gap and the smallest at its edge, and which are neighbours through water alone: land parts them
// (if wider than about a five-hundredth of the domain), and gaps over land are none. Each square gets a depth from its
// neighbours; within it, that changes evenly. A square in part of which depths are known gets their mean. It depends on
// places alone, not on threads nor on who read the rasters.
class DepthGaps {
 public:
  // Finds gaps of `known`, which is infinite where there is no depth, otherwise a size in metres: squares at the edge
  // are not much smaller than that, or than `least_m`. `scale`: plane length over metres at a place.
  DepthGaps(const SizeField& known, const DomainMask& mask, const SizeBox& root, double least_m,
            std::function<double(const Point&)> scale, const ItemLoop& loop);

  // Whether there are squares without a depth.
  bool any() const { return gap_leaves_ > 0; }
  // Fills them: `depth_of` makes depths in metres, above 0, of sizes of `known`, which knows what that of the
  // constructor did. `fill` is not None.
  void fill(const SizeField& known, const std::function<double(double)>& depth_of, GapFill fill, const ItemLoop& loop);

  // About how much water they cover, square metres, with half of the squares at edges; the middle of the largest.
  double area() const { return area_m2_; }
  Point place() const { return place_; }

  // Metres, where `known` is infinite; not a number where there is no gap, or nothing around it is known either.
  double at(const Point& place) const;

  // The least of them.
  double least() const { return least_m_; }

  struct Range {
    double least_m = std::numeric_limits<double>::infinity(), most_m = 0.0;  // none: infinite
    bool all = true;                                                         // nothing else is water in the box
  };
  Range within(const SizeBox& box) const;

 private:
  enum class Kind : unsigned char { Below, Outside, Known, Part, Gap };
  struct Node {
    std::uint32_t next = 0;  // the first of four children in a row, or the leaf
    Kind kind = Kind::Outside;
  };
  struct Leaf {
    SizeBox box;
    bool gap = false;  // otherwise known in part
    bool dry = false;  // hardly any water: it has the depth of its neighbours, and joins none
    double depth_m = std::numeric_limits<double>::quiet_NaN();
    Point gradient;  // metres per plane length
    double least_m = 0.0, most_m = 0.0;
    double scale = 1.0;

    double at(const Point& place) const;
  };
  struct Side;

  void build(const SizeField& known, const DomainMask& mask, double least_m, const ItemLoop& loop);
  void fillParts(const SizeField& known, const std::function<double(double)>& depth_of, const ItemLoop& loop);
  std::vector<Side> sides() const;
  void fixSides(const SizeField& known, const std::function<double(double)>& depth_of, std::vector<Side>& sides,
                const ItemLoop& loop) const;
  std::vector<std::size_t> beginsOf(const std::vector<Side>& sides) const;
  double meanAcross(std::span<const Side> sides) const;
  void fillByMean(const std::vector<Side>& sides, const ItemLoop& loop);
  void fillFromNearest(const std::vector<Side>& sides);
  void fillDry(const std::vector<Side>& sides);
  void setGradients(const std::vector<Side>& sides);
  // Calls `visit(node, box)` for leaves that meet a rectangle.
  template <typename Visit>
  void forEachLeaf(const Point& low, const Point& high, const Visit& visit) const;

  SizeBox root_;
  std::function<double(const Point&)> scale_;
  std::vector<Node> nodes_;   // level after level
  std::vector<Leaf> leaves_;  // of kinds Part and Gap
  std::size_t gap_leaves_ = 0;
  double least_half_ = 0.0;  // of all leaves
  double area_m2_ = 0.0;
  double least_m_ = std::numeric_limits<double>::infinity();
  Point place_;
};

}  // namespace coastmesh
