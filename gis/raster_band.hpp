#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/point.hpp"
#include "gis/crs.hpp"

namespace coastmesh {

// Pixels of a raster: `columns` by `rows` from `column`, `row`.
struct RasterWindow {
  std::int64_t column = 0;
  std::int64_t row = 0;
  std::int64_t columns = 0;
  std::int64_t rows = 0;
};

// The first band of a raster that GDAL reads, a window at a time. For one thread.
class RasterBand {
 public:
  // Throws InputError, also for a raster without a place in its CRS.
  explicit RasterBand(std::string path);
  ~RasterBand();
  RasterBand(RasterBand&&) noexcept;
  RasterBand& operator=(RasterBand&&) = delete;

  const std::string& path() const { return path_; }
  const Crs& crs() const { return crs_; }  // a plane where the raster tells none
  std::int64_t columns() const { return columns_; }
  std::int64_t rows() const { return rows_; }
  // Columns after which longitudes repeat: 360 degrees of them; 0 where the raster is not of longitudes.
  double period() const { return period_; }
  bool wraps() const { return wraps_; }  // the last column meets the first

  // A place of the raster's CRS in columns and rows, from the corner of the first pixel; longitudes in the turn that
  // the raster has.
  Point pixelOf(const Point& place) const;
  // The size of windows that are read with least effort: whole blocks of the file.
  std::int64_t tileColumns() const { return tile_columns_; }
  std::int64_t tileRows() const { return tile_rows_; }

  // The window's values row by row, scale and offset applied, NaN where there is none. Columns past either end wrap
  // round where `wraps()`. REQUIRES: the window lies in the raster otherwise. Throws InputError.
  std::vector<double> read(const RasterWindow& window) const;

 private:
  struct Dataset;

  void readInto(const RasterWindow& window, double* values, std::int64_t stride) const;

  std::string path_;
  std::unique_ptr<Dataset> dataset_;
  Crs crs_;
  std::int64_t columns_ = 0;
  std::int64_t rows_ = 0;
  std::int64_t tile_columns_ = 1;
  std::int64_t tile_rows_ = 1;
  double period_ = 0.0;
  bool wraps_ = false;
};

}  // namespace coastmesh
