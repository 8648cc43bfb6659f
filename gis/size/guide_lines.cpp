#include "gis/size/guide_lines.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/read/ogr_geometry.hpp"

namespace coastmesh {

namespace {

void readLayer(OGRLayer& layer, const std::string& source, const Crs& crs, std::vector<ShoreLine>& lines) {
  const int name_field = layer.GetLayerDefn()->GetFieldIndex("name");
  std::optional<CrsMap> map;
  const OGRSpatialReference* srs = layer.GetSpatialRef();
  if (srs && !srs->IsEmpty() && !crs.isPlane()) {
    OGRSpatialReference from(*srs);
    from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    map.emplace(from, toOgr(crs));
  }
  layer.ResetReading();
  for (const OGRFeatureUniquePtr& feature : layer) {
    const OGRGeometry* geometry = feature->GetGeometryRef();
    if (!geometry || geometry->IsEmpty()) continue;
    const std::string what = source + ", feature " + std::to_string(feature->GetFID());
    GeometryParts parts;
    takeApart(*geometry, what, parts);
    for (std::vector<Point>& points : parts.lines) {
      for (Point& p : points) {
        if (map) p = map->forward(p);
        if (!std::isfinite(p.x) || !std::isfinite(p.y))
          throw InputError(what + ": has a place that the input's coordinate system does not reach; take it out");
      }
      const bool named = name_field >= 0 && feature->IsFieldSetAndNotNull(name_field);
      lines.push_back({std::move(points), named ? feature->GetFieldAsString(name_field) : ""});
    }
  }
}

}  // namespace

std::vector<ShoreLine> readGuideLines(const std::string& source, const Crs& crs) {
  GDALAllRegister();
  const OgrErrors errors;
  const std::unique_ptr<GDALDataset> dataset(
      GDALDataset::Open(source.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
  if (!dataset) {
    throw InputError(source + ": cannot be read as lines" +
                     (errors.text().empty() ? "; check the path" : " (" + errors.text() + ")"));
  }
  std::vector<ShoreLine> lines;
  for (OGRLayer* layer : dataset->GetLayers())
    readLayer(*layer, dataset->GetLayerCount() > 1 ? source + "|" + layer->GetName() : source, crs, lines);
  if (lines.empty()) throw InputError(source + ": holds no lines; draw each passage or barrier as a line");
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
