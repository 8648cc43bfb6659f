#include "gis/size/guide_lines.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "gis/coast/feature_names.hpp"
#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/read/read_layers.hpp"

namespace coastmesh {

std::vector<ShoreLine> readGuideLines(const std::string& source, const Crs& crs) {
  ReadReport ignored;
  std::vector<ShoreLine> lines;
  for (RawLayer& layer : readLayers({source, FeatureUse::Area}, {}, ignored)) {
    std::optional<CrsMap> map;
    if (layer.crs && !layer.crs->isPlane() && !crs.isPlane()) map.emplace(toOgr(*layer.crs), toOgr(crs));
    for (RawLayer::Line& line : layer.lines) {
      const Feature& feature = layer.line_features[line.feature];
      for (Point& p : line.points) {
        if (map) p = map->forward(p);
        if (!std::isfinite(p.x) || !std::isfinite(p.y))
          throw InputError(featureInWords(feature) +
                           ": has a place that the input's coordinate system does not reach; take it out");
      }
      lines.push_back({std::move(line.points), std::string(nameOf(feature.attributes))});
    }
  }
  if (lines.empty())
    throw InputError(sourceInWords(source) + ": holds no lines; draw each passage or barrier as a line");
  return lines;
}

std::vector<ShoreLine> projected(const std::vector<ShoreLine>& lines, const Projection& projection) {
  std::vector<ShoreLine> plane;
  for (ShoreLine line : lines) {
    for (Point& p : line.points) p = projection.forward(p);
    const auto reached = [](const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y); };
    if (std::ranges::all_of(line.points, reached)) plane.push_back(std::move(line));
  }
  return plane;
}

}  // namespace coastmesh
