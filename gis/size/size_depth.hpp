#pragma once

#include <vector>

#include "gis/size/size_raster.hpp"

namespace coastmesh {

// From `from_m` to `to_m` of depth, metres, positive down, the size wanted.
struct DepthBand {
  double from_m = 0.0;
  double to_m = 0.0;
  double size_m = 0.0;
};

// What sizes follow from depths. Depths less than `least_depth_m`, and land, are taken for that much.
struct DepthRules {
  bool positive_down = false;  // the raster holds depths; else heights, positive up
  double water_level_m = 0.0;  // of the still water above the raster's zero
  double least_depth_m = 1.0;  // metres, above 0
  double period_s = 44712.0;   // of the wave, seconds, above 0: that of the M2 tide, 12.42 hours
  double wave_elements = 0.0;  // elements a wavelength; 0 asks for nothing
  double slope_elements =
      0.0;  // elements on the way on which the depth would fall to nothing by 2 pi times its slope; 0 asks for nothing
  double slope_filter_m = 0.0;  // bumps shorter than this do not count, metres
  std::vector<DepthBand> bands;

  bool any() const { return wave_elements > 0.0 || slope_elements > 0.0 || !bands.empty(); }
};

// Length in metres of a wave of `period_s` seconds in water of that depth: g T² / (2 pi) tanh(2 pi d / L), linear
// waves.
double wavelengthOf(double period_s, double depth_m);

// The least of what the rules want.
TileRule depthRule(const DepthRules& rules);

// For a time step: elements smaller than the way that a long wave goes in `time_step_s`, over `courant`, are too small.
TileRule courantRule(double time_step_s, double courant, const DepthRules& rules);

}  // namespace coastmesh
