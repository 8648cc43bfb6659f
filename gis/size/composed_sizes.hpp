#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/item_loop.hpp"
#include "core/size/size_tree.hpp"
#include "gis/size/domain_mask.hpp"
#include "gis/size/size_field.hpp"

namespace coastmesh {

// Limits of all sizes, metres.
struct SizeLimits {
  double everywhere_m = 0.0;  // where nothing requests less
  double least_m = 0.0, most_m = std::numeric_limits<double>::infinity();
};

// Several fields as one source, in lengths on the surface that the plane represents. The references must outlive it.
class ComposedSizes final : public SizeSource {
 public:
  // `measure` is length on the surface over metres.
  ComposedSizes(const SizeLimits& limits, std::function<double(const Point&)> measure, const DomainMask& mask,
                const ItemLoop& loop)
      : limits_(limits), measure_(std::move(measure)), mask_(mask), loop_(loop) {}

  // `option` is the one that requests the field.
  void add(std::string option, std::unique_ptr<SizeField> field) {
    fields_.push_back(std::move(field));
    asking_.push_back(std::move(option));
  }
  void setFloor(std::unique_ptr<SizeField> field) { floor_ = std::move(field); }
  // Bounds of all sizes.
  void setRim(std::unique_ptr<SizeField> least, std::unique_ptr<SizeField> most) {
    rim_least_ = std::move(least);
    rim_most_ = std::move(most);
  }
  void limitSize(double most_m) { most_m_ = most_m; }
  void limitRate(double rate);

  void sample(std::span<const Point> places, std::span<double> sizes) const override;
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override;
  double share(const SizeBox& box) const override { return mask_.share(box); }
  bool isWanted(const SizeBox& box) const override { return mask_.meets(box); }

  // A lower bound of all requested sizes, metres.
  double leastWanted() const;
  // The option that determines the size at a place.
  std::string optionAt(const Point& place) const;

 private:
  double bounded(double size, double floor) const;
  void boundByRim(std::span<const SizeBox> boxes, std::vector<SizeRange>& own, std::span<SizeRange> ranges) const;

  SizeLimits limits_;
  double most_m_ = std::numeric_limits<double>::infinity();
  std::function<double(const Point&)> measure_;
  const DomainMask& mask_;
  const ItemLoop& loop_;
  std::vector<std::unique_ptr<SizeField>> fields_;
  std::vector<std::string> asking_;   // of each field
  std::unique_ptr<SizeField> floor_;  // what the time step allows
  std::unique_ptr<SizeField> rim_least_, rim_most_;
};

}  // namespace coastmesh
