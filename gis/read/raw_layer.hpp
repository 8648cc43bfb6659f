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
  std::optional<Crs> crs;              // nullopt: the file has none
  std::vector<Feature> features;       // features with polygons
  std::vector<Feature> line_features;  // features with lines or points; the lines are in `lines`
  std::vector<Line> lines;
  std::vector<std::string> columns;  // of its table, including those without values
  Box bounds;

  bool empty() const { return features.empty() && line_features.empty(); }
};

}  // namespace coastmesh
