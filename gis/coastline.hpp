#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/point.hpp"
#include "gis/crs.hpp"

namespace coastmesh {

// A closed chain of points; the first is not repeated at the end. Either orientation.
using Ring = std::vector<Point>;

struct Polygon {
  Ring outer;
  std::vector<Ring> holes;
};

// One feature of a vector layer.
struct Feature {
  std::int64_t fid = 0;
  std::string source;  // "file" or "file|layer", as errors name it
  std::vector<Polygon> polygons;
  std::vector<std::vector<Point>> lines;                        // open chains, of line features that closed no ring
  std::vector<std::pair<std::string, std::string>> attributes;  // name, value as text; nulls are left out
};

// What was read, in the input's own CRS and with its own coordinates, nothing mended yet.
struct Coastline {
  std::vector<Feature> features;
  Crs crs;
};

}  // namespace coastmesh
