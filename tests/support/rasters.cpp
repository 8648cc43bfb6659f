#include "tests/support/rasters.hpp"

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <vector>

namespace coastmesh::testing {

void writeRaster(const std::string& path, const std::string& crs, const RasterShape& shape,
                 const std::function<double(double x, double y)>& value) {
  GDALAllRegister();
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  GDALDataset* const dataset = driver->Create(path.c_str(), shape.columns, shape.rows, 1, GDT_Float64, nullptr);
  ASSERT_NE(dataset, nullptr);
  double transform[6] = {shape.west, shape.pixel, 0.0, shape.north, 0.0, -shape.pixel};
  dataset->SetGeoTransform(transform);
  if (!crs.empty()) {
    OGRSpatialReference srs;
    srs.SetFromUserInput(crs.c_str());
    dataset->SetSpatialRef(&srs);
  }
  GDALRasterBand* const band = dataset->GetRasterBand(1);
  band->SetNoDataValue(kNoValue);
  std::vector<double> row(static_cast<std::size_t>(shape.columns));
  for (int r = 0; r < shape.rows; ++r) {
    for (int c = 0; c < shape.columns; ++c)
      row[static_cast<std::size_t>(c)] =
          value(shape.west + (c + 0.5) * shape.pixel, shape.north - (r + 0.5) * shape.pixel);
    EXPECT_EQ(
        band->RasterIO(GF_Write, 0, r, shape.columns, 1, row.data(), shape.columns, 1, GDT_Float64, 0, 0, nullptr),
        CE_None);
  }
  GDALClose(dataset);
}

}  // namespace coastmesh::testing
