#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/item_loop.hpp"
#include "core/surface.hpp"
#include "gis/size/domain_mask.hpp"
#include "gis/size/size_field.hpp"

namespace coastmesh {

// A lower bound of sizes, raised so that it can be graded: at each place the maximum, over all places, of `field` less
// `rate` times the distance. Sizes that are nowhere below it stay so when they are graded by no less than that rate. 0
// where the field has no value and nothing near is steep.
//
// It differs from the field only where the field changes by more than the rate: a quadtree keeps these squares, each
// with its maximum, so that the result is too large by a few hundredths at most, never too small by more.
class SizeFloor final : public SizeField {
 public:
  // Covers the square `root` where `mask` meets it. Values up to `least_m` are ignored: sizes are not smaller anyway.
  // `scale` is plane length over metres at a place, `surface` is represented by the plane. `loop` provides threads.
  SizeFloor(std::unique_ptr<SizeField> field, double rate, double least_m, std::function<double(const Point&)> scale,
            const SizeBox& root, const DomainMask& mask, const ItemLoop& loop, const Surface& surface = {});

  // Raises the floor to `factor` times its value on some lines; the increase falls to 0 with growing distance.
  // `distances` is the distance from the lines, metres times a rate.
  void raiseNear(std::unique_ptr<SizeField> distances, double factor);

  void sample(std::span<const Point> places, std::span<double> sizes) const override;
  // `high` is infinite if the field is known only in a part of the box.
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override;
  void limitRate(double rate) override { rate_ = std::min(rate_, rate); }

 private:
  struct Node {
    float most = 0.0F;        // largest of all steep squares in it, metres
    std::uint32_t below = 0;  // the first of four in a row; 0 for a leaf
  };

  void build(const DomainMask& mask, const ItemLoop& loop);
  // Length on the surface over metres.
  double measureAt(const Point& x) const { return scale_(x) * surface_.shrinkAt(x); }
  // The maximum that steep squares require in a box, or `most` if that is larger; metres.
  double steepMost(const SizeBox& asked, double most) const;
  void descend(std::uint32_t node, const SizeBox& box, const SizeBox& asked, double rate, double& most) const;

  std::unique_ptr<SizeField> field_;
  double rate_, least_m_;
  std::function<double(const Point&)> scale_;
  Surface surface_;
  SizeBox root_;
  std::vector<Node> nodes_;  // level by level
  std::unique_ptr<SizeField> distances_;
  double factor_ = 1.0;
};

}  // namespace coastmesh
