#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/size/size_box.hpp"
#include "gis/size/domain_mask.hpp"
#include "gis/size/size_field.hpp"
#include "gis/size/size_rule.hpp"

namespace coastmesh {

// Depths for water where no raster has any. A gap is covered by squares of a quadtree, the largest in its middle and
// the smallest at its edge. Squares are neighbours only through water: land separates them if it is wider than about a
// five-hundredth of the domain, and land has no gaps. Each square gets a depth from its neighbours, and a linear
// variation within it. A square in which depths are partly known gets their mean. The result depends neither on threads
// nor on which process reads the rasters.
class DepthGaps {
 public:
  // Finds the gaps of `known`, which is infinite where there is no depth, otherwise a size in metres: squares at an
  // edge are not much smaller than that, or than `least_m`. `scale`: plane length over metres at a place.
  DepthGaps(const SizeField& known, const DomainMask& mask, const SizeBox& root, double least_m,
            std::function<double(const Point&)> scale, const ItemLoop& loop);

  // True if there are gaps.
  bool any() const { return gap_leaves_ > 0; }
  // Fills the gaps. `depth_of` converts sizes of `known` to depths, metres, above 0. `known` has values at the same
  // places as the constructor's field; `mask` is the constructor's. REQUIRES: `fill` is not None.
  void fill(const SizeField& known, const DomainMask& mask, const std::function<double(double)>& depth_of, GapFill fill,
            const ItemLoop& loop);

  // The approximate area of the gaps' water, square metres, and a place in the square with the most of it. Known once
  // they are filled.
  double area() const { return area_m2_; }
  Point place() const { return place_; }

  // The depth at a place where `known` is infinite, metres. NaN if there is no gap, or if no depth is known around it.
  double at(const Point& place) const;

  // The smallest depth, metres; infinite if there is none.
  double least() const { return least_m_; }

  struct Range {
    double least_m = std::numeric_limits<double>::infinity(), most_m = 0.0;  // none: infinite
    bool all = true;                                                         // gaps with depths cover all its water
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
    bool gap = false;  // false: depths are partly known
    bool dry = false;  // hardly any water: takes its neighbours' depth, and does not connect them
    double depth_m = std::numeric_limits<double>::quiet_NaN();
    Point gradient;  // metres per plane length
    double least_m = 0.0, most_m = 0.0;
    double scale = 1.0;
    double water = 0.0;  // the share that is water without a depth
    Point middle;        // in that water

    double at(const Point& place) const;
  };
  struct Side;

  void build(const SizeField& known, const DomainMask& mask, double least_m, const ItemLoop& loop);
  void fillParts(const SizeField& known, const DomainMask& mask, const std::function<double(double)>& depth_of,
                 const ItemLoop& loop);
  void measureWater(const DomainMask& mask);
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
  std::vector<Node> nodes_;   // level by level
  std::vector<Leaf> leaves_;  // of kinds Part and Gap
  std::size_t gap_leaves_ = 0;
  double least_half_ = 0.0;  // half side of the smallest square
  double area_m2_ = 0.0;
  double least_m_ = std::numeric_limits<double>::infinity();
  Point place_;
};

}  // namespace coastmesh
