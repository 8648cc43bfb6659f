#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace coastmesh {

// Depths where no raster has one, as nodes get them: see `DepthFill`.
enum class GapFill {
  Mean,     // a membrane between the depths around the gap
  Nearest,  // the depth that is nearest through water
  None,     // none: sizes there follow from those around by gradation
};

// A rectangle of pixels to be evaluated, with some of its surroundings.
struct RasterTile {
  int width = 0, height = 0;       // pixels, without the margin
  int side = 0, end = 0;           // margin: columns on either side, rows above and below
  double pixel_m[2] = {0.0, 0.0};  // ground size of a pixel along columns and rows, metres
  std::vector<float> values;       // rows of width + 2 side from the top; NaN where there is no data
  std::string file;

  std::size_t stride() const { return static_cast<std::size_t>(width) + 2 * static_cast<std::size_t>(side); }
  std::size_t indexOf(int x, int y) const {
    return static_cast<std::size_t>(y + end) * stride() + static_cast<std::size_t>(x + side);
  }
  float at(int x, int y) const { return values[indexOf(x, y)]; }
};

// From values to sizes: `sizes` has one for each pixel, in rows without margin; infinite where nothing is requested.
struct TileRule {
  double margin_m = 0.0;  // metres of surroundings that the rule uses; 0: none
  std::function<void(const RasterTile& tile, std::span<float> sizes)> sizes;
  // Where sizes differ much within half of the smallest, this one applies, not their mean: each was asked for by
  // itself. Means ignore single shoals.
  bool keeps_least{};
};

// The size for depths from `from_m` to `to_m`, metres, positive down.
struct DepthBand {
  double from_m = 0.0;
  double to_m = 0.0;
  double size_m = 0.0;
};

// Sizes that follow from depths. Depths less than `least_depth_m`, and land, count as that depth.
struct DepthRules {
  bool positive_down = false;   // the raster holds depths; otherwise heights, positive up
  double water_level_m = 0.0;   // of the still water above the raster's zero
  double least_depth_m = 1.0;   // metres, above 0
  double period_s = 44712.0;    // of the wave, seconds, above 0: that of the M2 tide, 12.42 hours
  double wave_elements = 0.0;   // elements per wavelength; 0: not used
  double crossing_s = 0.0;      // sizes are at most what a long wave travels in this time, seconds; 0: not used
  double slope_elements = 0.0;  // elements per length of 2 pi times depth over slope; 0: not used
  double slope_filter_m = 0.0;  // slopes of features shorter than this are ignored, metres
  std::vector<DepthBand> bands;

  // True if sizes follow from the speed of waves: every depth requests one.
  bool byWaves() const { return wave_elements > 0.0 || crossing_s > 0.0; }
  bool any() const { return byWaves() || slope_elements > 0.0 || !bands.empty(); }
};

// A rule as plain values, to be sent to other processes.
struct SizeRule {
  enum class Kind : unsigned char {
    Raw,     // values are sizes
    Depths,  // see `depthRule`
    Step,    // see `courantRule`
    Known    // see `knownRule`
  };
  Kind kind = Kind::Raw;
  DepthRules depths;
  double time_step_s = 0.0, courant = 0.0;
};

}  // namespace coastmesh
