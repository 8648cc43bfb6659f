#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Attributes of weirs, case-insensitive; short enough for a shapefile.
inline constexpr const char* kWeirHeight = "height";
inline constexpr const char* kWeirSubcritical = "coef_sub";
inline constexpr const char* kWeirSupercritical = "coef_super";

// The crest of a weir as attributes give it, and ADCIRC's coefficients of the flow over it.
struct WeirCrest {
  std::optional<double> height_m;  // above the zero of the grid's depths; nullopt: no height is given
  double subcritical = 1.0;        // 0 or more
  double supercritical = 1.0;      // 0 or more
};

// A feature of the input whose lines are weirs.
struct WeirSource {
  std::string name;                       // as in GridLine
  std::vector<std::vector<Point>> lines;  // in the grid's CRS
  WeirCrest crest;
  std::string feature{};  // for messages: "'levees.gpkg', feature 12"
};

// The weirs of the input, in its order. `zero_m`: metres, the height of the zero of the grid's depths in terms of the
// attributes. Throws InputError if a height or coefficient is no number, or a coefficient is negative.
std::vector<WeirSource> weirSources(const Coastline& coastline, double zero_m);

// The feature that the line of a grid comes from: of those with its name the closest to its edges, and of equally close
// ones the first. The mesh's coast may have moved a line a little. Null if there is none.
const WeirSource* sourceOf(const Grid& grid, const GridLine& line, const std::vector<WeirSource>& sources);

// For messages: "weir 'north' ('levees.gpkg', feature 12) from 5.1, 52.3". `source`: its feature; may be null.
std::string lineInWords(const Grid& grid, const GridLine& line, const WeirSource* source);

// True if the line of the grid runs as the lines of its feature do, at its first edge.
bool runsAsSource(const Grid& grid, const GridLine& line, const WeirSource& source);

}  // namespace coastmesh
