#include "gis/raster/raster_band.hpp"

#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "gis/crs/crs_from_ogr.hpp"
#include "gis/crs/length_unit.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/quiet_hdf5.hpp"
#include "gis/raster/raster_axes.hpp"
#include "gis/raster/raster_mosaic.hpp"

namespace coastmesh {
namespace {

// GDAL's block cache; by default it is a share of the machine's memory.
constexpr GIntBig kCacheBytes = 128 << 20;
// Approximate pixels of a tile: few compared with the cache, many compared with the overhead of a call.
constexpr std::int64_t kTilePixels = 1 << 20;

bool isText(GDALDataset& dataset) {
  GDALDriver* const driver = dataset.GetDriver();
  const std::string_view kind = driver == nullptr ? "" : driver->GetDescription();
  return kind == "AAIGrid" || kind == "GRASSASCIIGrid" || kind == "ISG";
}

std::string subdatasetHint(GDALDataset& dataset) {
  char** const list = dataset.GetMetadata("SUBDATASETS");
  const char* const first = CSLFetchNameValue(list, "SUBDATASET_1_NAME");
  return first == nullptr ? "" : "; name one of its parts, such as " + std::string(first);
}

// The remedy for a file of soundings or contours, that is of features, or a list of points without even rows.
std::string pointsHint(const std::string& name) {
  const OgrErrors ignored;
  const GDALDriverH driver = GDALIdentifyDriverEx(name.c_str(), GDAL_OF_RASTER, nullptr, nullptr);
  const bool is_list = driver != nullptr && std::string_view(GDALGetDriverShortName(driver)) == "XYZ";
  const GDALDatasetUniquePtr features(is_list ? nullptr : GDALDataset::Open(name.c_str(), GDAL_OF_VECTOR));
  return is_list || features != nullptr ? "; soundings and contours become a raster with gdal_grid -a linear" : "";
}

// Why GDAL gives the raster no geotransform, and what to do.
std::string placelessText(GDALDataset& dataset, const std::optional<RasterAxes>& axes) {
  if (CSLFetchNameValue(dataset.GetMetadata("GEOLOCATION"), "X_DATASET") != nullptr)
    return " has a curvilinear grid, with a longitude and a latitude for each pixel; make it a grid of even rows and "
           "columns with gdalwarp -t_srs EPSG:4326";
  if (axes)
    return " has axes of which GDAL makes no geotransform: '" + axes->columns.name + "' and '" + axes->rows.name +
           "' are too unevenly spaced, or do not say what they are; resample it to even rows and columns, in degrees "
           "or with a CRS";
  return " does not say where its pixels lie (no geotransform); warp it with gdalwarp";
}

// The unit of the band, else of heights in the CRS, and its length in metres; nullopt if it is not a length.
std::pair<std::string, std::optional<double>> unitOf(GDALDataset& dataset, GDALRasterBand& band) {
  std::string unit = oneLine(band.GetUnitType(), 60);
  const OGRSpatialReference* const crs = dataset.GetSpatialRef();
  if (!unit.empty() || crs == nullptr || crs->IsCompound() == 0) return {unit, metresInUnit(unit)};
  const char* name = nullptr;
  const double metres = crs->GetTargetLinearUnits("VERT_CS", &name);
  return {name == nullptr ? "" : name, metres};
}

std::string numberText(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", number);
  return text;
}

}  // namespace

struct RasterBand::Dataset {
  GDALDataset* dataset = nullptr;
  GDALRasterBand* band = nullptr;
  std::vector<GDALRasterBand*> masks;  // 0 where a pixel has no value
  std::optional<double> no_data;       // if the mask does not cover it
  bool is_single = false;              // values are in single precision
  double scale = 1.0;
  double offset = 0.0;
  // For text formats: GDAL finds the start of a row by reading the row before, on its own. But if the text ends too
  // early, it retries all rows before each missing row, recursively, which practically never ends. So we read rows in
  // order.
  bool rows_in_order = false;
  int rows_begun = 0;  // rows from the first on that were read, one after another
  std::uint64_t bytes_read = 0;
  std::vector<char> is_read;  // one for each file of the mosaic, else one for the raster

  ~Dataset() {
    if (dataset != nullptr) GDALClose(dataset);
  }

  bool isNoData(double value) const {
    // A no-data value that single precision cannot represent is rounded when read.
    return no_data && (value == *no_data || (is_single && static_cast<float>(value) == static_cast<float>(*no_data)));
  }
};

RasterBand::RasterBand(std::string path, BandValues kind) : kind_(kind), dataset_(std::make_unique<Dataset>()) {
  geometry_.path = std::move(path);
  const std::string& name = geometry_.path;
  registerDrivers();
  quietHdf5();
  const OgrErrors errors;
  if (GDALGetCacheMax64() > kCacheBytes) GDALSetCacheMax64(kCacheBytes);
  Dataset& raster = *dataset_;
  std::error_code error;
  if (std::filesystem::is_fifo(name, error))
    throw InputError("'" + name + "' is a pipe; rasters cannot be read from one, but from files");
  raster.dataset = GDALDataset::Open(name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR);
  if (raster.dataset == nullptr) {
    std::string reason = errors.text();
    if (reason.ends_with('.')) reason.pop_back();
    throw InputError("cannot read '" + name + "' as a raster: " + reason + pointsHint(name));
  }
  if (raster.dataset->GetRasterCount() == 0)
    throw InputError("'" + name + "' has no raster band" + subdatasetHint(*raster.dataset));
  raster.band = raster.dataset->GetRasterBand(1);
  raster.rows_in_order = isText(*raster.dataset);
  const GDALDataType type = raster.band->GetRasterDataType();
  if (GDALDataTypeIsComplex(type))
    throw InputError("'" + name + "': its first band holds complex numbers; give one of plain numbers");
  const int mask = raster.band->GetMaskFlags();
  if ((mask & GMF_ALL_VALID) == 0) raster.masks.push_back(raster.band->GetMaskBand());
  int bands = 1;  // of values
  for (int b = 2; b <= raster.dataset->GetRasterCount(); ++b) {
    GDALRasterBand* const band = raster.dataset->GetRasterBand(b);
    const bool is_alpha = band->GetColorInterpretation() == GCI_AlphaBand;
    if (!is_alpha) ++bands;
    // GDAL uses alpha bands as masks only if they are of integers.
    if (is_alpha && (mask & GMF_ALPHA) == 0) raster.masks.push_back(band);
  }
  if (bands > 1)
    geometry_.notes.push_back("'" + name + "' has " + std::to_string(bands) +
                              " bands, of which the first is read; 'vrt://" + name + "?bands=2' is the second");
  // GDAL has one mask per band; unless it is the no-data mask, it ignores no-data values.
  int has_no_data = 0;
  if ((mask & GMF_NODATA) == 0 && type != GDT_Int64 && type != GDT_UInt64) {
    const double no_data = raster.band->GetNoDataValue(&has_no_data);
    if (has_no_data != 0) raster.no_data = no_data;
  }
  raster.is_single = type == GDT_Float32;
  raster.scale = raster.band->GetScale();
  raster.offset = raster.band->GetOffset();
  if (kind == BandValues::Lengths) bringToMetres();
  geometry_.columns = raster.dataset->GetRasterXSize();
  geometry_.rows = raster.dataset->GetRasterYSize();
  readPlaces(errors.text());
  readPeriod();
  int& block_columns = geometry_.block_columns;
  int& block_rows = geometry_.block_rows;
  raster.band->GetBlockSize(&block_columns, &block_rows);
  geometry_.in_order = raster.rows_in_order;
  geometry_.mosaic = mosaicOf(*raster.dataset, geometry_.columns);
  geometry_.is_exact = geometry_.mosaic || !isVirtual(*raster.dataset);
  raster.is_read.assign(geometry_.mosaic ? geometry_.mosaic->files.size() : 1, 0);
  const auto side = static_cast<std::int64_t>(std::sqrt(static_cast<double>(kTilePixels)));
  tile_columns_ = block_columns * std::max<std::int64_t>(1, side / block_columns);
  tile_rows_ = block_rows * std::max<std::int64_t>(1, kTilePixels / tile_columns_ / block_rows);
}

// Determines whether the columns go around the Earth.
void RasterBand::readPeriod() {
  const double width = std::abs(geometry_.to_place[1]);
  if (!geometry_.crs.geographic || width == 0.0) return;
  constexpr double kRepeated = 0.25;  // columns
  geometry_.period = 360.0 / width;
  if (!geometry_.uneven_columns && std::abs(geometry_.columns - 1 - geometry_.period) < kRepeated) --geometry_.columns;
  geometry_.wraps = std::abs(geometry_.columns - geometry_.period) < 0.5;
  if (geometry_.wraps) geometry_.period = geometry_.columns;
}

// Determines where the pixels lie. `told` are GDAL's messages when it opened the file.
void RasterBand::readPlaces(const std::string& told) {
  GDALDataset& dataset = *dataset_->dataset;
  const std::string& name = geometry_.path;
  const std::optional<RasterAxes> axes = axesOf(dataset);
  if (axes && axes->columns.isLatitude() && axes->rows.isLongitude())
    throw InputError("'" + name + "': its rows are along '" + axes->rows.name + "' and its columns along '" +
                     axes->columns.name + "'; exchange these dimensions, as with ncpdq -a " + axes->columns.name + "," +
                     axes->rows.name);
  std::array<double, 6>& to_place = geometry_.to_place;
  if (dataset.GetGeoTransform(to_place.data()) != CE_None ||
      !GDALInvGeoTransform(to_place.data(), geometry_.to_pixel.data()))
    throw InputError("'" + name + "'" + placelessText(dataset, axes));
  geometry_.crs = fromOgr(dataset.GetSpatialRef(), "'" + name + "'");
  if (axes) {
    geometry_.uneven_columns = UnevenAxis::from(axes->columns, to_place[1], name);
    geometry_.uneven_rows = UnevenAxis::from(axes->rows, to_place[5], name);
    if (geometry_.crs.isPlane() && axes->columns.isLongitude() && axes->rows.isLatitude()) {
      geometry_.crs = wgs84();
      geometry_.notes.push_back("'" + name + "' has axes in degrees and no CRS; taken to be in " +
                                nameOf(geometry_.crs));
    }
  } else if (told.find("not spaced evenly") != std::string::npos) {
    throw InputError("'" + name +
                     "': its rows or columns are not evenly spaced, and GDAL does not tell where they are (" + told +
                     "); resample it to even ones");
  }
}

void RasterBand::requireEvenFiles() const {
  const OgrErrors errors;
  const char* const drivers[] = {"netCDF", nullptr};
  for (const std::string& file : netcdfFilesOf(*dataset_->dataset)) {
    Dataset source;
    source.dataset = GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers);
    double step[6];
    if (source.dataset == nullptr || source.dataset->GetRasterCount() == 0 ||
        source.dataset->GetGeoTransform(step) != CE_None)
      continue;
    const std::optional<RasterAxes> axes = axesOf(*source.dataset);
    if (axes && (UnevenAxis::from(axes->columns, step[1], file) || UnevenAxis::from(axes->rows, step[5], file)))
      throw InputError("'" + path() + "' is made of '" + file +
                       "', whose rows or columns are not evenly spaced, as those of a VRT are; give that file itself");
  }
}

RasterUse RasterBand::use() const {
  RasterUse use{dataset_->bytes_read, {}};
  for (std::size_t f = 0; f < dataset_->is_read.size(); ++f)
    if (dataset_->is_read[f] != 0) use.files.insert(geometry_.mosaic ? geometry_.mosaic->files[f] : path());
  return use;
}

RasterBand::~RasterBand() = default;
RasterBand::RasterBand(RasterBand&&) noexcept = default;

void RasterBand::bringToMetres() {
  Dataset& raster = *dataset_;
  const auto [unit, metres] = unitOf(*raster.dataset, *raster.band);
  if (!metres)
    throw InputError("'" + path() + "': the unit of its values is '" + unit +
                     "', which is no length; if they are in metres, have the file say so (gdal_edit.py -units m, or "
                     "ncatted for netCDF)");
  if (*metres == 1.0) return;
  raster.scale *= *metres;
  raster.offset *= *metres;
  geometry_.notes.push_back("'" + path() + "' is in " + unit + ": its values are multiplied by " + numberText(*metres));
}

RasterGeometry readRasterGeometry(const std::string& path) {
  const RasterBand band(path);
  band.requireEvenFiles();
  return band.geometry();
}

Point RasterGeometry::placeOf(const Point& pixel) const {
  const std::array<double, 6>& to = to_place;
  const double column = uneven_columns ? uneven_columns->evenOf(pixel.x) : pixel.x,
               row = uneven_rows ? uneven_rows->evenOf(pixel.y) : pixel.y;
  return {to[0] + to[1] * column + to[2] * row, to[3] + to[4] * column + to[5] * row};
}

Point RasterGeometry::evenPixelOf(const Point& place) const {
  const std::array<double, 6>& to = to_pixel;
  Point pixel{to[0] + to[1] * place.x + to[2] * place.y, to[3] + to[4] * place.x + to[5] * place.y};
  const double width = columns;
  if (period > 0.0 && (pixel.x < 0.0 || pixel.x > width)) {
    const double turned = pixel.x - period * std::floor(pixel.x / period);
    if (turned <= width) pixel.x = turned;
  }
  return pixel;
}

void RasterBand::readInto(const RasterWindow& window, double* values, std::int64_t stride) const {
  const OgrErrors errors;
  const int column = static_cast<int>(window.column), row = static_cast<int>(window.row),
            columns = static_cast<int>(window.columns), rows = static_cast<int>(window.rows);
  const auto failAt = [&](int at_column, int at_row) {
    throw InputError("cannot read '" + path() + "' at pixel " + std::to_string(at_column) + ", " +
                     std::to_string(at_row) + ": " + errors.text());
  };
  for (int& begun = dataset_->rows_begun; dataset_->rows_in_order && begun < row; ++begun) {
    double value = 0.0;
    if (dataset_->band->RasterIO(GF_Read, 0, begun, 1, 1, &value, 1, 1, GDT_Float64, 0, 0, nullptr) != CE_None)
      failAt(0, begun);
  }
  if (dataset_->band->RasterIO(GF_Read, column, row, columns, rows, values, columns, rows, GDT_Float64, 0,
                               stride * static_cast<GSpacing>(sizeof(double)), nullptr) != CE_None)
    failAt(column, row);
  const int pixel_bytes = GDALGetDataTypeSizeBytes(dataset_->band->GetRasterDataType());
  dataset_->bytes_read +=
      static_cast<std::uint64_t>(pixel_bytes) * static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows);
  if (geometry_.mosaic)
    geometry_.mosaic->forEachFile({column, row, columns, rows}, [&](std::size_t f) { dataset_->is_read[f] = 1; });
  else
    dataset_->is_read.front() = 1;
  const auto count = static_cast<std::size_t>(window.columns * window.rows);
  std::vector<bool> hidden(count, false);
  std::vector<float> shown(dataset_->masks.empty() ? 0 : count);
  for (GDALRasterBand* const mask : dataset_->masks) {
    if (mask->RasterIO(GF_Read, column, row, columns, rows, shown.data(), columns, rows, GDT_Float32, 0, 0, nullptr) !=
        CE_None)
      failAt(column, row);
    for (std::size_t i = 0; i < count; ++i)
      if (shown[i] == 0.0F) hidden[i] = true;
  }
  for (std::int64_t r = 0; r < window.rows; ++r) {
    for (std::int64_t c = 0; c < window.columns; ++c) {
      double& value = values[r * stride + c];
      const bool masked = hidden[static_cast<std::size_t>(r * window.columns + c)];
      value = masked || !std::isfinite(value) || dataset_->isNoData(value) ? std::numeric_limits<double>::quiet_NaN()
                                                                           : dataset_->offset + dataset_->scale * value;
    }
  }
}

std::vector<double> RasterBand::read(const RasterWindow& window) const {
  std::vector<double> values(static_cast<std::size_t>(window.columns * window.rows));
  const std::int64_t end = window.column + window.columns;
  for (std::int64_t at = window.column; at < end;) {
    const std::int64_t inside = wraps() ? (at % columns() + columns()) % columns() : at;
    const std::int64_t count = std::min(end - at, columns() - inside);
    readInto({inside, window.row, count, window.rows}, values.data() + (at - window.column), window.columns);
    at += count;
  }
  return values;
}

}  // namespace coastmesh
