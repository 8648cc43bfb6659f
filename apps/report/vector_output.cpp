#include "apps/report/vector_output.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/format/ogr_layer.hpp"

namespace coastmesh {

namespace {

constexpr int kShapesPerTransaction = 100'000;

struct VectorFormat {
  const char* ending;
  const char* driver;
  bool several_layers;
  bool hides_failures;  // OGR does not report when the disk is full
};

constexpr VectorFormat kFormats[] = {
    {".gpkg", "GPKG", true, false}, {".geojson", "GeoJSON", false, true}, {".fgb", "FlatGeobuf", false, true}};

const VectorFormat& formatOf(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  for (const VectorFormat& format : kFormats) {
    if (ending == format.ending) return format;
  }
  throw OutputError("cannot write '" + path + "': give it one of the endings .gpkg, .geojson, .fgb");
}

OGRFieldType fieldType(const VectorValue& value) {
  if (std::holds_alternative<std::int64_t>(value)) return OFTInteger64;
  return std::holds_alternative<double>(value) ? OFTReal : OFTString;
}

void setField(OGRFeature& feature, int index, const VectorValue& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    feature.SetField(index, static_cast<GIntBig>(*integer));
  } else if (const auto* real = std::get_if<double>(&value)) {
    feature.SetField(index, *real);
  } else {
    feature.SetField(index, std::get<std::string>(value).c_str());
  }
}

template <typename Curve>
void setPoints(Curve& curve, const std::vector<Point>& points) {
  curve.setNumPoints(static_cast<int>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) curve.setPoint(static_cast<int>(i), points[i].x, points[i].y);
}

void addRing(OGRPolygon& polygon, const std::vector<Point>& points) {
  OGRLinearRing ring;
  setPoints(ring, points);
  ring.closeRings();
  polygon.addRing(&ring);
}

std::unique_ptr<OGRGeometry> geometryOf(const VectorShape& shape, VectorLayer::Kind kind) {
  switch (kind) {
    case VectorLayer::Kind::Points:
      return std::make_unique<OGRPoint>(shape.points[0].x, shape.points[0].y);
    case VectorLayer::Kind::Lines: {
      auto line = std::make_unique<OGRLineString>();
      setPoints(*line, shape.points);
      return line;
    }
    case VectorLayer::Kind::Polygons: {
      auto polygon = std::make_unique<OGRPolygon>();
      addRing(*polygon, shape.points);
      for (const std::vector<Point>& hole : shape.holes) addRing(*polygon, hole);
      return polygon;
    }
    case VectorLayer::Kind::Table:
      break;
  }
  return nullptr;
}

OGRwkbGeometryType typeOf(VectorLayer::Kind kind) {
  switch (kind) {
    case VectorLayer::Kind::Points:
      return wkbPoint;
    case VectorLayer::Kind::Lines:
      return wkbLineString;
    case VectorLayer::Kind::Polygons:
      return wkbPolygon;
    case VectorLayer::Kind::Table:
      break;
  }
  return wkbNone;
}

void writeLayer(GDALDataset& dataset, const std::string& path, const VectorLayer& layer, const OGRSpatialReference* srs,
                const OgrErrors& errors) {
  const OGRwkbGeometryType type = typeOf(layer.kind);
  constexpr const char* kNoOptions[] = {nullptr};
  OGRLayer& target = createLayer(dataset, path, layer.name, type == wkbNone ? nullptr : srs, type, kNoOptions);
  for (const auto& [name, sample] : layer.fields) {
    OGRFieldDefn field(name.c_str(), fieldType(sample));
    if (target.CreateField(&field) != OGRERR_NONE) failToWrite(path, errors);
  }
  const bool transactions = dataset.TestCapability(ODsCTransactions) != 0;
  int pending = 0;
  for (const VectorShape& shape : layer.shapes) {
    if (transactions && pending == 0 && dataset.StartTransaction() != OGRERR_NONE) failToWrite(path, errors);
    OGRFeature feature(target.GetLayerDefn());
    for (std::size_t i = 0; i < shape.values.size(); ++i) setField(feature, static_cast<int>(i), shape.values[i]);
    if (auto geometry = geometryOf(shape, layer.kind)) feature.SetGeometryDirectly(geometry.release());
    if (target.CreateFeature(&feature) != OGRERR_NONE) failToWrite(path, errors);
    if (++pending == kShapesPerTransaction) {
      if (transactions && dataset.CommitTransaction() != OGRERR_NONE) failToWrite(path, errors);
      pending = 0;
    }
  }
  if (transactions && pending > 0 && dataset.CommitTransaction() != OGRERR_NONE) failToWrite(path, errors);
}

}  // namespace

void requireVectorFormat(const std::string& path, std::size_t layers) {
  const VectorFormat& format = formatOf(path);
  if (layers > 1 && !format.several_layers) {
    throw OutputError("cannot write '" + path + "': only .gpkg holds several layers");
  }
}

void writeVectorLayers(const std::string& path, const Crs& crs, const std::vector<VectorLayer>& layers) {
  requireVectorFormat(path, layers.size());
  const VectorFormat& format = formatOf(path);
  const OgrWriteErrors errors(path);
  // A GeoPackage records when it was written; the same input must give the same bytes.
  const OgrOption date("OGR_CURRENT_DATE", "2000-01-01T00:00:00.000Z");
  registerDrivers();

  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(format.driver);
  if (driver == nullptr) {
    throw OutputError("cannot write '" + path + "': this GDAL has no driver " + format.driver);
  }
  DatasetPtr dataset(driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!dataset) failToWrite(path, errors);
  std::optional<OGRSpatialReference> srs;
  if (!crs.isPlane()) srs = toOgr(crs);
  for (const VectorLayer& layer : layers) writeLayer(*dataset, path, layer, srs ? &*srs : nullptr, errors);

  closeDataset(std::move(dataset), path, errors);
  if (format.hides_failures && !layers.empty()) requireComplete(path, layers[0].shapes.size());
}

}  // namespace coastmesh
