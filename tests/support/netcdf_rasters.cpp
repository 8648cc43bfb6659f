#include "tests/support/netcdf_rasters.hpp"

#include <gtest/gtest.h>
#include <netcdf.h>

namespace coastmesh::testing {

namespace {

void put(int status) { EXPECT_EQ(status, NC_NOERR) << nc_strerror(status); }

void putText(int file, int variable, const char* name, const std::string& text) {
  if (!text.empty()) put(nc_put_att_text(file, variable, name, text.size(), text.c_str()));
}

}  // namespace

void writeNetcdfRaster(const std::string& path, const NetcdfAxis& rows, const NetcdfAxis& columns,
                       const std::function<double(double row, double column)>& value, const std::string& units) {
  int file = -1, dimensions[2] = {-1, -1}, axes[2] = {-1, -1}, values = -1;
  put(nc_create(path.c_str(), NC_CLOBBER | NC_NETCDF4, &file));
  const NetcdfAxis* const both[2] = {&rows, &columns};
  for (int k = 0; k < 2; ++k) {
    const NetcdfAxis& axis = *both[k];
    put(nc_def_dim(file, axis.name.c_str(), axis.places.size(), &dimensions[k]));
    put(nc_def_var(file, axis.name.c_str(), axis.in_single_precision ? NC_FLOAT : NC_DOUBLE, 1, &dimensions[k],
                   &axes[k]));
    putText(file, axes[k], "units", axis.units);
  }
  put(nc_def_var(file, "z", NC_DOUBLE, 2, dimensions, &values));
  putText(file, values, "units", units);
  put(nc_enddef(file));
  std::vector<double> all;
  for (const double row : rows.places)
    for (const double column : columns.places) all.push_back(value(row, column));
  for (int k = 0; k < 2; ++k) put(nc_put_var_double(file, axes[k], both[k]->places.data()));
  put(nc_put_var_double(file, values, all.data()));
  put(nc_close(file));
}

void writeCurvilinear(const std::string& path, int rows, int columns,
                      const std::function<std::pair<double, double>(int row, int column)>& placesOf) {
  int file = -1, dimensions[2] = {-1, -1}, variables[3] = {-1, -1, -1};
  put(nc_create(path.c_str(), NC_CLOBBER | NC_NETCDF4, &file));
  put(nc_def_dim(file, "eta_rho", static_cast<std::size_t>(rows), &dimensions[0]));
  put(nc_def_dim(file, "xi_rho", static_cast<std::size_t>(columns), &dimensions[1]));
  const char* const names[3] = {"lon", "lat", "h"};
  const char* const units[3] = {"degrees_east", "degrees_north", "m"};
  for (int k = 0; k < 3; ++k) {
    put(nc_def_var(file, names[k], NC_DOUBLE, 2, dimensions, &variables[k]));
    putText(file, variables[k], "units", units[k]);
  }
  putText(file, variables[2], "coordinates", "lon lat");
  put(nc_enddef(file));
  std::vector<double> all[3];
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto [lon, lat] = placesOf(row, column);
      all[0].push_back(lon);
      all[1].push_back(lat);
      all[2].push_back(10.0 + row + column);
    }
  }
  for (int k = 0; k < 3; ++k) put(nc_put_var_double(file, variables[k], all[k].data()));
  put(nc_close(file));
}

}  // namespace coastmesh::testing
