#include "gis/crs/length_unit.hpp"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "gis/error.hpp"
#include "gis/raster/raster_band.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(LengthUnit, NamesOfLengths) {
  for (const char* const name :
       {"", "m", "M", "metre", "meters", " Metres ", "1", "user_z_unit", "unknown", "m above MSL",
        "meters, positive up", "metres (above LAT)", "m relative to sea level", "[m]", "m NAP", "meter(s)"})
    EXPECT_EQ(metresInUnit(name), 1.0) << name;
  EXPECT_EQ(metresInUnit("km"), 1000.0);
  EXPECT_EQ(metresInUnit("cm"), 0.01);
  EXPECT_EQ(metresInUnit("decimetres"), 0.1);
  EXPECT_EQ(metresInUnit("mm"), 0.001);
  EXPECT_EQ(metresInUnit("Feet"), 0.3048);
  EXPECT_EQ(metresInUnit("US survey foot"), 1200.0 / 3937.0);
  EXPECT_EQ(metresInUnit("fathoms"), 1.8288);
}

TEST(LengthUnit, OthersAreNone) {
  for (const char* const name : {"m/s", "m s-1", "m2", "kg", "degrees", "K", "hPa", "db", "|", "m|km", "above", "days",
                                 "[m/s]", "m day-1", "[]"})
    EXPECT_EQ(metresInUnit(name), std::nullopt) << name;
}

// Three pixels of integers with a scale, an offset and a no-data value.
std::string writeUnits(const std::string& path, const char* unit, const char* crs = nullptr) {
  GDALAllRegister();
  GDALDataset* const dataset =
      GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path.c_str(), 3, 1, 1, GDT_Int16, nullptr);
  double transform[6] = {0.0, 1.0, 0.0, 1.0, 0.0, -1.0};
  dataset->SetGeoTransform(transform);
  if (crs != nullptr) {
    OGRSpatialReference srs;
    srs.SetFromUserInput(crs);
    dataset->SetSpatialRef(&srs);
  }
  GDALRasterBand* const band = dataset->GetRasterBand(1);
  band->SetUnitType(unit);
  band->SetScale(0.5);
  band->SetOffset(10.0);
  band->SetNoDataValue(-9);
  std::int16_t values[] = {-30, -9, 4};
  EXPECT_EQ(band->RasterIO(GF_Write, 0, 0, 3, 1, values, 3, 1, GDT_Int16, 0, 0, nullptr), CE_None);
  GDALClose(dataset);
  return path;
}

TEST(LengthUnit, ValuesOfRastersAreInMetres) {
  const testing::TemporaryFolder folder;
  const RasterBand plain(writeUnits(folder / "m.tif", "metre"));
  EXPECT_THAT(plain.geometry().notes, IsEmpty());
  EXPECT_EQ(plain.read({0, 0, 1, 1}).front(), -5.0);
  const RasterBand band(writeUnits(folder / "km.tif", "km"));
  EXPECT_THAT(band.geometry().notes, ElementsAre(AllOf(HasSubstr("km.tif"), HasSubstr("km"), HasSubstr("1000"))));
  const std::vector<double> values = band.read({0, 0, 3, 1});
  EXPECT_DOUBLE_EQ(values[0], -5000.0);
  EXPECT_TRUE(std::isnan(values[1]));
  EXPECT_DOUBLE_EQ(values[2], 12000.0);
  // Only the CRS states the unit.
  const RasterBand heights(writeUnits(folder / "feet.tif", "", "EPSG:4326+6360"));
  EXPECT_THAT(heights.geometry().notes, ElementsAre(HasSubstr("US survey foot")));
  EXPECT_NEAR(heights.read({0, 0, 1, 1}).front(), -5.0 * 1200.0 / 3937.0, 1e-9);
  try {
    readRasterGeometry(writeUnits(folder / "heat.tif", "Celsius"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("heat.tif"), HasSubstr("'Celsius'"), HasSubstr("no length")));
  }
}

}  // namespace
}  // namespace coastmesh
