#pragma once

#include <memory>

#include "core/size_function.hpp"
#include "gis/projection/scale_table.hpp"
#include "gis/size/size_distance.hpp"

namespace coastmesh {

// Sizes that only grow with the distance from lines, within bounds, computed for each place: for use where a map of
// them would cost more.
class SizesByDistance final : public SizeFunction {
 public:
  // Bounds and the field's sizes are metres on the ground; `scales` is that of the plane, which represents no sphere,
  // within `box`. REQUIRES: least_m <= most_m, finite.
  SizesByDistance(std::unique_ptr<DistanceField> field, double least_m, double most_m,
                  std::shared_ptr<const ScaleTable> scales, const Box& box);

  double at(const Point& x) const override;
  double least() const override { return least_; }
  double most() const override { return most_; }
  void sample(std::span<const Point> places, std::span<double> sizes) const override;

 private:
  std::unique_ptr<DistanceField> field_;
  double least_m_, most_m_;
  std::shared_ptr<const ScaleTable> scales_;
  double least_, most_;  // of lengths in the plane
};

}  // namespace coastmesh
