#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace coastmesh::testing {

struct NetcdfAxis {
  std::string name, units;  // no units where empty
  std::vector<double> places;
  bool in_single_precision = false;
};

// A netCDF file with a variable "z" along `rows` and `columns` that holds `value(row's place, column's place)`, in
// `units` where these are not empty.
void writeNetcdfRaster(const std::string& path, const NetcdfAxis& rows, const NetcdfAxis& columns,
                       const std::function<double(double row, double column)>& value, const std::string& units = "");

// The same where both places are given for each pixel, in variables "lat" and "lon": `placesOf(row, column)` is the
// longitude and the latitude.
void writeCurvilinear(const std::string& path, int rows, int columns,
                      const std::function<std::pair<double, double>(int row, int column)>& placesOf);

}  // namespace coastmesh::testing
