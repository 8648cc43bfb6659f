#pragma once

#include <memory>
#include <span>

#include "gis/size/size_field.hpp"
#include "gis/size/size_rule.hpp"

namespace coastmesh {

class DepthGaps;

// Length in metres of a wave of `period_s` seconds in water of that depth: g T² / (2 pi) tanh(2 pi d / L), linear
// waves.
double wavelengthOf(double period_s, double depth_m);

// The size that the rules of waves request at a depth of at least `least_depth_m`; infinite if there are none.
double sizeByWaves(const DepthRules& rules, double depth_m);

// The minimum of the sizes of several rules.
TileRule depthRule(const DepthRules& rules);

// The smallest size that a time step allows: the distance that a long wave travels in `time_step_s`, over `courant`.
TileRule courantRule(double time_step_s, double courant, const DepthRules& rules);

// The depth for which `courantRule` gives this size, metres: never less than its rules' `least_depth_m`.
double depthOfStep(double size_m, double time_step_s, double courant);

// Sizes from depths, including those of gaps, where slopes request nothing. `rule` is that of `known`: Depths or Step.
class FilledField final : public SizeField {
 public:
  FilledField(std::unique_ptr<SizeField> known, std::shared_ptr<const DepthGaps> gaps, const SizeRule& rule);

  void sample(std::span<const Point> places, std::span<double> sizes) const override;
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override;
  double least() const override { return least_; }
  double mostIn(const SizeBox& box) const override;

 private:
  double sizeOf(double depth_m) const;

  std::unique_ptr<SizeField> known_;
  std::shared_ptr<const DepthGaps> gaps_;
  SizeRule rule_;
  double least_;
};

}  // namespace coastmesh
