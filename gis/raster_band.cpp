#include "gis/raster_band.hpp"

#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "gis/error.hpp"
#include "gis/ogr_support.hpp"

namespace coastmesh {
namespace {

// GDAL keeps what it read; by default a share of the memory that grows with the machine.
constexpr GIntBig kCacheBytes = 128 << 20;
// Pixels of a tile, about: small beside the cache, large beside the cost of a call.
constexpr std::int64_t kTilePixels = 1 << 20;

std::string subdatasetHint(GDALDataset& dataset) {
  char** const list = dataset.GetMetadata("SUBDATASETS");
  const char* const first = CSLFetchNameValue(list, "SUBDATASET_1_NAME");
  return first == nullptr ? "" : "; name one of its parts, such as " + std::string(first);
}

}  // namespace

struct RasterBand::Dataset {
  GDALDataset* dataset = nullptr;
  GDALRasterBand* band = nullptr;
  GDALRasterBand* mask = nullptr;  // null where every pixel has a value
  std::array<double, 6> to_pixel{};
  double scale = 1.0;
  double offset = 0.0;

  ~Dataset() {
    if (dataset != nullptr) GDALClose(dataset);
  }
};

RasterBand::RasterBand(std::string path) : path_(std::move(path)), dataset_(std::make_unique<Dataset>()) {
  GDALAllRegister();
  const OgrErrors errors;
  if (GDALGetCacheMax64() > kCacheBytes) GDALSetCacheMax64(kCacheBytes);
  Dataset& raster = *dataset_;
  raster.dataset = GDALDataset::Open(path_.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR);
  if (raster.dataset == nullptr) throw InputError("cannot read '" + path_ + "' as a raster: " + errors.text());
  if (raster.dataset->GetRasterCount() == 0)
    throw InputError("'" + path_ + "' has no raster band" + subdatasetHint(*raster.dataset));
  raster.band = raster.dataset->GetRasterBand(1);
  if ((raster.band->GetMaskFlags() & GMF_ALL_VALID) == 0) raster.mask = raster.band->GetMaskBand();
  raster.scale = raster.band->GetScale();
  raster.offset = raster.band->GetOffset();
  std::array<double, 6> to_place{};
  if (raster.dataset->GetGeoTransform(to_place.data()) != CE_None ||
      !GDALInvGeoTransform(to_place.data(), raster.to_pixel.data()))
    throw InputError("'" + path_ + "' does not say where its pixels lie (no geotransform); warp it with gdalwarp");
  columns_ = raster.dataset->GetRasterXSize();
  rows_ = raster.dataset->GetRasterYSize();
  crs_ = fromOgr(raster.dataset->GetSpatialRef());

  int block_columns = 1, block_rows = 1;
  raster.band->GetBlockSize(&block_columns, &block_rows);
  const auto side = static_cast<std::int64_t>(std::sqrt(static_cast<double>(kTilePixels)));
  tile_columns_ = block_columns * std::max<std::int64_t>(1, side / block_columns);
  tile_rows_ = block_rows * std::max<std::int64_t>(1, kTilePixels / tile_columns_ / block_rows);
  if (crs_.geographic && to_place[1] != 0.0) {
    period_ = 360.0 / std::abs(to_place[1]);
    wraps_ = std::abs(static_cast<double>(columns_) - period_) < 0.5;
    if (wraps_) period_ = static_cast<double>(columns_);
  }
}

RasterBand::~RasterBand() = default;
RasterBand::RasterBand(RasterBand&&) noexcept = default;

Point RasterBand::pixelOf(const Point& place) const {
  const std::array<double, 6>& to = dataset_->to_pixel;
  Point pixel{to[0] + to[1] * place.x + to[2] * place.y, to[3] + to[4] * place.x + to[5] * place.y};
  const auto width = static_cast<double>(columns_);
  if (period_ > 0.0 && (pixel.x < 0.0 || pixel.x > width)) {
    const double turned = pixel.x - period_ * std::floor(pixel.x / period_);
    if (turned <= width) pixel.x = turned;
  }
  return pixel;
}

void RasterBand::readInto(const RasterWindow& window, double* values, std::int64_t stride) const {
  const OgrErrors errors;
  const int column = static_cast<int>(window.column), row = static_cast<int>(window.row),
            columns = static_cast<int>(window.columns), rows = static_cast<int>(window.rows);
  const auto fail = [&] {
    throw InputError("cannot read '" + path_ + "' at pixel " + std::to_string(column) + ", " + std::to_string(row) +
                     ": " + errors.text());
  };
  if (dataset_->band->RasterIO(GF_Read, column, row, columns, rows, values, columns, rows, GDT_Float64, 0,
                               stride * static_cast<GSpacing>(sizeof(double)), nullptr) != CE_None)
    fail();
  std::vector<GByte> mask;
  if (dataset_->mask != nullptr) {
    mask.resize(static_cast<std::size_t>(window.columns * window.rows));
    if (dataset_->mask->RasterIO(GF_Read, column, row, columns, rows, mask.data(), columns, rows, GDT_Byte, 0, 0,
                                 nullptr) != CE_None)
      fail();
  }
  for (std::int64_t r = 0; r < window.rows; ++r) {
    for (std::int64_t c = 0; c < window.columns; ++c) {
      double& value = values[r * stride + c];
      const bool masked = !mask.empty() && mask[static_cast<std::size_t>(r * window.columns + c)] == 0;
      value = masked || !std::isfinite(value) ? std::numeric_limits<double>::quiet_NaN()
                                              : dataset_->offset + dataset_->scale * value;
    }
  }
}

std::vector<double> RasterBand::read(const RasterWindow& window) const {
  std::vector<double> values(static_cast<std::size_t>(window.columns * window.rows));
  const std::int64_t end = window.column + window.columns;
  for (std::int64_t at = window.column; at < end;) {
    const std::int64_t inside = wraps_ ? (at % columns_ + columns_) % columns_ : at;
    const std::int64_t count = std::min(end - at, columns_ - inside);
    readInto({inside, window.row, count, window.rows}, values.data() + (at - window.column), window.columns);
    at += count;
  }
  return values;
}

}  // namespace coastmesh
