#pragma once

#include "gis/size/size_rule.hpp"

namespace coastmesh {

// Length in metres of a wave of `period_s` seconds in water of that depth: g T² / (2 pi) tanh(2 pi d / L), linear
// waves.
double wavelengthOf(double period_s, double depth_m);

// The minimum of the sizes of several rules.
TileRule depthRule(const DepthRules& rules);

// For a time step: elements smaller than a long wave's travel in `time_step_s`, over `courant`, are too small.
TileRule courantRule(double time_step_s, double courant, const DepthRules& rules);

}  // namespace coastmesh
