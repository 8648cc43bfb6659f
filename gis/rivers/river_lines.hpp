#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"

namespace coastmesh {

// The centre line of a river, or of a part of one.
struct RiverLine {
  std::vector<Point> points;                                  // in the CRS of the mesh; longitudes do not jump
  double width_m = 0.0;                                       // above 0; NaN: not given
  std::vector<double> widths_m{};                             // at the points; empty: the same everywhere
  double depth_m = std::numeric_limits<double>::quiet_NaN();  // of its bed, below the zero of depths; NaN: not given
  std::string name;                                           // empty: none
  std::string source;                                         // the file, or "file|layer"
  std::int64_t fid = 0;
};

// The name of a river for messages, or what it is: "'rivers.gpkg', feature 3".
std::string nameOf(const RiverLine& line);

// The attributes of lines.
struct RiverColumns {
  std::string width = "width";
  std::string depth = "depth";
  std::string name = "name";
};

// Reads the lines of what `openSource` opens: all vector layers, or the one that `path` names. Coordinates are brought
// to `crs`; a source without a CRS is taken to be in it. `usual_width_m`: of lines without a width; NaN leaves them
// without. Features without a shape are left out. Throws InputError: unreadable, damaged; a feature that is no line,
// has no width, or a depth or a width that is no number; no line at all; no column of depths or names, if it is not the
// usual one.
std::vector<RiverLine> readRiverLines(const std::string& path, const Crs& crs, const RiverColumns& columns,
                                      const std::optional<double>& usual_width_m);

}  // namespace coastmesh
