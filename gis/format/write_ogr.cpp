#include "gis/format/write_ogr.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

#include "gis/error.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/format/ogr_layer.hpp"
#include "gis/format/read_ogr_grid.hpp"

namespace coastmesh {
namespace {

// A constant date in the files, so that the same input makes the same bytes.
constexpr const char* kTableDate = "2000-01-01";

constexpr std::size_t kLongestTableText = 254;  // bytes, in a .dbf

bool createField(OGRLayer& target, const LayerColumn& column, const OgrWriter& writer) {
  OGRFieldDefn field(column.name.c_str(), OFTString);
  if (std::holds_alternative<LayerColumn::Flag>(column.value)) {
    field.SetType(OFTInteger);
    if (!writer.table_types) field.SetSubType(OFSTBoolean);
  } else if (std::holds_alternative<LayerColumn::Whole>(column.value)) {
    field.SetType(OFTInteger64);
  } else if (std::holds_alternative<LayerColumn::Real>(column.value)) {
    field.SetType(OFTReal);
  } else if (writer.table_types) {
    field.SetWidth(static_cast<int>(std::min(column.longest, kLongestTableText)));
  }
  return target.CreateField(&field) == OGRERR_NONE;
}

void setField(OGRFeature& feature, int index, const LayerColumn& column, std::size_t row, std::string& scratch) {
  if (const auto* flag = std::get_if<LayerColumn::Flag>(&column.value)) {
    feature.SetField(index, (*flag)(row) ? 1 : 0);
  } else if (const auto* whole = std::get_if<LayerColumn::Whole>(&column.value)) {
    if (whole->isNull(row))
      feature.SetFieldNull(index);
    else
      feature.SetField(index, static_cast<GIntBig>((*whole)(row)));
  } else if (const auto* real = std::get_if<LayerColumn::Real>(&column.value)) {
    const double value = (*real)(row);
    if (std::isnan(value))
      feature.SetFieldNull(index);
    else
      feature.SetField(index, value);
  } else {
    scratch = std::get<LayerColumn::Text>(column.value)(row);
    if (scratch.empty())
      feature.SetFieldNull(index);
    else
      feature.SetField(index, scratch.c_str());
  }
}

bool cutsLines(const MapCutter& cutter, const GridLayer& layer) {
  std::vector<std::uint32_t> nodes;
  for (std::size_t row = 0; row < layer.rows; ++row) {
    layer.shapeOf(row, nodes);
    if (cutter.cutsLine(nodes)) return true;
  }
  return false;
}

// One geometry for all rows of a layer, so that a row costs no allocation.
class ShapeCursor {
 public:
  ShapeCursor(const Grid& grid, const GridLayer& layer) : grid_(grid), layer_(layer), map_(grid, layer) {
    switch (layer.shape) {
      case GridLayer::Shape::Point:
        geometry_ = std::make_unique<OGRPoint>();
        break;
      case GridLayer::Shape::Line:
        geometry_ = std::make_unique<OGRLineString>();
        break;
      case GridLayer::Shape::Polygon: {
        auto polygon = std::make_unique<OGRPolygon>();
        polygon->addRingDirectly(new OGRLinearRing());
        geometry_ = std::move(polygon);
        break;
      }
    }
  }

  static OGRwkbGeometryType typeOf(const Grid& grid, const GridLayer& layer) {
    switch (layer.shape) {
      case GridLayer::Shape::Point:
        return grid.z.empty() ? wkbPoint : wkbPoint25D;
      case GridLayer::Shape::Line:
        return MapOfLayer(grid, layer).has_parts ? wkbMultiLineString : wkbLineString;
      case GridLayer::Shape::Polygon:
        break;
    }
    return MapOfLayer(grid, layer).has_parts ? wkbMultiPolygon : wkbPolygon;
  }

  const OGRGeometry& at(std::size_t row) {
    layer_.shapeOf(row, nodes_);
    if (layer_.shape == GridLayer::Shape::Point) {
      auto& point = static_cast<OGRPoint&>(*geometry_);
      point.setX(grid_.nodes[nodes_[0]].x);
      point.setY(grid_.nodes[nodes_[0]].y);
      if (!grid_.z.empty()) point.setZ(grid_.z[nodes_[0]]);
      return point;
    }
    if (map_.has_parts && layer_.shape == GridLayer::Shape::Line) return partsOfLine();
    if (map_.has_parts) return partsOf({nodes_[0], nodes_[1], nodes_[2]});
    auto& chain = layer_.shape == GridLayer::Shape::Line
                      ? static_cast<OGRSimpleCurve&>(static_cast<OGRLineString&>(*geometry_))
                      : static_cast<OGRSimpleCurve&>(*static_cast<OGRPolygon&>(*geometry_).getExteriorRing());
    chain.setNumPoints(static_cast<int>(nodes_.size()), false);
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      chain.setPoint(static_cast<int>(i), grid_.nodes[nodes_[i]].x, grid_.nodes[nodes_[i]].y);
    return *geometry_;
  }

 private:
  const OGRGeometry& partsOf(const std::array<std::uint32_t, 3>& corners) {
    auto parts = std::make_unique<OGRMultiPolygon>();
    for (const MapCutter::Ring& ring : map_.cutter.partsOf(corners)) {
      auto line = std::make_unique<OGRLinearRing>();
      for (const Point& p : ring) line->addPoint(p.x, p.y);
      line->addPoint(ring[0].x, ring[0].y);
      auto polygon = std::make_unique<OGRPolygon>();
      polygon->addRingDirectly(line.release());
      parts->addGeometryDirectly(polygon.release());
    }
    geometry_ = std::move(parts);
    return *geometry_;
  }

  const OGRGeometry& partsOfLine() {
    auto parts = std::make_unique<OGRMultiLineString>();
    for (const std::vector<Point>& part : map_.cutter.partsOfLine(nodes_)) {
      auto line = std::make_unique<OGRLineString>();
      for (const Point& p : part) line->addPoint(p.x, p.y);
      parts->addGeometryDirectly(line.release());
    }
    geometry_ = std::move(parts);
    return *geometry_;
  }

  const Grid& grid_;
  const GridLayer& layer_;
  MapOfLayer map_;
  std::unique_ptr<OGRGeometry> geometry_;
  std::vector<std::uint32_t> nodes_;
};

}  // namespace

MapOfLayer::MapOfLayer(const Grid& grid, const GridLayer& layer) : cutter(grid) {
  has_parts = layer.shape == GridLayer::Shape::Polygon
                  ? cutter.cutsAny()
                  : layer.shape == GridLayer::Shape::Line && cutsLines(cutter, layer);
}

void failToWrite(const std::string& path, const OgrErrors& errors) {
  throw OutputError("cannot write '" + path + "'" + (errors.text().empty() ? "" : ": " + errors.text()));
}

DatasetPtr createDataset(const OgrWriter& writer, const std::string& path, const OgrErrors& errors) {
  registerDrivers();
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName(writer.driver);
  if (driver == nullptr) throw OutputError("cannot write '" + path + "': this GDAL has no driver " + writer.driver);
  DatasetPtr dataset(driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!dataset) failToWrite(path, errors);
  return dataset;
}

void closeDataset(DatasetPtr dataset, const std::string& path, const OgrErrors& errors) {
  dataset->FlushCache(true);
  dataset.reset();
  if (errors.failed()) failToWrite(path, errors);
}

// The CRS in a form that drivers keep unchanged. Without a code, those of GeoPackage and FlatGeobuf look up the code of
// a UTM zone by the projection alone, whatever the unit and datum shift, unless the CRS was read from WKT 1.
OGRSpatialReference srsForLayer(const Crs& crs) {
  OGRSpatialReference srs = toOgr(crs);
  OGRSpatialReference guess = srs, known, older;
  if (!crs.authority.empty() || guess.AutoIdentifyEPSG() != OGRERR_NONE) return srs;
  const char* const code = guess.GetAuthorityCode(nullptr);
  if (code == nullptr || known.importFromEPSG(std::atoi(code)) != OGRERR_NONE || known.IsSame(&srs)) return srs;
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT1_GDAL", nullptr};
  const bool exported = srs.exportToWkt(&text, options) == OGRERR_NONE;
  const bool imported = exported && older.importFromWkt(text) == OGRERR_NONE && older.IsSame(&srs);
  CPLFree(text);
  if (!imported) return srs;
  older.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return older;
}

OGRLayer& createLayer(GDALDataset& dataset, const std::string& path, const std::string& name,
                      const OGRSpatialReference* srs, OGRwkbGeometryType type, const char* const* options) {
  const OgrWriteErrors errors(path);
  OGRLayer* const layer =
      dataset.CreateLayer(name.c_str(), const_cast<OGRSpatialReference*>(srs), type, const_cast<char**>(options));
  if (layer == nullptr || errors.failed()) failToWrite(path, errors);
  return *layer;
}

OGRLayer& createLayer(GDALDataset& dataset, const std::string& path, const OgrWriter& writer, const Grid& grid,
                      const GridLayer& layer, const std::string& name, const OgrErrors& errors) {
  std::optional<OGRSpatialReference> srs;
  if (!grid.crs.isPlane()) {
    srs = srsForLayer(grid.crs);
  } else if (writer.plane_wkt != nullptr) {
    srs.emplace(writer.plane_wkt);
  }
  std::vector<const char*> options = writer.layer_options;
  options.push_back(nullptr);
  OGRLayer& target =
      createLayer(dataset, path, name, srs ? &*srs : nullptr, ShapeCursor::typeOf(grid, layer), options.data());
  for (const LayerColumn& column : layer.columns)
    if (!createField(target, column, writer)) failToWrite(path, errors);
  return target;
}

void writeFeatures(OGRLayer& target, const std::string& path, const Grid& grid, const GridLayer& layer,
                   const OgrErrors& errors) {
  OGRFeature feature(target.GetLayerDefn());
  ShapeCursor shapes(grid, layer);
  std::string scratch;
  for (std::size_t row = 0; row < layer.rows; ++row) {
    feature.SetFID(OGRNullFID);
    for (std::size_t c = 0; c < layer.columns.size(); ++c)
      setField(feature, static_cast<int>(c), layer.columns[c], row, scratch);
    feature.SetGeometry(&shapes.at(row));
    if (target.CreateFeature(&feature) != OGRERR_NONE) failToWrite(path, errors);
  }
}

namespace {

[[noreturn]] void failIncomplete(const std::string& path) {
  const std::string why = whyNoRoom(path);
  throw OutputError("cannot write '" + path +
                    "': " + (why.empty() ? "the file came out incomplete; is the disk full?" : why));
}

// True if a .dbf has `rows` rows and its full length: GDAL does not report a failure to write its header or end mark.
bool isWholeTable(const std::string& path, std::size_t rows) {
  std::array<unsigned char, 12> head{};
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(head.data()), head.size())) return false;
  const auto number = [&head](std::size_t at, std::size_t bytes) {
    std::uintmax_t value = 0;
    for (std::size_t i = bytes; i-- > 0;) value = value << 8 | head[at + i];
    return value;
  };
  constexpr std::uintmax_t kLeastHeader = 33, kLeastRow = 1;
  const std::uintmax_t header = number(8, 2), row = number(10, 2);
  return number(4, 4) == rows && header >= kLeastHeader && row >= kLeastRow &&
         std::filesystem::file_size(path) >= header + rows * row + 1;
}

}  // namespace

void requireComplete(const std::string& path, std::size_t rows) {
  const OgrErrors errors;
  const DatasetPtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
  OGRLayer* const layer = dataset && dataset->GetLayerCount() == 1 ? dataset->GetLayer(0) : nullptr;
  std::size_t found = 0;
  if (layer != nullptr)
    while (OGRFeatureUniquePtr(layer->GetNextFeature())) ++found;
  if (found != rows || errors.failed()) failIncomplete(path);
}

namespace {

void writeLayerFiles(const OgrWriter& writer, const Grid& grid, const std::vector<GridLayer>& layers,
                     const std::string& path) {
  for (const GridLayer& layer : layers) {
    const std::string layer_path = pathOfLayer(path, layer.name);
    const OgrWriteErrors errors(layer_path);
    DatasetPtr dataset = createDataset(writer, layer_path, errors);
    const std::string name = std::filesystem::path(layer_path).stem().string();
    writeFeatures(createLayer(*dataset, layer_path, writer, grid, layer, name, errors), layer_path, grid, layer,
                  errors);
    closeDataset(std::move(dataset), layer_path, errors);
    if (writer.hides_failures) requireComplete(layer_path, layer.rows);
    if (writer.table_types && !isWholeTable(withEnding(layer_path, ".dbf"), layer.rows)) failIncomplete(layer_path);
  }
}

std::uint64_t tableBytes(const GridLayer& layer) {
  std::uint64_t bytes = 1;
  for (const LayerColumn& column : layer.columns)
    bytes += std::holds_alternative<LayerColumn::Text>(column.value) ? std::min(column.longest, kLongestTableText) : 24;
  return bytes;
}

}  // namespace

void writeShapefile(const Grid& grid, const std::string& path, const ItemLoop&) {
  requireZ(grid, path);
  requirePrjForm(path, grid.crs);  // GDAL would leave the .prj out
  const std::vector<GridLayer> layers = layersOf(grid);
  constexpr std::uint64_t kTriangleShape = 8 + 44 + 4 + 4 * 16;  // header, type, box and counts, part, four corners
  requireShapefileSize(path, layers[0].rows, kTriangleShape, tableBytes(layers[0]));
  const std::string date = std::string("DBF_DATE_LAST_UPDATE=") + kTableDate;
  writeLayerFiles({"ESRI Shapefile", {"ENCODING=UTF-8", "2GB_LIMIT=YES", date.c_str()}, true}, grid, layers, path);
}

void writeFlatGeobuf(const Grid& grid, const std::string& path, const ItemLoop&) {
  writeLayerFiles({"FlatGeobuf", {}, false, nullptr, true}, grid, layersOf(grid), path);
}

void requireShapefileSize(const std::string& path, std::uint64_t rows, std::uint64_t shape_bytes,
                          std::uint64_t table_bytes) {
  constexpr std::uint64_t kLimit = 2'147'483'647;
  constexpr std::uint64_t kHeader = 1000;  // at least the larger of the two files' headers
  if (rows * std::max(shape_bytes, table_bytes) + kHeader <= kLimit) return;
  throw OutputError("cannot write '" + path + "': " + std::to_string(rows) +
                    " triangles are more than the 2 GB of a shapefile hold; choose .gpkg or .fgb");
}

namespace {

OutputFiles shapefileFiles(const std::string& path) {
  OutputFiles files;
  for (const std::string& layer : layerFiles(path).targets) {
    for (const char* ending : {".shp", ".shx", ".dbf", ".cpg"}) files.targets.push_back(withEnding(layer, ending));
    for (const char* ending : {".prj", ".qix", ".qpj", ".sbn", ".sbx", ".fbn", ".fbx", ".ain", ".aih", ".atx", ".ixs",
                               ".mxs", ".idm", ".ind", ".cst", ".shp.xml"})
      files.stale.push_back(withEnding(layer, ending));
  }
  files.prj = prjBeside(path);
  return files;
}

}  // namespace

FormatRecord shapefileFormat() {
  return {{.name = "shp",
           .endings = {".shp"},
           .description = "Shapefile, three or four sets of files",
           .readable = true,
           .writable = true,
           .holds = kLayerParts,
           .needs_depths = true},
          {writeShapefile, readOgrGrid, shapefileFiles}};
}

FormatRecord flatGeobufFormat() {
  return {{.name = "fgb",
           .endings = {".fgb"},
           .description = "FlatGeobuf, three or four files",
           .readable = true,
           .writable = true,
           .holds = kLayerParts},
          {writeFlatGeobuf, readOgrGrid, layerFiles}};
}

}  // namespace coastmesh
