#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "gis/error.hpp"
#include "gis/file/gpkg_index.hpp"
#include "gis/file/sqlite_pages.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/format/ogr_layer.hpp"
#include "gis/format/read_ogr_grid.hpp"
#include "gis/format/write_ogr.hpp"

namespace coastmesh {
namespace {

static_assert(std::endian::native == std::endian::little, "geometries say that they are so");

// A constant date in the file, so that the same input makes the same bytes.
constexpr const char* kDate = "2000-01-01T00:00:00.000Z";

// Writes little-endian values one after another.
class ByteCursor {
 public:
  explicit ByteCursor(std::span<std::byte> to) : at_(to.data()) {}

  template <typename T>
  void put(T value) {
    std::memcpy(at_, &value, sizeof value);
    at_ += sizeof value;
  }
  void put(const Point& p) { put(p.x), put(p.y); }

 private:
  std::byte* at_;
};

IndexBox boxOf(std::span<const Point> places) {
  IndexBox box{places[0], places[0]};
  for (const Point& p : places) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

// Writes a geometry's header: "GP", version 0, flags, the CRS, and the box if there is one.
constexpr std::size_t kHeaderBytes = 8, kBoxBytes = 32;
void putHeader(ByteCursor& bytes, std::int32_t srs_id, const std::optional<IndexBox>& box) {
  constexpr std::uint8_t kLittleEndian = 1, kWithBox = 2;
  for (const char c : {'G', 'P', '\0'}) bytes.put(c);
  bytes.put(static_cast<std::uint8_t>(box ? kLittleEndian | kWithBox : kLittleEndian));
  bytes.put(srs_id);
  if (!box) return;
  for (const double side : {box->low.x, box->high.x, box->low.y, box->high.y}) bytes.put(side);
}

// The rows of a layer of triangles or of nodes, in the form in which OGR would have SQLite write them.
class LayerRows {
 public:
  // REQUIRES: both outlive it.
  LayerRows(const Grid& grid, const GridLayer& layer) : grid_(grid), layer_(layer), map_(grid, layer) {}

  void make(std::size_t row, std::int32_t srs_id, SqliteRow& to) const {
    to.null();  // the fid
    if (layer_.shape == GridLayer::Shape::Point)
      putPoint(row, srs_id, to);
    else if (map_.has_parts)
      putParts(map_.cutter.partsOf(grid_.triangles[row]), srs_id, to);
    else
      putTriangle(row, srs_id, to);
    for (const LayerColumn& column : layer_.columns) putValue(column, row, to);
  }

  IndexBox box(std::size_t row) const {
    if (layer_.shape == GridLayer::Shape::Point) return {grid_.nodes[row], grid_.nodes[row]};
    const std::array<std::uint32_t, 3>& corners = grid_.triangles[row];
    if (map_.has_parts && map_.cutter.cuts(corners)) return boxOfParts(map_.cutter.partsOf(corners));
    const auto& [a, b, c] = cornersOf(row);
    return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})},
            {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})}};
  }

  // True if all rows are within `kLargestSqliteRow`.
  bool areSmall() const {
    constexpr std::size_t kGeometry = 1500, kNumber = 10;  // bytes at most; cut at the end of longitudes and at a pole
    std::size_t bytes = kGeometry;
    for (const LayerColumn& column : layer_.columns) bytes += kNumber + column.longest;
    return bytes <= kLargestSqliteRow;
  }

 private:
  static constexpr std::uint8_t kLittleEndian = 1;
  static constexpr std::uint32_t kPoint = 1, kPointZ = 1001, kPolygon = 3, kMultiPolygon = 6;
  static constexpr std::size_t kShapeBytes = 1 + 4, kPlaceBytes = 16;

  std::array<Point, 3> cornersOf(std::size_t row) const {
    const auto& [a, b, c] = grid_.triangles[row];
    return {grid_.nodes[a], grid_.nodes[b], grid_.nodes[c]};
  }

  static IndexBox boxOfParts(const std::vector<MapCutter::Ring>& parts) {
    std::vector<Point> places;
    for (const MapCutter::Ring& ring : parts) places.insert(places.end(), ring.begin(), ring.end());
    return boxOf(places);
  }

  void putPoint(std::size_t row, std::int32_t srs_id, SqliteRow& to) const {
    const bool has_z = !grid_.z.empty();
    const std::span<std::byte> blob = to.blob(kHeaderBytes + kShapeBytes + kPlaceBytes + (has_z ? sizeof(double) : 0));
    if (blob.empty()) return;
    ByteCursor bytes(blob);
    putHeader(bytes, srs_id, std::nullopt);
    bytes.put(kLittleEndian);
    bytes.put(has_z ? kPointZ : kPoint);
    bytes.put(grid_.nodes[row]);
    if (has_z) bytes.put(grid_.z[row]);
  }

  static std::size_t polygonBytes(std::size_t corners) { return kShapeBytes + 4 + 4 + (corners + 1) * kPlaceBytes; }

  static void putPolygon(std::span<const Point> ring, ByteCursor& bytes) {
    bytes.put(kLittleEndian);
    bytes.put(kPolygon);
    bytes.put(std::uint32_t{1});  // its rings
    bytes.put(static_cast<std::uint32_t>(ring.size() + 1));
    for (const Point& p : ring) bytes.put(p);
    bytes.put(ring[0]);
  }

  // Omits the box, which would be a sixth of the row: the index has it, and it is as fast to read from four corners.
  void putTriangle(std::size_t row, std::int32_t srs_id, SqliteRow& to) const {
    const std::span<std::byte> blob = to.blob(kHeaderBytes + polygonBytes(3));
    if (blob.empty()) return;
    ByteCursor bytes(blob);
    putHeader(bytes, srs_id, std::nullopt);
    putPolygon(cornersOf(row), bytes);
  }

  static void putParts(const std::vector<MapCutter::Ring>& parts, std::int32_t srs_id, SqliteRow& to) {
    std::size_t size = kHeaderBytes + kBoxBytes + kShapeBytes + 4;
    for (const MapCutter::Ring& ring : parts) size += polygonBytes(ring.size());
    const std::span<std::byte> blob = to.blob(size);
    if (blob.empty()) return;
    ByteCursor bytes(blob);
    putHeader(bytes, srs_id, boxOfParts(parts));
    bytes.put(kLittleEndian);
    bytes.put(kMultiPolygon);
    bytes.put(static_cast<std::uint32_t>(parts.size()));
    for (const MapCutter::Ring& ring : parts) putPolygon(ring, bytes);
  }

  static void putValue(const LayerColumn& column, std::size_t row, SqliteRow& to) {
    if (const auto* flag = std::get_if<LayerColumn::Flag>(&column.value)) {
      to.whole((*flag)(row) ? 1 : 0);
    } else if (const auto* whole = std::get_if<LayerColumn::Whole>(&column.value)) {
      if (whole->isNull(row))
        to.null();
      else
        to.whole((*whole)(row));
    } else if (const auto* real = std::get_if<LayerColumn::Real>(&column.value)) {
      if (const double value = (*real)(row); std::isnan(value))
        to.null();
      else
        to.real(value);
    } else if (const std::string_view text = std::get<LayerColumn::Text>(column.value)(row); text.empty()) {
      to.null();
    } else {
      to.text(text);
    }
  }

  const Grid& grid_;
  const GridLayer& layer_;
  MapOfLayer map_;
};

// Runs SQL on a file. Throws OutputError if it fails.
class Sql {
 public:
  Sql(GDALDataset& dataset, const std::string& path, const OgrErrors& errors)
      : dataset_(dataset), path_(path), errors_(errors) {}

  void run(const std::string& sql) {
    CPLErrorReset();
    if (OGRLayer* const result = dataset_.ExecuteSQL(sql.c_str(), nullptr, nullptr)) dataset_.ReleaseResultSet(result);
    if (CPLGetLastErrorType() >= CE_Failure) failToWrite(path_, errors_);
  }

  // The first value of the first row.
  std::string ask(const std::string& sql) {
    OGRLayer* const result = dataset_.ExecuteSQL(sql.c_str(), nullptr, nullptr);
    if (result == nullptr) failToWrite(path_, errors_);
    const OGRFeatureUniquePtr row(result->GetNextFeature());
    std::string value = row && row->GetFieldCount() > 0 ? row->GetFieldAsString(0) : "";
    dataset_.ReleaseResultSet(result);
    if (value.empty()) failToWrite(path_, errors_);
    return value;
  }

  std::uint64_t askNumber(const std::string& sql) {
    const std::string text = ask(sql);
    std::uint64_t number = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), number).ec != std::errc()) failToWrite(path_, errors_);
    return number;
  }

  std::uint64_t rootOf(const std::string& table) {
    return askNumber("SELECT rootpage FROM sqlite_master WHERE type = 'table' AND name = '" + table + "'");
  }

 private:
  GDALDataset& dataset_;
  const std::string& path_;
  const OgrErrors& errors_;
};

std::string indexOf(const GridLayer& layer) { return "rtree_" + layer.name + "_geom"; }

// Creates the layer by OGR, with an empty spatial index; writes its features by OGR too if `with_features`.
void createLayerWithIndex(GDALDataset& dataset, const std::string& path, const OgrWriter& writer, const Grid& grid,
                          const GridLayer& layer, bool with_features, const OgrErrors& errors) {
  OGRLayer& target = createLayer(dataset, path, writer, grid, layer, layer.name, errors);
  Sql sql(dataset, path, errors);
  if (sql.ask("SELECT CreateSpatialIndex('" + layer.name + "', '" + target.GetGeometryColumn() + "')") != "1")
    failToWrite(path, errors);
  if (!with_features) return;
  // The index is made later as a whole, so features must not be inserted into it one by one.
  const std::string trigger = indexOf(layer) + "_insert";
  const std::string made = sql.ask("SELECT sql FROM sqlite_master WHERE type = 'trigger' AND name = '" + trigger + "'");
  sql.run("DROP TRIGGER \"" + trigger + "\"");
  writeFeatures(target, path, grid, layer, errors);
  sql.run(made);
}

// Writes what SQLite and OGR record of a layer's rows while they insert them. The box is passed as that of a geometry,
// so that no bits are lost in conversion to text.
void noteRows(Sql& sql, const GridLayer& layer, const IndexBox& box) {
  std::array<std::byte, kHeaderBytes + kBoxBytes> bytes{};
  ByteCursor cursor(bytes);
  putHeader(cursor, 0, box);
  std::string blob = "X'";
  constexpr char kHex[] = "0123456789ABCDEF";
  for (const std::byte b : bytes) {
    blob += kHex[std::to_integer<unsigned>(b) >> 4];
    blob += kHex[std::to_integer<unsigned>(b) & 15];
  }
  blob += '\'';
  const std::string name = "'" + layer.name + "'", rows = std::to_string(layer.rows);
  sql.run("INSERT INTO sqlite_sequence (name, seq) VALUES (" + name + ", " + rows + ")");
  sql.run("UPDATE gpkg_ogr_contents SET feature_count = " + rows + " WHERE table_name = " + name);
  sql.run("UPDATE gpkg_contents SET min_x = ST_MinX(" + blob + "), min_y = ST_MinY(" + blob + "), max_x = ST_MaxX(" +
          blob + "), max_y = ST_MaxY(" + blob + ") WHERE table_name = " + name);
}

// The box on the map of a row that OGR wrote.
IndexBox boxOfShape(const Grid& grid, const MapCutter& cutter, const GridLayer& layer, std::uint32_t row) {
  std::vector<std::uint32_t> nodes;
  layer.shapeOf(row, nodes);
  std::vector<Point> places;
  const auto add = [&places](const auto& parts) {
    for (const auto& part : parts) places.insert(places.end(), part.begin(), part.end());
  };
  if (layer.shape == GridLayer::Shape::Polygon && cutter.cuts({nodes[0], nodes[1], nodes[2]})) {
    add(cutter.partsOf({nodes[0], nodes[1], nodes[2]}));
  } else if (layer.shape == GridLayer::Shape::Line && cutter.cutsLine(nodes)) {
    add(cutter.partsOfLine(nodes));
  } else {
    for (const std::uint32_t node : nodes) places.push_back(grid.nodes[node]);
  }
  return boxOf(places);
}

// Appends a layer's index and its rows; `rows` is null if OGR wrote those. One layer at a time: the indices of all need
// much memory.
void appendLayer(const Grid& grid, const std::string& path, const MapCutter& cutter, const GridLayer& layer,
                 const LayerRows* rows, const OgrErrors& errors, const ItemLoop& loop) {
  DatasetPtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE));
  if (!dataset) failToWrite(path, errors);
  Sql sql(*dataset, path, errors);
  const std::string table = indexOf(layer);
  if (sql.askNumber("SELECT length(data) FROM \"" + table + "_node\" WHERE nodeno = 1") != GeoPackageIndex::kNodeBytes)
    throw OutputError("cannot write '" + path + "': SQLite made an index of another kind than was expected");
  const auto box = [&](std::uint32_t row) {
    return rows != nullptr ? rows->box(row) : boxOfShape(grid, cutter, layer, row);
  };
  const GeoPackageIndex index(static_cast<std::uint32_t>(layer.rows), box, loop);
  std::vector<SqliteTable> tables;
  if (rows != nullptr) {
    const auto srs_id = static_cast<std::int32_t>(
        std::stoll(sql.ask("SELECT srs_id FROM gpkg_geometry_columns WHERE table_name = '" + layer.name + "'")));
    tables.push_back({sql.rootOf(layer.name), layer.rows, 1,
                      [rows, srs_id](std::uint64_t row, SqliteRow& to) { rows->make(row, srs_id, to); }});
    noteRows(sql, layer, index.bounds());
  }
  index.addTables({sql.rootOf(table + "_node"), sql.rootOf(table + "_rowid"), sql.rootOf(table + "_parent")}, tables);
  closeDataset(std::move(dataset), path, errors);
  writeSqliteTables(path, tables, loop);
}

}  // namespace

// OGR makes the file, its tables and the short layers; rows of triangles and nodes, and the indices of all layers, are
// made by all threads and appended.
void writeGeoPackage(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  const OgrWriteErrors errors(path);
  const OgrOption date("OGR_CURRENT_DATE", kDate);
  // The file is renamed to its target only when complete, so a journal or waiting for the disk would gain nothing.
  const OgrOption journal("OGR_SQLITE_JOURNAL", "OFF");
  const OgrOption synchronous("OGR_SQLITE_SYNCHRONOUS", "OFF");
  // Without this name OGR calls a plane an undefined geographic CRS.
  const OgrWriter writer{"GPKG", {"SPATIAL_INDEX=NO"}, false, "LOCAL_CS[\"Undefined Cartesian SRS\"]"};
  const std::vector<GridLayer> layers = layersOf(grid, loop);
  std::vector<std::unique_ptr<LayerRows>> rows_of;  // null: OGR writes them
  for (const GridLayer& layer : layers) {
    const bool many = layer.shape != GridLayer::Shape::Line && layer.rows > 0;
    std::unique_ptr<LayerRows> rows = many ? std::make_unique<LayerRows>(grid, layer) : nullptr;
    rows_of.push_back(rows && rows->areSmall() ? std::move(rows) : nullptr);
  }

  DatasetPtr dataset = createDataset(writer, path, errors);
  if (dataset->StartTransaction() != OGRERR_NONE) failToWrite(path, errors);
  for (std::size_t i = 0; i < layers.size(); ++i)
    createLayerWithIndex(*dataset, path, writer, grid, layers[i], rows_of[i] == nullptr, errors);
  if (dataset->CommitTransaction() != OGRERR_NONE) failToWrite(path, errors);
  closeDataset(std::move(dataset), path, errors);
  const MapCutter cutter(grid);
  for (std::size_t i = 0; i < layers.size(); ++i)
    appendLayer(grid, path, cutter, layers[i], rows_of[i].get(), errors, loop);
}

namespace {

// SQLite would apply the log of an older file of the same name to the new one.
OutputFiles geoPackageFiles(const std::string& path) {
  return {{path}, {path + "-wal", path + "-shm", path + "-journal"}, {}};
}

}  // namespace

FormatRecord geoPackageFormat() {
  return {{.name = "gpkg",
           .endings = {".gpkg"},
           .description = "GeoPackage with layers of triangles, nodes, boundaries and lines",
           .readable = true,
           .writable = true,
           .holds = kLayerParts},
          {writeGeoPackage, readOgrGrid, geoPackageFiles}};
}

}  // namespace coastmesh
