#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// Region: parts that hang together and lie in one feature. Depth: z of the nodes. TimeStep: see time_step.hpp.
// Quality: 4 sqrt(3) area / sum of squared edges.
enum class PlotColor { None, Angle, Feature, Region, Size, Depth, Piece, TimeStep, Quality };

// The names that --color takes; throws OptionError for another.
const std::vector<std::string>& plotColorNames();
PlotColor plotColorNamed(const std::string& name);

struct PlotOptions {
  static constexpr std::uint64_t kLeastSize = 16, kMostSize = 20000;

  std::uint64_t size_px = 1600;                 // longer side of the map, kLeastSize to kMostSize
  std::optional<std::array<double, 4>> bbox{};  // west, south, east, north in the grid's CRS
  PlotColor color = PlotColor::None;
  bool edges = true;
  bool degrees = false;        // dots on nodes inside the mesh that have not six neighbours
  double min_angle_deg = 0.0;  // degrees; triangles with a smaller angle are red
};

// Draws the grid in a conformal plane fitted to it, with a scale bar, as .svg or .png by the ending of `path`. Throws
// OutputError, InputError where the box holds nothing of the plane or the mesh has no depths to show, OptionError where
// it does not say its pieces.
void plotMesh(const Grid& grid, const PlotOptions& options, const std::string& path);

// Throws OptionError where the mesh does not say its pieces, and is to be coloured by them.
void requireColors(const Grid& grid, const PlotOptions& options);

// Throws OutputError where `path` ends neither in .svg nor in .png.
void requirePlotFormat(const std::string& path);

}  // namespace coastmesh
