#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"
#include "gis/raster/raster_axes.hpp"

namespace coastmesh {

struct RasterMosaic;

// Pixels of a raster: `columns` by `rows` from `column`, `row`.
struct RasterWindow {
  std::int64_t column = 0;
  std::int64_t row = 0;
  std::int64_t columns = 0;
  std::int64_t rows = 0;
};

// The geometry of a raster, without its values.
struct RasterGeometry {
  std::string path;
  // Where the last column repeats the first, a turn further east, it does not count: centres at -180 and 180.
  int columns = 0, rows = 0;
  int block_columns = 1, block_rows = 1;       // of the file: read as a whole
  bool in_order = false;                       // rows must be read in order, from the first (text formats)
  std::shared_ptr<const RasterMosaic> mosaic;  // if composed of files side by side; else null
  bool is_exact = true;                        // a pixel has the same value in any window
  std::array<double, 6> to_place{};            // GDAL's geotransform
  std::array<double, 6> to_pixel{};            // its inverse
  std::shared_ptr<const UnevenAxis> uneven_columns, uneven_rows;  // null: evenly spaced, as the geotransform says
  Crs crs;                                                        // a plane if the raster has none
  double period = 0.0;             // columns after which longitudes repeat: 360 degrees; 0 for other CRS
  bool wraps = false;              // the last column meets the first, to half a pixel
  std::vector<std::string> notes;  // for the user: units that are converted, a CRS that is assumed, other bands

  // Converts a place in the raster's CRS to columns and rows, counted from the corner of the first pixel; longitudes
  // are brought into the raster's range.
  Point pixelOf(const Point& place) const { return fromEven(evenPixelOf(place)); }
  Point placeOf(const Point& pixel) const;
  // The two steps of `pixelOf`: as if columns and rows were evenly spaced, which is smooth, then along the true axes.
  Point evenPixelOf(const Point& place) const;
  Point fromEven(const Point& even) const {
    return {uneven_columns ? uneven_columns->pixelOf(even.x) : even.x,
            uneven_rows ? uneven_rows->pixelOf(even.y) : even.y};
  }
};

// Whether the values of a band are lengths, which are read in metres, or numbers in any unit, read as they are.
enum class BandValues { Lengths, AsTheyAre };

// What was read of a raster: bytes of its pixels, uncompressed, in their type, including repeated reads; and the files
// that contain them, if the raster names its files.
struct RasterUse {
  std::uint64_t bytes = 0;
  std::set<std::string> files;

  void add(const RasterUse& other) {
    bytes += other.bytes;
    files.insert(other.files.begin(), other.files.end());
  }
};

// Throws InputError like `RasterBand`, and for a VRT of netCDF files with unevenly spaced pixels, which the VRT places
// evenly. This is checked here, once, before a raster is read.
RasterGeometry readRasterGeometry(const std::string& path);

// The first band of a raster that GDAL reads, window by window. For one thread. Only this class reads rasters, so that
// missing values are the same for depths and sizes: no-data pixels, values that are not finite, and pixels excluded by
// a mask (of the band, of the raster, an alpha band).
class RasterBand {
 public:
  // Throws InputError, also for a raster without georeference, for complex numbers, and for lengths whose unit is none.
  explicit RasterBand(std::string path, BandValues kind = BandValues::Lengths);
  ~RasterBand();
  RasterBand(RasterBand&&) noexcept;
  RasterBand& operator=(RasterBand&&) = delete;

  const RasterGeometry& geometry() const { return geometry_; }
  const std::string& path() const { return geometry_.path; }
  const Crs& crs() const { return geometry_.crs; }
  std::int64_t columns() const { return geometry_.columns; }
  std::int64_t rows() const { return geometry_.rows; }
  double period() const { return geometry_.period; }
  bool wraps() const { return geometry_.wraps; }
  Point pixelOf(const Point& place) const { return geometry_.pixelOf(place); }
  // The window size that is fastest to read: whole blocks of the file.
  std::int64_t tileColumns() const { return tile_columns_; }
  std::int64_t tileRows() const { return tile_rows_; }

  // The same band, opened once more.
  RasterBand reopened() const { return RasterBand(path(), kind_); }

  // The window's values row by row, with scale and offset applied, NaN where missing. Columns beyond either
  // end wrap around if `wraps()`. REQUIRES: otherwise the window is in the raster. Throws InputError.
  std::vector<double> read(const RasterWindow& window) const;
  // Throws InputError for a VRT of files whose pixels are not evenly spaced.
  void requireEvenFiles() const;
  // What was read so far.
  RasterUse use() const;

 private:
  struct Dataset;

  void bringToMetres();
  void readPlaces(const std::string& told);
  void readPeriod();
  void readInto(const RasterWindow& window, double* values, std::int64_t stride) const;

  RasterGeometry geometry_;
  BandValues kind_;
  std::unique_ptr<Dataset> dataset_;
  std::int64_t tile_columns_ = 1;
  std::int64_t tile_rows_ = 1;
};

}  // namespace coastmesh
