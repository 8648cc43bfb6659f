#include "gis/read/cleaned_file.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "gis/coast/feature_names.hpp"
#include "gis/coast/join_lines.hpp"
#include "gis/coast/nest_rings.hpp"
#include "gis/crs/crs_from_ogr.hpp"
#include "gis/error.hpp"
#include "gis/read/ogr_geometry.hpp"

namespace coastmesh {

namespace {

OGRLayer* layerNamed(const OpenSource& source, std::string_view name) {
  for (OGRLayer* layer : source.dataset->GetLayers()) {
    if (layer->GetName() == name) return layer;
  }
  return nullptr;
}

bool hasFields(OGRLayer& layer, std::initializer_list<const char*> names) {
  return std::ranges::all_of(names, [&](const char* field) { return layer.GetLayerDefn()->GetFieldIndex(field) >= 0; });
}

using Lines = std::vector<std::vector<Point>>;

bool jumps(const Ring& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (std::abs(ring[i].x - ring[(i + 1) % ring.size()].x) > 180) return true;
  }
  return false;
}

// Areas on both sides of the antimeridian share the vertices on it: moves these to the side of the ring's other ones.
void putOnOneSide(Ring& ring) {
  bool west = false, east = false;
  for (const Point& p : ring) {
    if (std::abs(p.x) == 180) continue;
    west = west || p.x < 0;
    east = east || p.x >= 0;
  }
  if (west == east) return;
  for (Point& p : ring) {
    if (std::abs(p.x) == 180) p.x = west ? -180 : 180;
  }
}

// Adds the polygons bounded by the lines to the feature.
void addAreas(const Lines& lines, bool geographic, Feature& feature) {
  JoinedLines joined = joinLines(lines);
  std::vector<Ring> rings;
  for (JoinedLines::Part& part : joined.rings) rings.push_back(std::move(part.points));
  if (geographic) {
    for (Ring& ring : rings) putOnOneSide(ring);
  }
  feature.clipped = std::ranges::any_of(rings, jumps);
  for (const NestedRing& nested : nestRings(rings, geographic)) {
    Polygon& polygon = feature.polygons.emplace_back();
    polygon.outer = std::move(rings[nested.outer]);
    for (const std::size_t hole : nested.holes) polygon.holes.push_back(std::move(rings[hole]));
  }
}

using FeatureId = std::int64_t;  // `id` in the layer `features`

struct Cleaned {
  std::map<FeatureId, Feature> features;  // with fid, source and attributes only
  std::map<FeatureId, Lines> area_lines;
  std::map<FeatureId, std::int64_t> part_of;  // of areas: the part of the graph
  std::map<std::pair<FeatureUse, FeatureId>, Lines> lines;
  std::map<std::pair<std::string, std::string>, Lines> boundaries;  // by type and name
  std::map<FeatureId, std::vector<Polygon>> regions;
  std::map<std::int64_t, std::map<std::int64_t, Point>> vertices;  // by part and number
  std::vector<Point> alone;                                        // vertices without edges
  Box bounds;
};

// Calls `take(row)` for each row; `layer` may be null.
template <typename Take>
void forEachRow(OGRLayer* layer, Take&& take) {
  if (layer == nullptr) return;
  for (const auto& row : *layer) take(*row);
}

std::int64_t wholeOf(const OGRFeature& row, const char* field) {
  return row.GetFieldAsInteger64(row.GetFieldIndex(field));
}
std::string textOf(const OGRFeature& row, const char* field) { return row.GetFieldAsString(row.GetFieldIndex(field)); }
// Empty if there is no such field.
std::string textIfAny(const OGRFeature& row, const char* field) {
  return row.GetFieldIndex(field) < 0 ? std::string() : textOf(row, field);
}

// Reads the rows of layers with shapes of one type.
class ShapeReader {
 public:
  ShapeReader(std::string source, ReadReport& report) : source_(std::move(source)), report_(report) {}

  // The row's shape; no parts if it has none, or one of another type.
  GeometryParts shapeOf(const OGRFeature& row, OGRwkbGeometryType type) const {
    GeometryParts parts;
    const OGRGeometry* geometry = row.GetGeometryRef();
    if (!geometry || geometry->IsEmpty()) {
      ++report_.skipped_empty;
    } else if (wkbFlatten(geometry->getGeometryType()) == type) {
      takeApart(*geometry, featureInWords(source_ + "|" + row.GetDefnRef()->GetName(), row.GetFID()), parts);
    }
    return parts;
  }

  ReadReport& report() const { return report_; }

 private:
  std::string source_;
  ReadReport& report_;
};

void takeFeatures(OGRLayer* features, OGRLayer* attributes, Cleaned& cleaned) {
  forEachRow(features, [&](const OGRFeature& row) {
    Feature& feature = cleaned.features[wholeOf(row, "id")];
    feature.fid = wholeOf(row, "fid_of_feature");
    feature.source = textOf(row, "source");
  });
  forEachRow(attributes, [&](const OGRFeature& row) {
    const auto feature = cleaned.features.find(wholeOf(row, "feature_id"));
    if (feature != cleaned.features.end())
      feature->second.attributes.emplace_back(textOf(row, "name"), textOf(row, "value"));
  });
}

std::optional<FeatureUse> useOfKind(std::string_view kind) {
  if (kind == "open") return FeatureUse::Open;
  if (kind == "weir") return FeatureUse::Weir;
  if (kind == "constraint") return FeatureUse::Constraint;
  return kind == "region" ? std::optional(FeatureUse::Region) : std::nullopt;
}

void takeEdges(OGRLayer* layer, const ShapeReader& shapes, Cleaned& cleaned) {
  forEachRow(layer, [&](const OGRFeature& row) {
    GeometryParts parts = shapes.shapeOf(row, wkbLineString);
    if (parts.lines.empty() || parts.lines.front().size() < 2) return;
    std::vector<Point> points = std::move(parts.lines.front());
    for (const Point& p : points) cleaned.bounds.add(p);
    shapes.report().points += points.size();
    const std::int64_t part = wholeOf(row, "region");
    cleaned.vertices[part].emplace(wholeOf(row, "first"), points.front());
    cleaned.vertices[part].emplace(wholeOf(row, "last"), points.back());
    const FeatureId left = wholeOf(row, "left_id"), right = wholeOf(row, "right_id");
    for (const FeatureId side : {left, right}) {
      if (side <= 0 || left == right) continue;
      cleaned.area_lines[side].push_back(points);
      cleaned.part_of[side] = part;
    }
    if (std::string type = textIfAny(row, kBoundaryField); !type.empty())
      cleaned.boundaries[{std::move(type), textIfAny(row, kBoundaryNameField)}].push_back(points);
    if (const auto use = useOfKind(textOf(row, "kind")))
      cleaned.lines[{*use, wholeOf(row, "line_id")}].push_back(std::move(points));
  });
}

void takeVertices(OGRLayer* layer, const ShapeReader& shapes, Cleaned& cleaned) {
  forEachRow(layer, [&](const OGRFeature& row) {
    for (const Point& p : shapes.shapeOf(row, wkbPoint).points) {
      cleaned.alone.push_back(p);
      cleaned.bounds.add(p);
      cleaned.vertices[wholeOf(row, "region")].emplace(wholeOf(row, "number"), p);
    }
  });
}

void takeRegions(OGRLayer* layer, const ShapeReader& shapes, Cleaned& cleaned) {
  forEachRow(layer, [&](const OGRFeature& row) {
    for (Polygon& polygon : shapes.shapeOf(row, wkbPolygon).polygons)
      cleaned.regions[wholeOf(row, "feature_id")].push_back(std::move(polygon));
  });
}

void takeEdits(OGRLayer* layer, const ShapeReader& shapes) {
  if (!layer || !hasFields(*layer, {"kind", "fid_of_feature"})) return;
  const bool has_source = hasFields(*layer, {"source"});
  forEachRow(layer, [&](const OGRFeature& row) {
    for (const Point& p : shapes.shapeOf(row, wkbPoint).points)
      shapes.report().edits.push_back(
          {textOf(row, "kind"), p, wholeOf(row, "fid_of_feature"), has_source ? textOf(row, "source") : ""});
  });
}

// A GIS names the layer that it shows. As an area, that layer means nothing without the others.
bool isReadWhole(const OpenSource& source, FeatureUse given_as) {
  if (source.layers.size() == static_cast<std::size_t>(source.dataset->GetLayerCount())) return true;
  return given_as == FeatureUse::Area && source.layers.size() == 1 &&
         source.layers[0]->GetName() == std::string_view(kPslgLayer) && layerNamed(source, kFeatureLayer) != nullptr;
}

[[noreturn]] void refuseAsGuest(const OpenSource& source, FeatureUse use) {
  const bool regions = use == FeatureUse::Region && layerNamed(source, kRegionLayer) != nullptr;
  throw InputError(source.name +
                   ": coastmesh clean wrote it, so that it can be the input, but as anything else only one of its "
                   "layers can be read: name it, such as " +
                   source.name + "|" + (regions ? kRegionLayer : kPslgLayer));
}

// Makes layers as if the inputs of `clean` had been read.
class CleanedLayers {
 public:
  CleanedLayers(Cleaned&& cleaned, std::string source, std::optional<Crs> crs)
      : cleaned_(std::move(cleaned)), source_(std::move(source)), crs_(std::move(crs)) {}

  std::vector<RawLayer> run(ReadReport& report) {
    addAreaLayer(report);
    for (const FeatureUse use : {FeatureUse::Constraint, FeatureUse::Weir, FeatureUse::Open}) addLineLayer(use);
    addRegionLayer();
    for (const auto& [type, lines] : cleaned_.boundaries) addBoundaryLayer(type.first, type.second, lines);
    addPointLayer();
    return std::move(layers_);
  }

 private:
  RawLayer& add(FeatureUse use) {
    RawLayer& layer = layers_.emplace_back();
    layer.source = source_;
    layer.use = use;
    layer.bounds = cleaned_.bounds;
    layer.crs = crs_;
    return layer;
  }

  // A feature of the layer `features`, or one without attributes.
  Feature featureOf(FeatureId id, FeatureUse use) const {
    const auto known = cleaned_.features.find(id);
    Feature feature = known == cleaned_.features.end() ? Feature{} : known->second;
    if (feature.source.empty()) feature.source = source_;
    feature.use = use;
    return feature;
  }

  Feature& addLineFeature(RawLayer& layer) const {
    Feature& feature = layer.line_features.emplace_back();
    feature.source = source_;
    feature.use = layer.use;
    return feature;
  }

  void addAreaLayer(ReadReport& report) {
    RawLayer& layer = add(FeatureUse::Area);
    std::set<std::int64_t> parts;
    for (const auto& [id, lines] : cleaned_.area_lines) {
      Feature& feature = layer.features.emplace_back(featureOf(id, FeatureUse::Area));
      addAreas(lines, crs_ && crs_->geographic, feature);
      for (const Polygon& polygon : feature.polygons) report.rings += 1 + polygon.holes.size();
      const std::int64_t part = cleaned_.part_of.at(id);
      if (!parts.insert(part).second) continue;
      for (const auto& [number, place] : cleaned_.vertices[part]) feature.vertex_order.push_back(place);
    }
  }

  void addLineLayer(FeatureUse use) {
    const auto has_use = [use](const auto& entry) { return entry.first.first == use; };
    if (std::ranges::none_of(cleaned_.lines, has_use)) return;
    RawLayer& layer = add(use);
    for (auto& [key, lines] : cleaned_.lines) {
      if (key.first != use) continue;
      for (auto& line : lines) layer.lines.push_back({std::move(line), layer.line_features.size()});
      layer.line_features.push_back(featureOf(key.second, use));
    }
  }

  void addRegionLayer() {
    if (cleaned_.regions.empty()) return;
    RawLayer& layer = add(FeatureUse::Region);
    for (auto& [id, polygons] : cleaned_.regions) {
      Feature& feature = layer.features.emplace_back(featureOf(id, FeatureUse::Region));
      feature.polygons = std::move(polygons);
      const auto border = cleaned_.lines.find({FeatureUse::Region, id});
      if (border != cleaned_.lines.end()) feature.lines = std::move(border->second);
    }
  }

  void addBoundaryLayer(const std::string& type, const std::string& name, const Lines& lines) {
    RawLayer& layer = add(FeatureUse::Boundary);
    Feature& feature = addLineFeature(layer);
    feature.attributes = {{kBoundaryField, type}};
    if (!name.empty()) feature.attributes.emplace_back("name", name);
    JoinedLines joined = joinLines(lines);
    for (JoinedLines::Part& ring : joined.rings) {
      ring.points.push_back(ring.points.front());
      layer.lines.push_back({std::move(ring.points), 0});
    }
    for (JoinedLines::Part& part : joined.open) layer.lines.push_back({std::move(part.points), 0});
  }

  void addPointLayer() {
    if (cleaned_.alone.empty()) return;
    addLineFeature(add(FeatureUse::Constraint)).points = std::move(cleaned_.alone);
  }

  Cleaned cleaned_;
  std::string source_;
  std::optional<Crs> crs_;
  std::vector<RawLayer> layers_;
};

std::optional<Crs> crsOf(OGRLayer& layer, const std::string& source) {
  const OGRSpatialReference* srs = layer.GetSpatialRef();
  return srs && !srs->IsEmpty() ? std::optional(fromOgr(srs, sourceInWords(source))) : std::nullopt;
}

}  // namespace

std::optional<std::vector<RawLayer>> readCleaned(const OpenSource& source, FeatureUse given_as, const OgrErrors& errors,
                                                 ReadReport& report) {
  if (!isReadWhole(source, given_as)) return std::nullopt;
  OGRLayer* const pslg = layerNamed(source, kPslgLayer);
  if (!pslg || !hasFields(*pslg, {"kind", "region", "left_fid", "right_fid"})) return std::nullopt;
  if (given_as != FeatureUse::Area) refuseAsGuest(source, given_as);
  OGRLayer* const features = layerNamed(source, kFeatureLayer);
  OGRLayer* const attributes = layerNamed(source, kAttributeLayer);
  if (!features || !attributes || !hasFields(*pslg, {"left_id", "right_id", "line_id", "first", "last"}))
    throw InputError(source.name +
                     ": an older coastmesh cleaned it, and it does not say all that is needed; clean the "
                     "input again");
  report.cleaned = true;
  Cleaned cleaned;
  takeFeatures(features, attributes, cleaned);
  const ShapeReader shapes(source.name, report);
  takeEdges(pslg, shapes, cleaned);
  takeVertices(layerNamed(source, kVertexLayer), shapes, cleaned);
  takeRegions(layerNamed(source, kRegionLayer), shapes, cleaned);
  takeEdits(layerNamed(source, kEditLayer), shapes);
  requireReadToEnd(source, errors);

  return CleanedLayers(std::move(cleaned), source.name, crsOf(*pslg, source.name)).run(report);
}

}  // namespace coastmesh
