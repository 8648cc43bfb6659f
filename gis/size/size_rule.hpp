#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace coastmesh {

// A square of pixels while it is looked at, with some of its surroundings.
struct RasterTile {
  int width = 0, height = 0;       // pixels, without the margin
  int margin = 0;                  // pixels on each side
  double pixel_m[2] = {0.0, 0.0};  // ground size of a pixel along columns and rows, metres
  std::vector<float> values;       // rows of width + 2 margin from the top; NaN where there is no data
  std::string file;

  std::size_t stride() const { return static_cast<std::size_t>(width) + 2 * static_cast<std::size_t>(margin); }
  float at(int x, int y) const {
    return values[static_cast<std::size_t>(y + margin) * stride() + static_cast<std::size_t>(x + margin)];
  }
};

// From values to sizes: `sizes` has one a pixel, in rows without margin; infinite where nothing is wanted.
struct TileRule {
  double margin_m = 0.0;  // of surroundings that the rule looks at; 0: it looks at none
  std::function<void(const RasterTile& tile, std::span<float> sizes)> sizes;
};

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

// A rule as plain values, so that others can be told it.
struct SizeRule {
  enum class Kind : unsigned char {
    Raw,     // values are sizes
    Depths,  // see `depthRule`
    Step     // see `courantRule`
  };
  Kind kind = Kind::Raw;
  DepthRules depths;
  double time_step_s = 0.0, courant = 0.0;
};

}  // namespace coastmesh
