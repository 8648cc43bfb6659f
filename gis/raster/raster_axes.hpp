#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class GDALDataset;

namespace coastmesh {

// A coordinate variable of a raster's columns or rows, as the file has it.
struct RasterAxis {
  std::string name, unit, standard_name;
  std::vector<double> places;  // of the centres of pixels, in the file's order

  bool isLongitude() const;
  bool isLatitude() const;
};

struct RasterAxes {
  RasterAxis columns, rows;
};

// The axes of the first band of a netCDF file. Nullopt if its dimensions have no coordinate variables, and for other
// formats, whose pixels GDAL reads as evenly spaced.
std::optional<RasterAxes> axesOf(GDALDataset& dataset);

// GDAL's geotransform spaces the pixels of an axis evenly between its ends. This class maps such even pixel coordinates
// to true ones, along an axis that is not evenly spaced, and back.
class UnevenAxis {
 public:
  // Null if the axis is even, up to the rounding of its numbers, or has fewer than three pixels. `step` is the
  // geotransform's: the raster may have the axis in reverse order. Throws InputError if the axis is not strictly
  // monotonic; `file` is for the message.
  static std::shared_ptr<const UnevenAxis> from(const RasterAxis& axis, double step, const std::string& file);

  double pixelOf(double even) const;
  double evenOf(double pixel) const;
  // Where to cut the pixels, from 0 to their number, so that their spacing is about the same between cuts. Multiples of
  // `longest` are among the cuts. REQUIRES: `longest` is a multiple of 16.
  std::vector<int> cuts(int longest) const;

 private:
  explicit UnevenAxis(std::vector<double> centres) : centres_(std::move(centres)) {}

  std::vector<double> centres_;  // of pixels, in even coordinates: rise from 0.5 to their number less 0.5
};

}  // namespace coastmesh
