#include "gis/rivers/river_lines.hpp"

#include <ogrsf_frmts.h>

#include <cmath>
#include <utility>

#include "gis/coast/feature_names.hpp"
#include "gis/coast/turned_rings.hpp"
#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/read/geojson_crs.hpp"
#include "gis/read/number_attribute.hpp"
#include "gis/read/ogr_geometry.hpp"
#include "gis/read/open_source.hpp"

namespace coastmesh {

namespace {

class LayerReader {
 public:
  LayerReader(OGRLayer& layer, std::string source, const Crs& crs, const RiverColumns& columns,
              const std::optional<double>& usual_width_m)
      : layer_(layer),
        source_(std::move(source)),
        crs_(crs),
        columns_(columns),
        usual_width_m_(usual_width_m),
        width_(fieldOf(columns.width)),
        depth_(fieldOf(columns.depth)),
        name_(fieldOf(columns.name)) {
    if (width_ < 0 && !usual_width_m)
      throw InputError(sourceInWords(source_) + ": has no attribute '" + columns.width +
                       "' with the widths of rivers in metres; name another with --width-column, or give one --width "
                       "for all");
    const OGRSpatialReference* srs = layer.GetSpatialRef();
    if (srs == nullptr || srs->IsEmpty() || crs.isPlane()) return;
    OGRSpatialReference from(*srs);
    from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    map_.emplace(from, toOgr(crs));
  }

  bool hasDepth() const { return depth_ >= 0; }
  bool hasName() const { return name_ >= 0; }

  void read(std::vector<RiverLine>& lines) {
    layer_.ResetReading();
    for (const OGRFeatureUniquePtr& feature : layer_) {
      const OGRGeometry* geometry = feature->GetGeometryRef();
      if (geometry == nullptr || geometry->IsEmpty()) continue;
      RiverLine line;
      line.source = source_;
      line.fid = feature->GetFID();
      const std::string what = featureInWords(line.source, line.fid);
      GeometryParts parts;
      takeApart(*geometry, what, parts);
      if (!parts.polygons.empty() || !parts.points.empty())
        throw InputError(what + ": is " + (parts.polygons.empty() ? "a point" : "a polygon") +
                         ", not the centre line of a river");
      line.width_m = widthOf(*feature, what);
      if (const auto depth = numberAttribute(*feature, depth_, -kInfinity, what)) line.depth_m = *depth;
      if (name_ >= 0 && feature->IsFieldSetAndNotNull(name_)) line.name = feature->GetFieldAsString(name_);
      for (std::vector<Point>& points : parts.lines) {
        line.points = placed(std::move(points), what);
        lines.push_back(line);
      }
    }
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  int fieldOf(const std::string& column) const { return layer_.GetLayerDefn()->GetFieldIndex(column.c_str()); }

  double widthOf(const OGRFeature& feature, const std::string& what) const {
    if (const auto width = numberAttribute(feature, width_, std::numeric_limits<double>::min(), what)) return *width;
    if (usual_width_m_) return *usual_width_m_;
    throw InputError(what + ": has no value in '" + columns_.width + "'; give it a width, or --width for all without");
  }

  std::vector<Point> placed(std::vector<Point> points, const std::string& what) const {
    for (Point& p : points) {
      if (map_) p = map_->forward(p);
      if (!std::isfinite(p.x) || !std::isfinite(p.y))
        throw InputError(what + ": has a place that the mesh's coordinate system does not reach; take it out");
    }
    if (!crs_.geographic) return points;
    constexpr double kTurn = 360.0;
    const Turns turns = turnsOf(points, false);
    for (std::size_t i = 0; i < points.size() && turns.any; ++i) points[i].x += kTurn * turns.of[i];
    return points;
  }

  OGRLayer& layer_;
  std::string source_;
  const Crs& crs_;
  const RiverColumns& columns_;
  const std::optional<double>& usual_width_m_;
  int width_, depth_, name_;
  std::optional<CrsMap> map_;
};

// A column that is not the usual one must be there.
void requireNamed(const std::string& source, const std::string& column, const std::string& usual, bool is_there) {
  if (!is_there && column != usual) throw InputError(sourceInWords(source) + ": has no attribute '" + column + "'");
}

}  // namespace

std::string nameOf(const RiverLine& line) {
  return line.name.empty() ? featureInWords(line.source, line.fid) : "'" + line.name + "'";
}

std::vector<RiverLine> readRiverLines(const std::string& path, const Crs& crs, const RiverColumns& columns,
                                      const std::optional<double>& usual_width_m) {
  const OgrErrors errors;
  const OgrOption any_size("OGR_GEOJSON_MAX_OBJ_SIZE", "0");
  const OgrOption what_is_left_out("CPL_DEBUG", "GeoJSON");
  const OpenSource source = openSource(path, {}, errors);
  refuseOddGeojson(source, errors);
  requireKnownCrs(source);
  std::vector<RiverLine> lines;
  const bool only = source.dataset->GetLayerCount() == 1;
  bool has_depth = false, has_name = false;
  for (OGRLayer* layer : source.layers) {
    const std::string name = only ? source.name : source.name + "|" + layer->GetName();
    LayerReader reader(*layer, name, crs, columns, usual_width_m);
    reader.read(lines);
    requireReadToEnd(source, errors);
    has_depth = has_depth || reader.hasDepth();
    has_name = has_name || reader.hasName();
  }
  requireNamed(source.name, columns.depth, RiverColumns{}.depth, has_depth);
  requireNamed(source.name, columns.name, RiverColumns{}.name, has_name);
  if (lines.empty()) throw InputError(sourceInWords(source.name) + ": no feature in it is a line");
  return lines;
}

}  // namespace coastmesh
