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

// Of the first band of a netCDF file; nothing where its dimensions have no coordinate variables, or it is another
// format: those that GDAL reads give their pixels even spacing.
std::optional<RasterAxes> axesOf(GDALDataset& dataset);

// GDAL's geotransform spaces the pixels of an axis evenly between its ends. This is where they really are: pixels as
// even spacing would have them ↔ pixels.
class UnevenAxis {
 public:
  // Null where the axis is even, up to the rounding of its numbers. `step` is the geotransform's: the raster may have
  // the axis in reverse order. Throws InputError where it does not rise or fall all along; `file` is for the message.
  static std::shared_ptr<const UnevenAxis> from(const RasterAxis& axis, double step, const std::string& file);

  double pixelOf(double even) const;
  double evenOf(double pixel) const;
  // Where to cut the pixels, from 0 to their number, so that between cuts their spacing is about the same. Multiples of
  // `longest` are among them.
  std::vector<int> cuts(int longest) const;

 private:
  explicit UnevenAxis(std::vector<double> centres) : centres_(std::move(centres)) {}

  std::vector<double> centres_;  // of pixels, rising from 0.5 to their number less 0.5
};

}  // namespace coastmesh
