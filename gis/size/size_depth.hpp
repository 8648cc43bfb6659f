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

// The minimum of the sizes of several rules.
TileRule depthRule(const DepthRules& rules);

// For a time step: elements smaller than a long wave's travel in `time_step_s`, over `courant`, are too small.
TileRule courantRule(double time_step_s, double courant, const DepthRules& rules);

// The depth that a size of `courantRule` stands for, metres: no less than the rules' least.
double depthOfStep(double size_m, double time_step_s, double courant);

// Sizes from depths, those of gaps included, where slopes ask for nothing. `rule` is that of `known`: Depths or Step.
class FilledField final : public SizeField {
 public:
  FilledField(std::unique_ptr<SizeField> known, std::shared_ptr<const DepthGaps> gaps, const SizeRule& rule);

  void sample(std::span<const Point> places, std::span<double> sizes) const override;
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override;
  double least() const override { return least_; }

 private:
  double sizeOf(double depth_m) const;

  std::unique_ptr<SizeField> known_;
  std::shared_ptr<const DepthGaps> gaps_;
  SizeRule rule_;
  double least_;
};

}  // namespace coastmesh
