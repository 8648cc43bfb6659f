#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

// A layer as OGR gives it, in its own CRS.
struct RawLayer {
  struct Line {
    std::vector<Point> points;
    std::size_t feature = 0;  // index into `line_features`
  };
  std::string source;  // "file" or "file|layer"
  FeatureUse use = FeatureUse::Area;
  std::optional<Crs> crs;              // none: the file does not say
  std::vector<Feature> features;       // those with polygons
  std::vector<Feature> line_features;  // those with lines or points: name and attributes
  std::vector<Line> lines;
  std::vector<std::string> columns;  // of its table, also those without a value anywhere
  Box bounds;

  bool empty() const { return features.empty() && line_features.empty(); }
};

}  // namespace coastmesh
