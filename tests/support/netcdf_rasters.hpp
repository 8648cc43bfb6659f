#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace coastmesh::testing {

struct NetcdfAxis {
  std::string name, units;  // no units attribute if empty
  std::vector<double> places;
  bool in_single_precision = false;
};

// Writes a netCDF file with a variable "z" along `rows` and `columns` that holds `value(row's place, column's place)`,
// with `units` unless empty.
void writeNetcdfRaster(const std::string& path, const NetcdfAxis& rows, const NetcdfAxis& columns,
                       const std::function<double(double row, double column)>& value, const std::string& units = "");

// Writes a netCDF file with the position of each pixel in variables "lon" and "lat", which `placesOf(row, column)`
// returns in this order, and 10 + row + column in "h".
void writeCurvilinear(const std::string& path, int rows, int columns,
                      const std::function<std::pair<double, double>(int row, int column)>& placesOf);

}  // namespace coastmesh::testing
