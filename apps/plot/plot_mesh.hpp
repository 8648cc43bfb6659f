#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/plot/plot_box.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Region: by name if the grid has named regions, otherwise connected parts within one feature. Depth: z of the nodes.
// TimeStep: see time_step.hpp. Quality: 4 sqrt(3) area / sum of squared edges.
enum class PlotColor { None, Angle, Feature, Region, Size, Depth, Piece, TimeStep, Quality };

// The names that --color takes; `plotColorNamed` throws OptionError for any other.
const std::vector<std::string>& plotColorNames();
PlotColor plotColorNamed(const std::string& name);

// True if the colours are those of a scale.
bool hasRamp(PlotColor color);

struct PlotOptions {
  static constexpr std::uint64_t kLeastSize = 16, kMostSize = 20000;

  std::uint64_t size_px = 1600;   // longer side of the map, kLeastSize to kMostSize
  std::optional<PlotBox> bbox{};  // the part to show
  PlotColor color = PlotColor::None;
  bool edges = true;
  bool degrees = false;        // dots on interior nodes whose valence is not 6
  double min_angle_deg = 0.0;  // degrees; triangles with a smaller angle are red
};

// Draws the grid in a conformal plane fitted to it, with a scale bar, as .svg or .png by the ending of `path`. Returns
// false, without a picture, if there is no box and the grid is too large for a plane. Throws OutputError; InputError if
// the box contains no triangle or the mesh has no depths to show; OptionError if it has no pieces to show.
bool plotMesh(const Grid& grid, const PlotOptions& options, const std::string& path);

// Throws OptionError if the mesh is to be coloured by pieces and has none.
void requireColors(const Grid& grid, const PlotOptions& options);

// Throws OutputError unless `path` ends in .svg or .png.
void requirePlotFormat(const std::string& path);

}  // namespace coastmesh
