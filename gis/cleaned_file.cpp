#include "gis/cleaned_file.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "gis/join_lines.hpp"
#include "gis/nest_rings.hpp"

namespace coastmesh {

namespace {

OGRLayer* layerNamed(const OpenSource& source, std::string_view name) {
  for (OGRLayer* layer : source.layers) {
    if (layer->GetName() == name) return layer;
  }
  return nullptr;
}

bool isPslg(OGRLayer& layer) {
  return std::ranges::all_of(std::vector<const char*>{"kind", "region", "left_fid", "right_fid"},
                             [&](const char* field) { return layer.GetLayerDefn()->GetFieldIndex(field) >= 0; });
}

// A part of the plane graph with the number of a feature.
using AreaKey = std::pair<std::int64_t, std::int64_t>;
using Lines = std::vector<std::vector<Point>>;

bool jumps(const Ring& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (std::abs(ring[i].x - ring[(i + 1) % ring.size()].x) > 180) return true;
  }
  return false;
}

// A vertex on the antimeridian has one place for the areas on both sides: it goes to the side of the ring's others.
void putOnOneSide(Ring& ring) {
  bool west = false, east = false;
  for (const Point& p : ring) {
    if (std::abs(p.x) == 180) continue;
    (p.x < 0 ? west : east) = true;
  }
  if (west == east) return;
  for (Point& p : ring) {
    if (std::abs(p.x) == 180) p.x = west ? -180 : 180;
  }
}

// The feature whose rim the lines are.
Feature areaOf(std::int64_t fid, const Lines& rim, const std::string& source, bool geographic) {
  Feature feature;
  feature.fid = fid;
  feature.source = source;
  JoinedLines joined = joinLines(rim);
  std::vector<Ring> rings;
  for (JoinedLines::Part& part : joined.rings) rings.push_back(std::move(part.points));
  if (geographic) {
    for (Ring& ring : rings) putOnOneSide(ring);
  }
  feature.clipped = std::ranges::any_of(rings, jumps);
  for (const NestedRing& nested : nestRings(rings)) {
    Polygon& polygon = feature.polygons.emplace_back();
    polygon.outer = std::move(rings[nested.outer]);
    for (const std::size_t hole : nested.holes) polygon.holes.push_back(std::move(rings[hole]));
  }
  return feature;
}

struct Cleaned {
  std::map<AreaKey, Lines> rims;
  std::map<FeatureUse, Lines> lines;
  std::vector<Point> vertices;
  Box bounds;
};

void takeEdges(OGRLayer& layer, Cleaned& cleaned, ReadReport& report) {
  const OGRFeatureDefn& fields = *layer.GetLayerDefn();
  const int kind = fields.GetFieldIndex("kind"), region = fields.GetFieldIndex("region");
  const int left = fields.GetFieldIndex("left_fid"), right = fields.GetFieldIndex("right_fid");
  for (const auto& row : layer) {
    const OGRGeometry* geometry = row->GetGeometryRef();
    if (!geometry || wkbFlatten(geometry->getGeometryType()) != wkbLineString) continue;
    const OGRLineString& line = *geometry->toLineString();
    std::vector<Point> points;
    for (int i = 0; i < line.getNumPoints(); ++i) points.push_back({line.getX(i), line.getY(i)});
    for (const Point& p : points) cleaned.bounds.add(p);
    report.points += points.size();
    const std::int64_t part = row->GetFieldAsInteger64(region);
    const std::int64_t on_left = row->GetFieldAsInteger64(left), on_right = row->GetFieldAsInteger64(right);
    if (on_left != on_right) {
      if (on_left >= 0) cleaned.rims[{part, on_left}].push_back(points);
      if (on_right >= 0) cleaned.rims[{part, on_right}].push_back(points);
    }
    const std::string_view name = row->GetFieldAsString(kind);
    if (name == "open") cleaned.lines[FeatureUse::Open].push_back(std::move(points));
    if (name == "weir") cleaned.lines[FeatureUse::Weir].push_back(std::move(points));
    if (name == "constraint") cleaned.lines[FeatureUse::Constraint].push_back(std::move(points));
  }
}

void takePoints(OGRLayer& layer, Cleaned& cleaned) {
  for (const auto& row : layer) {
    const OGRGeometry* geometry = row->GetGeometryRef();
    if (!geometry || wkbFlatten(geometry->getGeometryType()) != wkbPoint) continue;
    cleaned.vertices.push_back({geometry->toPoint()->getX(), geometry->toPoint()->getY()});
    cleaned.bounds.add(cleaned.vertices.back());
  }
}

void takeEdits(OGRLayer& layer, ReadReport& report) {
  const OGRFeatureDefn& fields = *layer.GetLayerDefn();
  const int kind = fields.GetFieldIndex("kind"), fid = fields.GetFieldIndex("fid_of_feature");
  if (kind < 0 || fid < 0) return;
  for (const auto& row : layer) {
    const OGRGeometry* geometry = row->GetGeometryRef();
    if (!geometry || wkbFlatten(geometry->getGeometryType()) != wkbPoint) continue;
    report.edits.push_back({row->GetFieldAsString(kind),
                            {geometry->toPoint()->getX(), geometry->toPoint()->getY()},
                            row->GetFieldAsInteger64(fid)});
  }
}

}  // namespace

std::optional<std::vector<RawLayer>> readCleaned(const OpenSource& source, ReadReport& report) {
  OGRLayer* const pslg = layerNamed(source, kPslgLayer);
  if (!pslg || !isPslg(*pslg)) return std::nullopt;
  report.cleaned = true;
  Cleaned cleaned;
  takeEdges(*pslg, cleaned, report);
  if (OGRLayer* const vertices = layerNamed(source, kVertexLayer)) takePoints(*vertices, cleaned);
  if (OGRLayer* const edits = layerNamed(source, kEditLayer)) takeEdits(*edits, report);

  std::vector<RawLayer> layers;
  const auto add = [&](FeatureUse use) -> RawLayer& {
    RawLayer& layer = layers.emplace_back();
    layer.source = source.name;
    layer.use = use;
    layer.bounds = cleaned.bounds;
    const OGRSpatialReference* srs = pslg->GetSpatialRef();
    if (srs && !srs->IsEmpty()) layer.crs = fromOgr(srs);
    return layer;
  };
  RawLayer& areas = add(FeatureUse::Area);
  for (const auto& [key, rim] : cleaned.rims) {
    areas.features.push_back(areaOf(key.second, rim, source.name, areas.crs && areas.crs->geographic));
    for (const Polygon& polygon : areas.features.back().polygons) report.rings += 1 + polygon.holes.size();
  }
  for (auto& [use, lines] : cleaned.lines) {
    RawLayer& layer = add(use);
    Feature& feature = layer.line_features.emplace_back();
    feature.source = source.name;
    feature.use = use;
    for (auto& line : lines) layer.lines.push_back({std::move(line), 0});
  }
  if (!cleaned.vertices.empty()) {
    RawLayer& layer = add(FeatureUse::Constraint);
    Feature& feature = layer.line_features.emplace_back();
    feature.source = source.name;
    feature.use = FeatureUse::Constraint;
    feature.points = std::move(cleaned.vertices);
  }
  return layers;
}

}  // namespace coastmesh
