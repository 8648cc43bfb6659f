#include "gis/format/read_ogr_grid.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <regex>
#include <span>
#include <tuple>

#include "core/ids.hpp"
#include "gis/crs/crs_from_ogr.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/fields/field_names.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/for_count.hpp"
#include "gis/format/edited_layers.hpp"
#include "gis/format/grid_layers.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/grid/map_parts.hpp"
#include "gis/grid/nodes_by_place.hpp"
#include "gis/grid/wind_triangles.hpp"

namespace coastmesh {
namespace {

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using DatasetPtr = std::unique_ptr<GDALDataset, CloseDataset>;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

class LayerReader {
 public:
  LayerReader(OGRLayer& layer, std::string path, const OgrErrors& errors)
      : layer_(layer), path_(std::move(path)), errors_(errors) {
    layer_.ResetReading();
  }

  const OGRFeature* next() {
    feature_.reset(layer_.GetNextFeature());
    if (!feature_ && errors_.failed()) throw InputError("cannot read '" + path_ + "': " + errors_.text());
    return feature_.get();
  }

  // -1 if there is none.
  int field(std::string_view name) const { return layer_.GetLayerDefn()->GetFieldIndex(std::string(name).c_str()); }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError("'" + path_ + "', layer \"" + layer_.GetName() + "\", feature " +
                     std::to_string(feature_ ? feature_->GetFID() : 0) + ": " + what);
  }

 private:
  OGRLayer& layer_;
  std::string path_;
  const OgrErrors& errors_;
  OGRFeatureUniquePtr feature_;
};

DatasetPtr open(const std::string& path, const OgrErrors& errors) {
  registerDrivers();
  DatasetPtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
  if (!dataset) throw InputError("cannot read '" + path + "'" + (errors.text().empty() ? "" : ": " + errors.text()));
  return dataset;
}

OGRLayer& triangleLayer(GDALDataset& dataset, const std::string& path) {
  if (OGRLayer* const layer = dataset.GetLayerByName(std::string(kTriangleLayer).c_str())) return *layer;
  std::vector<OGRLayer*> polygons;
  for (OGRLayer* const layer : dataset.GetLayers()) {
    const OGRwkbGeometryType type = wkbFlatten(layer->GetGeomType());
    if (type == wkbPolygon || type == wkbMultiPolygon || type == wkbTriangle || type == wkbTIN || type == wkbUnknown)
      polygons.push_back(layer);
  }
  if (polygons.size() != 1)
    throw InputError("'" + path + "' has " +
                     (polygons.empty() ? "no layer" : std::to_string(polygons.size()) + " layers") +
                     " of polygons and none is called \"" + std::string(kTriangleLayer) + "\"");
  return *polygons.front();
}

// A layer that belongs to the triangles: in the same file, or in a file of its own beside it.
struct Companion {
  DatasetPtr dataset;  // null if the layer is in the triangles' file
  OGRLayer* layer = nullptr;
  std::string path;
};

Companion findCompanion(GDALDataset& dataset, const std::string& path, std::string_view name, const OgrErrors& errors) {
  if (OGRLayer* const layer = dataset.GetLayerByName(std::string(name).c_str())) return {nullptr, layer, path};
  const std::string beside = pathOfLayer(path, name);
  if (!std::filesystem::exists(beside)) return {};
  DatasetPtr other = open(beside, errors);
  OGRLayer* const layer = other->GetLayerCount() > 0 ? other->GetLayer(0) : nullptr;
  return {std::move(other), layer, beside};
}

Point placeOf(const OGRSimpleCurve& chain, int i) { return {chain.getX(i), chain.getY(i)}; }

// The points of each part of a polygon, in the file's order. This order does not determine the winding, since formats
// and programs have different conventions. Rings do not repeat their first point.
std::vector<std::vector<Point>> partsOf(const OGRFeature& feature, const LayerReader& reader) {
  const OGRGeometry* geometry = feature.GetGeometryRef();
  if (geometry == nullptr || geometry->IsEmpty()) reader.fail("it has no geometry");
  std::vector<std::vector<Point>> parts;
  const auto add = [&](const OGRGeometry& part) {
    const OGRwkbGeometryType type = wkbFlatten(part.getGeometryType());
    if (type != wkbPolygon && type != wkbTriangle) reader.fail("it is not a polygon; only triangles can be read");
    if (part.IsEmpty()) reader.fail("a part of it is empty; only triangles can be read");
    const OGRPolygon& polygon = *part.toPolygon();
    const OGRLinearRing& ring = *polygon.getExteriorRing();
    const int points = ring.getNumPoints();
    if (polygon.getNumInteriorRings() != 0 || points < 4 || placeOf(ring, 0) != placeOf(ring, points - 1))
      reader.fail("a polygon of " + std::to_string(points - 1) + forCount(points - 1, " corner", " corners") +
                  "; only triangles can be read");
    std::vector<Point>& made = parts.emplace_back();
    for (int i = 0; i + 1 < points; ++i) made.push_back(placeOf(ring, i));
    for (const Point& p : made)
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) reader.fail("a coordinate is not finite");
  };
  if (wkbFlatten(geometry->getGeometryType()) == wkbMultiPolygon)
    for (const OGRPolygon* const part : *geometry->toMultiPolygon()) add(*part);
  else
    add(*geometry);
  return parts;
}

// The distinct points of all parts, ascending.
std::vector<Point> pointsOf(const std::vector<std::vector<Point>>& parts) {
  std::vector<Point> points;
  for (const auto& part : parts) points.insert(points.end(), part.begin(), part.end());
  std::ranges::sort(points, lexLess);
  const auto repeated = std::ranges::unique(points);
  points.erase(repeated.begin(), repeated.end());
  return points;
}

// The order that sorts the `ids` of a layer; equal ids keep the file's order.
std::vector<std::uint32_t> orderOf(const std::vector<std::int64_t>& ids) {
  std::vector<std::uint32_t> order(ids.size());
  std::iota(order.begin(), order.end(), 0u);
  if (std::ranges::is_sorted(ids)) return order;
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return ids[i]; });
  return order;
}

// The columns of attributes that are known, with the number of each.
std::vector<int> addFieldsOf(OGRLayer& layer, Grid& grid) {
  std::vector<int> columns;
  const OGRFeatureDefn& table = *layer.GetLayerDefn();
  for (int i = 0; i < table.GetFieldCount(); ++i) {
    const OGRFieldDefn& column = *table.GetFieldDefn(i);
    const FieldName* const known = findFieldName(column.GetNameRef());
    if (known == nullptr || column.GetType() != OFTReal || findField(grid, std::string(known->name)) != nullptr)
      continue;
    grid.node_fields.push_back({std::string(known->name), std::string(known->unit)});
    columns.push_back(i);
  }
  return columns;
}

// Returns the ids of the nodes, ascending; empty if there is no layer of nodes with ids.
std::vector<std::int64_t> readNodeLayer(const Companion& companion, const OgrErrors& errors, Grid& grid,
                                        NodesByPlace& index) {
  std::vector<std::int64_t> ids;
  if (companion.layer == nullptr) return ids;
  LayerReader reader(*companion.layer, companion.path, errors);
  const int id_field = reader.field("id"), z_field = reader.field("z"), size_field = reader.field("size");
  if (id_field < 0) return ids;
  const std::vector<int> columns = addFieldsOf(*companion.layer, grid);
  LayerDepths depths;
  bool has_z = false;
  while (const OGRFeature* feature = reader.next()) {
    const OGRGeometry* geometry = feature->GetGeometryRef();
    if (geometry == nullptr || wkbFlatten(geometry->getGeometryType()) != wkbPoint || geometry->IsEmpty())
      reader.fail("it is not a point");
    const OGRPoint& point = *geometry->toPoint();
    ids.push_back(feature->GetFieldAsInteger64(id_field));
    grid.nodes.push_back({point.getX(), point.getY()});
    for (std::size_t k = 0; k < columns.size(); ++k)
      grid.node_fields[k].values.push_back(
          feature->IsFieldSetAndNotNull(columns[k]) ? feature->GetFieldAsDouble(columns[k]) : kUnknown);
    if (size_field >= 0) grid.size_m.push_back(feature->GetFieldAsDouble(size_field));
    const bool in_field = z_field >= 0 && feature->IsFieldSetAndNotNull(z_field);
    has_z = has_z || in_field || point.Is3D();
    depths.column.push_back(in_field ? feature->GetFieldAsDouble(z_field) : kUnknown);
    depths.points.push_back(point.Is3D() ? point.getZ() : kUnknown);
  }
  if (has_z) grid.z = depthsIn(depths, ids, grid.notes);
  const std::vector<std::uint32_t> order = orderOf(ids);
  orderNodes(grid, order);
  for (std::uint32_t i = 0; i < grid.nodes.size(); ++i) index.add(grid.nodes[i], i);
  reorder(ids, order);
  return ids;
}

// The text of a field; empty if there is none.
std::string textOf(const OGRFeature& feature, int field) {
  return field >= 0 && feature.IsFieldSetAndNotNull(field) ? feature.GetFieldAsString(field) : "";
}

// Equal features of several triangles become one.
class FeatureTable {
 public:
  FeatureTable(const LayerReader& reader)
      : fid_(reader.field("src_fid")),
        source_(reader.field("source")),
        name_(reader.field("name")),
        region_(reader.field("region")) {}

  bool exists() const { return fid_ >= 0; }

  std::uint32_t indexOf(const OGRFeature& feature, std::vector<GridFeature>& features) {
    auto key = std::make_tuple(static_cast<std::int64_t>(feature.GetFieldAsInteger64(fid_)), textOf(feature, source_),
                               textOf(feature, name_), textOf(feature, region_));
    const auto [at, added] = index_.emplace(std::move(key), static_cast<std::uint32_t>(features.size()));
    if (added) {
      const auto& [fid, source, name, region] = at->first;
      GridFeature& made = features.emplace_back(GridFeature{fid, source, {}, region});
      if (!name.empty()) made.attributes.emplace_back("name", name);
    }
    return at->second;
  }

 private:
  int fid_, source_, name_, region_;
  std::map<std::tuple<std::int64_t, std::string, std::string, std::string>, std::uint32_t> index_;
};

struct LayerTriangle {
  std::array<Point, 3> corners;
  std::array<double, 3> z{};   // of the corners; NaN if the file has none
  bool has_corners = false;    // one part with three points; a triangle that is cut (`MapCutter`) may have others
  std::vector<Point> outline;  // the distinct points of all parts
  std::optional<std::array<std::int64_t, 3>> node_ids;  // counter-clockwise
  std::int64_t feature = 0;
};

// The third coordinates of a triangle's corners; NaN if it has none.
std::array<double, 3> cornerHeights(const OGRFeature& feature) {
  std::array<double, 3> z{kUnknown, kUnknown, kUnknown};
  const OGRGeometry* geometry = feature.GetGeometryRef();
  if (!geometry->Is3D()) return z;
  if (wkbFlatten(geometry->getGeometryType()) == wkbMultiPolygon)
    geometry = geometry->toMultiPolygon()->getGeometryRef(0);
  const OGRLinearRing& ring = *geometry->toPolygon()->getExteriorRing();
  for (int i = 0; i < 3; ++i) z[static_cast<std::size_t>(i)] = ring.getZ(i);
  return z;
}

// The z of each node: that of all corners there, unknown if they differ. Empty if none differs from 0, which programs
// write if there are no heights. REQUIRES: corners are in the same order in `given` and in `grid.triangles`.
std::vector<double> heightsAt(const std::vector<LayerTriangle>& given, const Grid& grid) {
  std::vector<double> z(grid.nodes.size(), kUnknown);
  std::vector<bool> differs(z.size(), false);
  bool any = false;
  for (std::size_t t = 0; t < given.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t node = grid.triangles[t][i];
      const double here = given[t].z[i];
      if (std::isnan(here)) continue;
      any = any || here != 0.0;
      differs[node] = differs[node] || (!std::isnan(z[node]) && z[node] != here);
      z[node] = here;
    }
  }
  for (std::size_t node = 0; node < z.size(); ++node)
    if (differs[node]) z[node] = kUnknown;
  return any ? z : std::vector<double>();
}

// The nodes that a triangle names, if they are at its corners: the layers may have been edited. Else nullopt.
std::optional<std::array<std::uint32_t, 3>> nodesNamed(const LayerTriangle& triangle, std::span<const Point> nodes,
                                                       const std::vector<std::int64_t>& ids, const MapCutter& cutter) {
  if (!triangle.node_ids) return std::nullopt;
  std::array<std::uint32_t, 3> named;
  for (unsigned i = 0; i < 3; ++i) {
    const auto [at, end] = std::ranges::equal_range(ids, (*triangle.node_ids)[i]);
    if (end - at != 1) return std::nullopt;
    named[i] = static_cast<std::uint32_t>(at - ids.begin());
  }
  if (cutter.cuts(named))
    return pointsOf(cutter.partsOf(named)) == triangle.outline ? std::optional(named) : std::nullopt;
  if (!triangle.has_corners) return std::nullopt;
  const auto placesFrom = [&](unsigned first, unsigned step) {
    return std::array{nodes[named[first]], nodes[named[(first + step) % 3]], nodes[named[(first + 2 * step) % 3]]};
  };
  for (unsigned first = 0; first < 3; ++first)
    if (placesFrom(first, 1) == triangle.corners || placesFrom(first, 2) == triangle.corners) return named;
  return std::nullopt;
}

void makeTriangles(const std::vector<LayerTriangle>& given, const std::vector<std::int64_t>& ids, Grid& grid,
                   NodesByPlace& index, const std::string& path) {
  std::vector<bool> wound;
  const MapCutter cutter(grid);
  for (const LayerTriangle& from : given) {
    const auto named = nodesNamed(from, grid.nodes, ids, cutter);
    wound.push_back(named.has_value());
    if (named) {
      grid.triangles.push_back(*named);
      continue;
    }
    if (!from.has_corners)
      throw InputError("'" + path + "', feature " + std::to_string(from.feature) + ": its outline has " +
                       std::to_string(from.outline.size()) +
                       " points, and is not that of the triangle between the nodes that it names, cut where the map "
                       "ends or not" +
                       (ids.empty() ? "; the layer of nodes has to be there" : "; only whole triangles can be read"));
    auto& triangle = grid.triangles.emplace_back();
    for (unsigned i = 0; i < 3; ++i) {
      triangle[i] = index.firstAt(from.corners[i]);
      if (triangle[i] != kNone) continue;
      triangle[i] = addNode(grid, from.corners[i]);
      index.add(from.corners[i], triangle[i]);
    }
  }
  // If there is a layer of nodes, only it defines depths.
  if (ids.empty()) grid.z = heightsAt(given, grid);
  windTriangles(grid.nodes, grid.crs, wound, grid.triangles);
  if (!ids.empty()) measureNewCorners(grid, ids);
}

// `Grid::quad_of` for the numbers of a column; empty if none is a quadrilateral's.
std::vector<std::uint32_t> numberedQuads(const std::vector<std::int64_t>& column) {
  std::vector<std::uint32_t> quads;
  if (std::ranges::all_of(column, [](std::int64_t number) { return number <= 0; })) return quads;
  std::map<std::int64_t, std::uint32_t> number_of;
  for (const std::int64_t number : column)
    quads.push_back(
        number <= 0 ? kNone : number_of.emplace(number, static_cast<std::uint32_t>(number_of.size())).first->second);
  return quads;
}

void readTriangles(LayerReader& reader, const std::string& path, const std::vector<std::int64_t>& node_ids, Grid& grid,
                   NodesByPlace& index) {
  const int id_field = reader.field("id"), angle_field = reader.field("min_angle"),
            area_field = reader.field("area_m2");
  std::array<int, 3> node_fields;
  for (std::size_t i = 0; i < 3; ++i) node_fields[i] = reader.field(kCornerColumns[i]);
  const int quad_field = reader.field(kQuadColumn);
  FeatureTable features(reader);
  std::vector<std::int64_t> ids;
  std::vector<LayerTriangle> triangles;
  std::vector<std::int64_t> quads;  // 0: a triangle
  while (const OGRFeature* feature = reader.next()) {
    LayerTriangle& triangle = triangles.emplace_back();
    triangle.feature = feature->GetFID();
    const auto says = [&](int field) { return field >= 0 && feature->IsFieldSetAndNotNull(field); };
    const auto parts = partsOf(*feature, reader);
    triangle.has_corners = parts.size() == 1 && parts[0].size() == 3;
    if (triangle.has_corners) {
      std::ranges::copy(parts[0], triangle.corners.begin());
      triangle.z = cornerHeights(*feature);
    }
    triangle.outline = pointsOf(parts);
    const bool is_named = std::ranges::all_of(node_fields, says);
    if (!triangle.has_corners && !is_named)
      reader.fail(
          (parts.size() > 1 ? "it has several parts" : "a polygon of " + std::to_string(parts[0].size()) + " corners") +
          "; only triangles can be read");
    if (is_named) {
      triangle.node_ids.emplace();
      for (std::size_t i = 0; i < 3; ++i) (*triangle.node_ids)[i] = feature->GetFieldAsInteger64(node_fields[i]);
    }
    if (id_field >= 0) ids.push_back(feature->GetFieldAsInteger64(id_field));
    if (quad_field >= 0) quads.push_back(says(quad_field) ? feature->GetFieldAsInteger64(quad_field) : 0);
    if (angle_field >= 0) grid.min_angle_deg.push_back(feature->GetFieldAsDouble(angle_field));
    if (area_field >= 0) grid.area_m2.push_back(feature->GetFieldAsDouble(area_field));
    if (features.exists()) grid.feature_of.push_back(features.indexOf(*feature, grid.features));
  }
  grid.quad_of = numberedQuads(quads);
  if (!ids.empty()) {
    const std::vector<std::uint32_t> order = orderOf(ids);
    reorder(triangles, order);
    orderTriangles(grid, order);
    sortFeatures(grid);
  }
  makeTriangles(triangles, node_ids, grid, index, path);
}

// True if two places on a map of longitudes and latitudes are the same on the ground: a full turn apart, or at a pole.
bool sameOnGround(const Point& a, const Point& b) {
  return a.y == b.y && (a.x == b.x || std::max(a.x, b.x) - 360.0 == std::min(a.x, b.x) || std::abs(a.y) == 90.0);
}

// The parts of a line of a layer; one that was cut where the map ends (`MapCutter`) has several.
std::vector<std::vector<Point>> linePartsOf(const OGRFeature& feature, const LayerReader& reader) {
  const OGRGeometry* geometry = feature.GetGeometryRef();
  if (geometry == nullptr || geometry->IsEmpty()) reader.fail("it is not a line");
  std::vector<std::vector<Point>> parts;
  const auto add = [&](const OGRLineString& line) {
    std::vector<Point>& places = parts.emplace_back();
    for (int i = 0; i < line.getNumPoints(); ++i) places.push_back(placeOf(line, i));
    if (places.empty()) reader.fail("a part of it is empty");
  };
  const OGRwkbGeometryType type = wkbFlatten(geometry->getGeometryType());
  if (type == wkbLineString)
    add(*geometry->toLineString());
  else if (type == wkbMultiLineString)
    for (const OGRLineString* const part : *geometry->toMultiLineString()) add(*part);
  else
    reader.fail("it is not a line");
  return parts;
}

// Finds the nodes along lines of layers.
class LineReader {
 public:
  // REQUIRES: both outlive it.
  LineReader(const Grid& grid, const NodesByPlace& index, LineNodes::Along along)
      : grid_(grid), index_(index), nodes_(grid, along) {
    if (!grid.crs.geographic) return;
    for (std::uint32_t node = 0; node < grid.nodes.size(); ++node)
      if (std::abs(grid.nodes[node].y) == 90.0) poles_.push_back(node);
  }

  std::vector<std::uint32_t> nodesAlong(const OGRFeature& feature, const LayerReader& reader) {
    const std::vector<std::vector<Point>> parts = linePartsOf(feature, reader);
    std::vector<std::vector<std::uint32_t>> choices;
    std::size_t point = 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const bool continues = k > 0, continued = k + 1 < parts.size();
      if (continues && !(grid_.crs.geographic && sameOnGround(parts[k - 1].back(), parts[k].front())))
        reader.fail("its part " + std::to_string(k + 1) + " does not begin where the one before it ends");
      for (std::size_t i = 0; i < parts[k].size(); ++i) {
        ++point;
        if (continues && i == 0) continue;
        std::vector<std::uint32_t> here = nodesAt(parts[k][i]);
        if (here.empty() && continued && i + 1 == parts[k].size()) continue;  // cut between two nodes
        if (here.empty()) reader.fail("point " + std::to_string(point) + " of the line is not a corner of a triangle");
        choices.push_back(std::move(here));
      }
    }
    const Point &first = parts.front().front(), &last = parts.back().back();
    return nodes_.of(std::move(choices), first == last || (grid_.crs.geographic && sameOnGround(first, last)));
  }

 private:
  // Nodes with exactly these coordinates come first, then those a full turn away or at the same pole.
  std::vector<std::uint32_t> nodesAt(const Point& place) const {
    std::vector<std::uint32_t> nodes = index_.allAt(place);
    const auto add = [&](std::uint32_t node) {
      if (std::ranges::find(nodes, node) == nodes.end()) nodes.push_back(node);
    };
    if (!grid_.crs.geographic) return nodes;
    for (const double turn : {-360.0, 360.0})
      for (const std::uint32_t node : index_.allAt({place.x + turn, place.y})) add(node);
    for (const std::uint32_t node : poles_)
      if (grid_.nodes[node].y == place.y) add(node);
    return nodes;
  }

  const Grid& grid_;
  const NodesByPlace& index_;
  LineNodes nodes_;
  std::vector<std::uint32_t> poles_;  // nodes at the poles, whose longitudes are arbitrary
};

void readBoundaries(const Companion& companion, const OgrErrors& errors, const NodesByPlace& index, Grid& grid) {
  if (companion.layer == nullptr) return;
  LayerReader reader(*companion.layer, companion.path, errors);
  const int id_field = reader.field("id"), role_field = reader.field("role"), type_field = reader.field("ibtype");
  if (id_field < 0 || role_field < 0) return;
  const int name_field = reader.field("name");
  LineReader lines(grid, index, LineNodes::Along::Boundary);
  std::vector<std::int64_t> ids;
  while (const OGRFeature* feature = reader.next()) {
    Boundary boundary;
    const std::string role = feature->GetFieldAsString(role_field);
    std::optional<BoundaryRole> known;
    for (const BoundaryRole candidate : kBoundaryRoles)
      if (role == toString(candidate)) known = candidate;
    if (!known) reader.fail("its role is \"" + role + "\", not land, island, open or river");
    boundary.role = *known;
    if (type_field >= 0 && feature->IsFieldSetAndNotNull(type_field))
      boundary.ibtype = feature->GetFieldAsInteger(type_field);
    boundary.name = textOf(*feature, name_field);
    boundary.nodes = lines.nodesAlong(*feature, reader);
    boundary.closed = boundary.nodes.size() > 1 && boundary.nodes.front() == boundary.nodes.back();
    if (boundary.closed) boundary.nodes.pop_back();
    ids.push_back(feature->GetFieldAsInteger64(id_field));
    grid.boundaries.push_back(std::move(boundary));
  }
  reorder(grid.boundaries, orderOf(ids));
  noteStrayBoundaries(grid);
}

void readLines(const Companion& companion, const OgrErrors& errors, const NodesByPlace& index, Grid& grid) {
  if (companion.layer == nullptr) return;
  LayerReader reader(*companion.layer, companion.path, errors);
  const int id_field = reader.field("id"), kind_field = reader.field("kind"), name_field = reader.field("name");
  if (id_field < 0 || kind_field < 0) return;
  LineReader lines(grid, index, LineNodes::Along::Inside);
  std::vector<std::int64_t> ids;
  while (const OGRFeature* feature = reader.next()) {
    const std::string kind = textOf(*feature, kind_field);
    const std::optional<LineKind> known = lineKindNamed(kind);
    if (!known) reader.fail("its kind is \"" + kind + "\", not constraint, weir or region border");
    ids.push_back(feature->GetFieldAsInteger64(id_field));
    grid.lines.push_back(lineOfNodes(*known, textOf(*feature, name_field), lines.nodesAlong(*feature, reader)));
  }
  reorder(grid.lines, orderOf(ids));
}

// True if a GeoJSON file has "crs": null, which OGR reads as WGS 84.
bool saysNullCrs(const std::string& path) {
  constexpr std::streamsize kHead = 4096;
  std::ifstream file(path, std::ios::binary);
  std::string head(kHead, '\0');
  file.read(head.data(), kHead);
  head.resize(static_cast<std::size_t>(file.gcount()));
  static const std::regex pattern(R"("crs"\s*:\s*null)");
  return std::regex_search(head.substr(0, head.find("\"features\"")), pattern);
}

Crs readCrs(GDALDataset& dataset, OGRLayer& layer, const std::string& path) {
  const std::string_view driver = dataset.GetDriverName();
  if (driver == "GeoJSON" && saysNullCrs(path)) return {};
  return fromOgr(layer.GetSpatialRef(), "'" + path + "'");
}

}  // namespace

Grid readOgrGrid(const std::string& path, const Crs& unsaid) {
  const OgrErrors errors;
  const DatasetPtr dataset = open(path, errors);
  OGRLayer& layer = triangleLayer(*dataset, path);
  Grid grid;
  NodesByPlace index;
  grid.crs = readCrs(*dataset, layer, path);
  if (grid.crs.isPlane()) grid.crs = unsaid;
  const std::vector<std::int64_t> node_ids =
      readNodeLayer(findCompanion(*dataset, path, kNodeLayer, errors), errors, grid, index);
  LayerReader reader(layer, path, errors);
  readTriangles(reader, path, node_ids, grid, index);
  readBoundaries(findCompanion(*dataset, path, kBoundaryLayer, errors), errors, index, grid);
  readLines(findCompanion(*dataset, path, kLineLayer, errors), errors, index, grid);
  return grid;
}

}  // namespace coastmesh
