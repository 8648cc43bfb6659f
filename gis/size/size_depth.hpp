#pragma once

#include "gis/size/size_rule.hpp"

namespace coastmesh {

// Length in metres of a wave of `period_s` seconds in water of that depth: g T² / (2 pi) tanh(2 pi d / L), linear
// waves.
double wavelengthOf(double period_s, double depth_m);

// The least of what the rules want.
TileRule depthRule(const DepthRules& rules);

// For a time step: elements smaller than the way that a long wave goes in `time_step_s`, over `courant`, are too small.
TileRule courantRule(double time_step_s, double courant, const DepthRules& rules);

}  // namespace coastmesh
