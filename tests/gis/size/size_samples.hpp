#pragma once

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gis/size/size_source.hpp"

namespace coastmesh::testing {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline Pslg rectangle(double width, double height) {
  Pslg pslg;
  pslg.points = {{0.0, 0.0}, {width, 0.0}, {width, height}, {0.0, height}};
  for (VertexId i = 0; i < 4; ++i) pslg.segments.push_back({i, (i + 1) % 4, 0, 0, kOutside});
  return pslg;
}

inline Domain planeDomain(Pslg pslg) {
  Domain domain;
  domain.input_points = pslg.points;
  domain.pslg = std::move(pslg);
  return domain;
}

inline std::unique_ptr<SizeFunction> sizesIn(const SizeOptions& options, const Domain& domain, const Crs& crs = {}) {
  return makeSizeFunction(options, readSizeInputs(options, crs), domain, kInfinity, inOrder).function;
}

// Files of a test, in a separate folder.
class SizeFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    GDALAllRegister();
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("coastmesh-sizes-") + std::to_string(getpid()) + test->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  // Pixel (0, 0) is at the upper left.
  template <typename F>
  std::string raster(const std::string& name, int width, int height, const std::array<double, 6>& place, int epsg,
                     F&& value, double no_data = -9999.0) {
    GDALDataset* dataset = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(file(name).c_str(), width, height,
                                                                                    1, GDT_Float32, nullptr);
    std::array<double, 6> transform = place;
    dataset->SetGeoTransform(transform.data());
    if (epsg > 0) {
      OGRSpatialReference srs;
      srs.importFromEPSG(epsg);
      dataset->SetSpatialRef(&srs);
    }
    dataset->GetRasterBand(1)->SetNoDataValue(no_data);
    std::vector<float> row(static_cast<std::size_t>(width));
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x)
        row[static_cast<std::size_t>(x)] =
            static_cast<float>(value(place[0] + place[1] * (x + 0.5), place[3] + place[5] * (y + 0.5)));
      EXPECT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, y, width, 1, row.data(), width, 1, GDT_Float32, 0, 0),
                CE_None);
    }
    GDALClose(dataset);
    return file(name);
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace coastmesh::testing
