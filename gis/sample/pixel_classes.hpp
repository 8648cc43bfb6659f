#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gis/raster/raster_band.hpp"

namespace coastmesh {

// What the classes of a raster mean, such as a friction for each kind of land cover.
class PixelClasses {
 public:
  // Reads a table of two columns, class and value, separated by commas, semicolons or tabs, with or without a line of
  // titles; the rest of a line after # is ignored. Throws InputError, also for a class that has two values.
  explicit PixelClasses(const std::string& path);

  std::optional<double> valueOf(double pixel_class) const;
  // Throws InputError for a pixel whose class the table lacks.
  [[noreturn]] void failAt(const RasterBand& raster, std::int64_t column, std::int64_t row) const;

 private:
  std::string path_;
  std::vector<std::pair<double, double>> sorted_;  // class and value
};

}  // namespace coastmesh
