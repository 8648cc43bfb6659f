// The positions of pixels in netCDF files, from the files' axes.
#include "gis/raster/raster_axes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <vector>

#include "gis/error.hpp"
#include "gis/model/depth.hpp"
#include "gis/size/size_raster.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/netcdf_rasters.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::NetcdfAxis;
using testing::TemporaryFolder;
using testing::writeCurvilinear;
using testing::writeNetcdfRaster;

std::vector<double> evenly(double first, double step, int count) {
  std::vector<double> places;
  for (int i = 0; i < count; ++i) places.push_back(first + step * i);
  return places;
}

NetcdfAxis longitudes(std::vector<double> places) { return {"lon", "degrees_east", std::move(places)}; }
NetcdfAxis latitudes(std::vector<double> places) { return {"lat", "degrees_north", std::move(places)}; }

RasterAxis axisOf(const NetcdfAxis& axis) { return {axis.name, axis.units, "", axis.places}; }

// Spaced on the ground like columns of `step` degrees there, as in Mercator's projection.
std::vector<double> mercatorLatitudes(double first, double step, int count) {
  const double start = std::asinh(std::tan(first * std::numbers::pi / 180.0));
  std::vector<double> places;
  for (int i = 0; i < count; ++i)
    places.push_back(std::atan(std::sinh(start + step * i * std::numbers::pi / 180.0)) * 180.0 / std::numbers::pi);
  return places;
}

// Linear in both, so that bilinear interpolation is exact wherever pixels lie.
double sloping(double lat, double lon) { return -1000.0 - 50.0 * lat + 3.0 * lon; }

class RasterAxesTest : public ::testing::Test {
 protected:
  // The depth report of a grid with these nodes; its z is in `grid_`.
  DepthReport depthsAt(const std::string& path, const std::string& crs, const std::vector<Point>& places) {
    grid_ = {};
    grid_.crs = parseCrs(crs);
    grid_.nodes.assign(places.begin(), places.end());
    DepthOptions options{{path}, DepthMethod::Bilinear};
    options.fill = DepthFill::None;
    return setDepths(grid_, options);
  }
  void expectSloping(const std::string& path, const std::vector<Point>& places) {
    EXPECT_THAT(depthsAt(path, "EPSG:4326", places).warnings, IsEmpty());
    for (std::size_t i = 0; i < places.size(); ++i)
      EXPECT_NEAR(grid_.z[i], sloping(places[i].y, places[i].x), 1e-6) << places[i].x << ", " << places[i].y;
  }
  std::string refusalOf(const std::string& path) const {
    try {
      readRasterGeometry(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
  Grid grid_;
};

// GDAL treats latitudes as even if their steps are nearly equal; here that would be off by 11 rows of 120.
TEST_F(RasterAxesTest, DepthsOfUnevenLatitudesAreWhereTheAxisSays) {
  const std::string rising = folder_ / "rising.nc", falling = folder_ / "falling.nc";
  std::vector<double> lats = mercatorLatitudes(17.0, 0.2, 120);
  writeNetcdfRaster(rising, latitudes(lats), longitudes(evenly(-99.0, 0.2, 100)), sloping);
  const double last = lats.back();
  std::ranges::reverse(lats);
  writeNetcdfRaster(falling, latitudes(lats), longitudes(evenly(-99.0, 0.2, 100)), sloping);
  for (const std::string& path : {rising, falling})
    expectSloping(path, {{-98.9, 17.05}, {-95.03, 22.2}, {-90.01, 28.77}, {-85.5, 30.0}, {-79.3, last - 0.01}});
  EXPECT_EQ(readRasterGeometry(rising).uneven_columns, nullptr);
  ASSERT_NE(readRasterGeometry(rising).uneven_rows, nullptr);
}

// Only the first, middle and last steps are equal.
TEST_F(RasterAxesTest, UnevenBetweenEvenEnds) {
  std::vector<double> lats = evenly(30.0, 0.1, 41), lons = evenly(-10.0, 0.1, 61);
  for (int i = 8; i < 14; ++i) lats[static_cast<std::size_t>(i)] += 0.05 * std::sin(std::numbers::pi * (i - 7) / 7.0);
  for (int i = 40; i < 50; ++i)
    lons[static_cast<std::size_t>(i)] -= 0.06 * std::sin(std::numbers::pi * (i - 39) / 11.0);
  const std::string path = folder_ / "bent.nc";
  writeNetcdfRaster(path, latitudes(lats), longitudes(lons), sloping);
  expectSloping(path, {{-9.5, 30.5}, {-9.0, 31.07}, {-5.53, 31.1}, {-5.4, 33.0}});
  const RasterGeometry geometry = readRasterGeometry(path);
  for (const Point& pixel : {Point{0.0, 0.0}, Point{44.3, 30.2}, Point{61.0, 41.0}, Point{12.5, 9.9}}) {
    const Point back = geometry.pixelOf(geometry.placeOf(pixel));
    EXPECT_NEAR(back.x, pixel.x, 1e-9);
    EXPECT_NEAR(back.y, pixel.y, 1e-9);
  }
  EXPECT_NEAR(geometry.placeOf({44.5, 0.5}).x, lons[44], 1e-9);
}

TEST_F(RasterAxesTest, SizesOfUnevenLatitudesAreWhereTheAxisSays) {
  const std::string path = folder_ / "sizes.nc";
  // A degree further north they are larger by a seventh.
  const auto size = [](double lat, double) { return 0.02 * std::exp(0.14 * (lat - 17.0)); };
  writeNetcdfRaster(path, latitudes(mercatorLatitudes(17.0, 0.1, 400)), longitudes(evenly(-99.0, 0.1, 100)), size);
  const TileRule rule{0.0, [](const RasterTile& tile, std::span<float> sizes) {
                        for (int y = 0; y < tile.height; ++y)
                          for (int x = 0; x < tile.width; ++x)
                            sizes[static_cast<std::size_t>(y * tile.width + x)] = tile.at(x, y);
                      }};
  const RasterField field(readRasterGeometry(path), wgs84(), Projection::plane(), Box::of({-98.0, 18.0}, {-90.0, 47.0}),
                          rule, inOrder);
  const std::vector<Point> places{{-97.0, 20.0}, {-94.3, 30.1}, {-91.0, 37.0}};
  std::vector<double> sizes(places.size());
  field.sample(places, sizes);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double exact = size(places[i].y, places[i].x);
    EXPECT_NEAR(sizes[i], exact, 0.04 * exact);
    const SizeBox box{places[i], 0.5};
    SizeRange range;
    field.bound(std::span(&box, 1), std::span(&range, 1));
    EXPECT_LE(range.low, 0.98 * sizes[i]);
    EXPECT_GE(range.low, 0.8 * sizes[i]);
    EXPECT_GE(range.high, 1.02 * sizes[i]);
    EXPECT_LE(range.high, 1.25 * sizes[i]);
  }
}

// Tiles of sizes end where pixels have grown by a tenth, and where tiles of an even raster end.
TEST_F(RasterAxesTest, TilesHavePixelsOfOneSize) {
  const NetcdfAxis axis = latitudes(mercatorLatitudes(0.0, 0.1, 700));
  const std::vector<int> cuts = UnevenAxis::from(axisOf(axis), -1.0, "f.nc")->cuts(256);
  EXPECT_EQ(cuts.front(), 0);
  EXPECT_EQ(cuts.back(), 700);
  EXPECT_THAT(cuts, ::testing::IsSupersetOf({256, 512}));
  EXPECT_GT(cuts.size(), 6u);
  EXPECT_LT(cuts.size(), 20u);
  for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
    const auto stepAt = [&](int row) {
      return axis.places[static_cast<std::size_t>(699 - row)] - axis.places[static_cast<std::size_t>(699 - row - 1)];
    };
    EXPECT_NEAR(stepAt(cuts[c]) / stepAt(std::min(cuts[c + 1], 699) - 1), 1.0, 0.15);
  }
}

// An axis rounded to single precision or to four decimals counts as even, as before: such rasters do not change.
TEST_F(RasterAxesTest, RoundedAxesAreEven) {
  NetcdfAxis lats = latitudes(evenly(-89.9979166, 1.0 / 240.0, 2000)),
             lons = longitudes(evenly(170.0, 1.0 / 240.0, 2100));
  for (const bool single : {true, false}) {
    for (NetcdfAxis* axis : {&lats, &lons}) {
      for (double& place : axis->places)
        place = single ? static_cast<double>(static_cast<float>(place)) : std::round(place * 1e4) / 1e4;
      EXPECT_EQ(UnevenAxis::from(axisOf(*axis), 1.0, "f.nc"), nullptr);
      EXPECT_EQ(UnevenAxis::from(axisOf(*axis), -1.0, "f.nc"), nullptr);
    }
  }
  NetcdfAxis fine = longitudes(evenly(-149.0, 1.0 / 32400.0, 500));  // steps of two ulps in single precision
  for (double& place : fine.places) place = static_cast<double>(static_cast<float>(place));
  EXPECT_EQ(UnevenAxis::from(axisOf(fine), 1.0, "f.nc"), nullptr);
  std::vector<double> over = evenly(175.0, 0.25, 41);
  for (double& place : over)
    if (place > 180.0) place -= 360.0;
  EXPECT_EQ(UnevenAxis::from(axisOf(longitudes(over)), 1.0, "f.nc"), nullptr);
}

TEST_F(RasterAxesTest, AxesThatTurnBackAreRefused) {
  std::vector<double> lats = evenly(30.0, 0.1, 41);
  lats[20] = lats[18];
  const std::string path = folder_ / "back.nc";
  writeNetcdfRaster(path, latitudes(lats), longitudes(evenly(-10.0, 0.1, 30)), sloping);
  EXPECT_THAT(refusalOf(path), ::testing::AllOf(HasSubstr("back.nc"), HasSubstr("'lat'")));
  lats[20] = std::nan("");
  EXPECT_THROW(UnevenAxis::from(axisOf(latitudes(lats)), 1.0, "f.nc"), InputError);
  EXPECT_THROW(UnevenAxis::from(axisOf(latitudes({5.0, 5.0, 5.0, 5.0})), 1.0, "f.nc"), InputError);
}

TEST_F(RasterAxesTest, AxesWithoutAGeotransformAreNamed) {
  const std::string steep = folder_ / "steep.nc";
  writeNetcdfRaster(steep, latitudes({0.0, 1.0, 3.0, 6.0, 10.0, 15.0}), longitudes(evenly(0.0, 1.0, 8)), sloping);
  EXPECT_THAT(refusalOf(steep), ::testing::AllOf(HasSubstr("steep.nc"), HasSubstr("'lat'"), HasSubstr("unevenly")));
  const std::string curved = folder_ / "curved.nc";
  writeCurvilinear(curved, 12, 15, [](int row, int column) {
    return std::pair{-90.0 + 0.1 * column + 0.03 * row, 25.0 + 0.1 * row - 0.03 * column};
  });
  EXPECT_THAT(refusalOf("NETCDF:\"" + curved + "\":h"),
              ::testing::AllOf(HasSubstr("curvilinear"), HasSubstr("gdalwarp -t_srs EPSG:4326")));
}

// A VRT keeps neither axes nor units of its files, and spaces their pixels evenly.
TEST_F(RasterAxesTest, VirtualRastersOfUnevenFilesAreRefused) {
  const std::string uneven = folder_ / "uneven.nc", even = folder_ / "even.nc", vrt = folder_ / "all.vrt";
  writeNetcdfRaster(uneven, latitudes(mercatorLatitudes(17.0, 0.2, 20)), longitudes(evenly(-99.0, 0.2, 20)), sloping);
  writeNetcdfRaster(even, latitudes(evenly(17.0, 0.2, 20)), longitudes(evenly(-99.0, 0.2, 20)), sloping);
  const auto write = [&](const std::string& source) {
    std::ofstream(vrt) << "<VRTDataset rasterXSize=\"20\" rasterYSize=\"20\"><GeoTransform>-99.1, 0.2, 0, 21, 0, -0.2"
                          "</GeoTransform><VRTRasterBand dataType=\"Float64\" band=\"1\"><SimpleSource><SourceFilename "
                          "relativeToVRT=\"1\">"
                       << source
                       << "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>";
  };
  write("even.nc");
  EXPECT_EQ(refusalOf(vrt), "");
  for (const std::string& source : {std::string("uneven.nc"), "NETCDF:&quot;" + uneven + "&quot;:z"}) {
    write(source);
    EXPECT_THAT(refusalOf(vrt), ::testing::AllOf(HasSubstr("all.vrt"), HasSubstr("uneven.nc")));
    EXPECT_THROW(depthsAt(vrt, "EPSG:4326", {{-98.0, 18.0}}), InputError);
  }
}

TEST_F(RasterAxesTest, LatitudesAlongColumnsAreRefused) {
  const std::string path = folder_ / "turned.nc";
  writeNetcdfRaster(path, longitudes(evenly(-10.0, 0.1, 30)), latitudes(evenly(30.0, 0.1, 41)), sloping);
  EXPECT_THAT(refusalOf(path), ::testing::AllOf(HasSubstr("turned.nc"), HasSubstr("ncpdq -a lat,lon")));
}

// Without a CRS, axes whose units are degrees are longitudes and latitudes, whatever the CRS of the mesh.
TEST_F(RasterAxesTest, AxesInDegreesAreLongitudesAndLatitudes) {
  const std::string path = folder_ / "degrees.nc";
  writeNetcdfRaster(path, latitudes(evenly(58.0, 0.1, 80)), longitudes(evenly(5.0, 0.1, 80)), sloping);
  const DepthReport report = depthsAt(path, "EPSG:32632", {{500000.0, 6650000.0}});
  EXPECT_NEAR(grid_.z[0], sloping(59.9873285, 9.0), 0.01);
  EXPECT_THAT(report.notes, ElementsAre(::testing::AllOf(HasSubstr("degrees.nc"), HasSubstr("EPSG:4326"))));
  EXPECT_THAT(report.warnings, IsEmpty());
  EXPECT_TRUE(readRasterGeometry(path).crs.geographic);
  // Other axes are in the mesh's CRS, as before.
  const std::string metres = folder_ / "metres.nc";
  writeNetcdfRaster(metres, {"y", "m", evenly(6640000.0, 1000.0, 30)}, {"x", "m", evenly(490000.0, 1000.0, 30)},
                    [](double, double) { return -5.0; });
  try {
    EXPECT_TRUE(readRasterGeometry(metres).crs.isPlane());
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'x' and 'y'"));
  }
}

}  // namespace
}  // namespace coastmesh
