// Depths and sizes from one raster: the same pixels are missing for both, however the file marks them.
#include "gis/raster/raster_band.hpp"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "gis/error.hpp"
#include "gis/model/depth.hpp"
#include "gis/raster/raster_mosaic.hpp"
#include "gis/size/size_raster.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/netcdf_rasters.hpp"

namespace coastmesh {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::TemporaryFolder;

constexpr int kSide = 12;
constexpr double kNoData = -9999.0;
constexpr double kScale = 0.01, kOffset = 10.0;  // of the raster of integers
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Sizes of half a pixel and less, so that none of them is lost among its neighbours.
double valueOf(int column, int row) { return -(0.1 + 0.02 * column + 0.01 * row); }
bool isHidden(int column, int row) { return (column * 5 + row * 7) % 4 == 0; }
bool isNoData(int column, int row) { return (column + row) % 5 == 0; }

enum class Told { NoData, NotANumber, MaskOfRaster, MaskFile, Alpha, AlphaOfFloats, MaskAndNoData };

// kSide by kSide pixels of one unit from (0, 0); `told` is how hidden pixels are marked.
void writeMasked(const std::string& path, Told told) {
  GDALAllRegister();
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  const bool with_alpha = told == Told::Alpha || told == Told::AlphaOfFloats;
  GDALDataset* const dataset = driver->Create(path.c_str(), kSide, kSide, with_alpha ? 2 : 1,
                                              told == Told::Alpha ? GDT_UInt16 : GDT_Float32, nullptr);
  ASSERT_NE(dataset, nullptr);
  double transform[6] = {0.0, 1.0, 0.0, kSide, 0.0, -1.0};
  dataset->SetGeoTransform(transform);
  const bool with_no_data = told == Told::NoData || told == Told::MaskAndNoData;
  if (told == Told::Alpha) {
    dataset->GetRasterBand(1)->SetScale(kScale);
    dataset->GetRasterBand(1)->SetOffset(-kOffset);
  }
  if (with_no_data) dataset->GetRasterBand(1)->SetNoDataValue(kNoData);
  if (with_alpha) dataset->GetRasterBand(2)->SetColorInterpretation(GCI_AlphaBand);
  const bool with_mask = told == Told::MaskOfRaster || told == Told::MaskFile || told == Told::MaskAndNoData;
  if (with_mask) {
    CPLSetThreadLocalConfigOption("GDAL_TIFF_INTERNAL_MASK", told == Told::MaskFile ? "NO" : "YES");
    ASSERT_EQ(dataset->CreateMaskBand(GMF_PER_DATASET), CE_None);
    CPLSetThreadLocalConfigOption("GDAL_TIFF_INTERNAL_MASK", nullptr);
  }
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const bool hidden = isHidden(column, row);
      double value = valueOf(column, row);
      if (told == Told::Alpha) value = (value + kOffset) / kScale;  // as an integer
      if (told == Told::NoData && hidden) value = kNoData;
      if (told == Told::NotANumber && hidden) value = kNaN;
      if (told == Told::MaskAndNoData && isNoData(column, row)) value = kNoData;
      double shown = hidden ? 0.0 : told == Told::Alpha ? 65535.0 : told == Told::AlphaOfFloats ? 0.3 : 255.0;
      const auto put = [&](GDALRasterBand* band, double& pixel) {
        EXPECT_EQ(band->RasterIO(GF_Write, column, row, 1, 1, &pixel, 1, 1, GDT_Float64, 0, 0, nullptr), CE_None);
      };
      put(dataset->GetRasterBand(1), value);
      if (with_alpha) put(dataset->GetRasterBand(2), shown);
      if (with_mask) put(dataset->GetRasterBand(1)->GetMaskBand(), shown);
    }
  }
  GDALClose(dataset);
}

// Sizes are the values with reversed sign; where there is no value, no size is wanted.
TileRule valuesAsSizes() {
  return {
      0.0, [](const RasterTile& tile, std::span<float> sizes) {
        for (int y = 0; y < tile.height; ++y)
          for (int x = 0; x < tile.width; ++x)
            if (!std::isnan(tile.at(x, y)))
              sizes[static_cast<std::size_t>(y) * static_cast<std::size_t>(tile.width) + static_cast<std::size_t>(x)] =
                  -tile.at(x, y);
      }};
}

RasterField fieldOf(const std::string& path, const Crs& crs, const Box& box, const TileRule& rule) {
  return {readRasterGeometry(path), crs, Projection::plane(), box, rule, inOrder};
}

double sizeAt(const RasterField& field, const Point& place) {
  double size = 0.0;
  field.sample(std::span(&place, 1), std::span(&size, 1));
  return size;
}

// The depths of nodes at these places; NaN where the raster has none.
std::vector<double> depthsAt(const std::string& path, const Crs& crs, const std::vector<Point>& places) {
  Grid grid;
  grid.crs = crs;
  grid.nodes.assign(places.begin(), places.end());
  DepthOptions options{{path}, DepthMethod::Bilinear};
  options.fill = DepthFill::None;
  setDepths(grid, options);
  return grid.z;
}

TEST(RasterBand, WhatIsMissingIsMissingForDepthsAndSizes) {
  const TemporaryFolder folder;
  for (const Told told : {Told::NoData, Told::NotANumber, Told::MaskOfRaster, Told::MaskFile, Told::Alpha,
                          Told::AlphaOfFloats, Told::MaskAndNoData}) {
    SCOPED_TRACE(static_cast<int>(told));
    const std::string path = folder / ("masked" + std::to_string(static_cast<int>(told)) + ".tif");
    writeMasked(path, told);
    // The pixels that sizes are made from; between centres, sizes are bilinear.
    std::vector<bool> missing_for_sizes;
    TileRule rule = valuesAsSizes();
    rule.sizes = [&, inner = rule.sizes](const RasterTile& tile, std::span<float> sizes) {
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) missing_for_sizes.push_back(std::isnan(tile.at(x, y)));
      inner(tile, sizes);
    };
    const RasterField field = fieldOf(path, {}, Box::of({0.0, 0.0}, {kSide, kSide}), rule);
    ASSERT_EQ(missing_for_sizes.size(), static_cast<std::size_t>(kSide * kSide));
    std::vector<Point> centres;
    for (int row = 0; row < kSide; ++row)
      for (int column = 0; column < kSide; ++column) centres.push_back({column + 0.5, kSide - row - 0.5});
    const std::vector<double> depths = depthsAt(path, {}, centres);
    std::size_t i = 0;
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column, ++i) {
        const bool missing = isHidden(column, row) || (told == Told::MaskAndNoData && isNoData(column, row));
        EXPECT_EQ(std::isnan(depths[i]), missing) << column << ", " << row;
        EXPECT_EQ(missing_for_sizes[i], missing) << column << ", " << row;
        if (missing) continue;
        EXPECT_NEAR(depths[i], valueOf(column, row), 1e-6);
        EXPECT_NEAR(sizeAt(field, centres[i]), -valueOf(column, row), 1e-6);
      }
    }
  }
}

// The width of a pixel in degrees is rounded; columns go around the Earth nevertheless.
TEST(RasterBand, GoesRoundTheEarthForDepthsAndSizes) {
  const TemporaryFolder folder;
  const std::string path = folder / "world.tif";
  GDALAllRegister();
  constexpr int kColumns = 36, kRows = 18;
  constexpr double kPixel = 10.002;
  GDALDataset* const dataset =
      GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path.c_str(), kColumns, kRows, 1, GDT_Float64, nullptr);
  double transform[6] = {-180.0, kPixel, 0.0, 90.0, 0.0, -10.0};
  dataset->SetGeoTransform(transform);
  OGRSpatialReference srs;
  srs.SetFromUserInput("EPSG:4326");
  dataset->SetSpatialRef(&srs);
  std::vector<double> row(kColumns, -2.0);
  row.front() = -1.0;
  row.back() = -1.4;
  for (int r = 0; r < kRows; ++r)
    EXPECT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, r, kColumns, 1, row.data(), kColumns, 1, GDT_Float64, 0,
                                                  0, nullptr),
              CE_None);
  GDALClose(dataset);
  EXPECT_TRUE(readRasterGeometry(path).wraps);
  // On the seam, half of the last column and half of the first.
  const Point seam{-180.0, 5.0}, inside{-175.0, 5.0};
  const std::vector<double> depths = depthsAt(path, wgs84(), {seam, inside});
  EXPECT_NEAR(depths[0], -1.2, 1e-6);
  EXPECT_NEAR(depths[1], -1.0, 0.01);
  float west_of_first = 0.0F;
  TileRule rule = valuesAsSizes();
  rule.margin_m = 1.0;
  rule.sizes = [inner = rule.sizes, &west_of_first](const RasterTile& tile, std::span<float> sizes) {
    west_of_first = tile.at(-1, 0);
    inner(tile, sizes);
  };
  const RasterField field = fieldOf(path, wgs84(), Box::of({-180.0, -40.0}, {-100.0, 40.0}), rule);
  EXPECT_NEAR(sizeAt(field, seam), 1.2, 0.01);
  EXPECT_NEAR(sizeAt(field, inside), 1.0, 0.02);
  EXPECT_EQ(west_of_first, -1.4F);
}

// Values that are linear in the longitude around 180, and steep enough for each pixel to keep its own size. The centres
// of pixels are at -180 and 180: the last column repeats the first.
class RepeatedColumn : public ::testing::Test {
 protected:
  static constexpr int kColumns = 37, kRows = 19;
  static double valueAt(double lon) { return -2.5 - 0.012 * std::remainder(lon - 180.0, 360.0); }

  // Columns `first` to `last` of them.
  std::string write(const std::string& name, int first, int last) const {
    GDALAllRegister();
    GDALDataset* const dataset = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        (folder_ / name).c_str(), last - first, kRows, 1, GDT_Float64, nullptr);
    double transform[6] = {-185.0 + 10.0 * first, 10.0, 0.0, 95.0, 0.0, -10.0};
    dataset->SetGeoTransform(transform);
    OGRSpatialReference srs;
    srs.SetFromUserInput("EPSG:4326");
    dataset->SetSpatialRef(&srs);
    std::vector<double> row;
    for (int column = first; column < last; ++column) row.push_back(valueAt(-180.0 + 10.0 * column));
    for (int r = 0; r < kRows; ++r)
      EXPECT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, r, last - first, 1, row.data(), last - first, 1,
                                                    GDT_Float64, 0, 0, nullptr),
                CE_None);
    GDALClose(dataset);
    return folder_ / name;
  }

  // The plane holds on both sides of 180, for depths and for sizes.
  void expectPlane(const std::string& path) const {
    std::vector<Point> places;
    for (const double lon : {171.0, 176.0, 179.0, 180.0, -180.0, -179.0, -176.0, -171.0, 182.0, -182.0})
      places.push_back({lon, 5.0});
    const std::vector<double> depths = depthsAt(path, wgs84(), places);
    const RasterField west = fieldOf(path, wgs84(), Box::of({-180.0, -40.0}, {-100.0, 40.0}), valuesAsSizes());
    const RasterField east = fieldOf(path, wgs84(), Box::of({100.0, -40.0}, {180.0, 40.0}), valuesAsSizes());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double value = valueAt(places[i].x);
      EXPECT_NEAR(depths[i], value, 1e-6) << places[i].x;
      if (std::abs(places[i].x) > 180.0) continue;
      EXPECT_NEAR(sizeAt(places[i].x < 0.0 ? west : east, places[i]), -value, 1e-3) << places[i].x;
    }
  }

  const TemporaryFolder folder_;
};

TEST_F(RepeatedColumn, CountsOnce) {
  const std::string path = write("world.tif", 0, kColumns);
  EXPECT_TRUE(readRasterGeometry(path).wraps);
  EXPECT_EQ(readRasterGeometry(path).columns, kColumns - 1);
  expectPlane(path);
}

TEST_F(RepeatedColumn, CountsOnceInAMosaic) {
  write("west.tif", 0, 20);
  write("east.tif", 20, kColumns);
  const std::string path = folder_ / "world.vrt";
  const auto source = [](const std::string& name, int first, int columns) {
    const std::string size = " xSize=\"" + std::to_string(columns) + "\" ySize=\"19\"/>";
    return "<SimpleSource><SourceFilename relativeToVRT=\"1\">" + name +
           "</SourceFilename><SourceBand>1</SourceBand><SrcRect xOff=\"0\" yOff=\"0\"" + size + "<DstRect xOff=\"" +
           std::to_string(first) + "\" yOff=\"0\"" + size + "</SimpleSource>";
  };
  std::ofstream(path) << "<VRTDataset rasterXSize=\"37\" rasterYSize=\"19\"><SRS>EPSG:4326</SRS>"
                         "<GeoTransform>-185, 10, 0, 95, 0, -10</GeoTransform><VRTRasterBand dataType=\"Float64\" "
                         "band=\"1\">"
                      << source("west.tif", 0, 20) << source("east.tif", 20, 17) << "</VRTRasterBand></VRTDataset>";
  const RasterGeometry geometry = readRasterGeometry(path);
  ASSERT_TRUE(geometry.mosaic);
  EXPECT_EQ(geometry.mosaic->cuts.columns, (std::vector{0, 20, kColumns - 1}));
  expectPlane(path);
}

// HDF5 has a setting for each thread of whether it prints errors, which netCDF takes for answers.
TEST(RasterBand, NothingIsPrintedByThreadsThatReadNetcdf) {
  const TemporaryFolder folder;
  const std::string path = folder / "z.nc";
  const std::vector<double> places{1.0, 2.0, 3.0};
  testing::writeNetcdfRaster(path, {"lat", "degrees_north", places}, {"lon", "degrees_east", places},
                             [](double row, double column) { return row + column; });
  ::testing::internal::CaptureStderr();
  for (int k = 0; k < 2; ++k) std::thread([&] { EXPECT_EQ(RasterBand(path).read({0, 0, 3, 3}).size(), 9U); }).join();
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

// A grid of 200 rows whose text ends after 120: the missing rows are refused at once.
TEST(RasterBand, ATextThatEndsTooEarlyIsRefusedWhereverItIsRead) {
  const TemporaryFolder folder;
  const std::string path = folder / "short.asc";
  {
    std::ofstream text(path);
    text << "ncols 3\nnrows 200\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    for (int row = 0; row < 120; ++row) text << row << " " << row + 1 << " " << row + 2 << "\n";
  }
  const RasterBand band(path);
  for (const std::int64_t row : {190, 121, 199}) {
    try {
      band.read({1, row, 1, 1});
      ADD_FAILURE() << row;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("short.asc' at pixel 0, 120: "), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(band.read({1, 118, 2, 2}), (std::vector<double>{119, 120, 120, 121}));
  EXPECT_EQ(band.read({0, 3, 1, 1}), std::vector<double>{3});
}

TEST(RasterBand, SoundingsAreToBecomeARaster) {
  const TemporaryFolder folder;
  const auto errorOf = [&](const char* name) -> std::string {
    try {
      RasterBand band(folder / name);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  const std::vector<std::pair<const char*, const char*>> files{
      {"list.xyz", "-72 18 3\n-72.5 18.1 4\n-73.1 18.4 6\n"},
      {"points.geojson",
       R"({"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [-72, 18, 3]}})"}};
  for (const auto& [name, text] : files) {
    std::ofstream(folder / name) << text;
    EXPECT_THAT(errorOf(name), AllOf(HasSubstr(name), HasSubstr("gdal_grid -a linear")));
  }
  std::ofstream(folder / "text.asc") << "no raster";
  EXPECT_THAT(errorOf("text.asc"), Not(HasSubstr("gdal_grid")));
}

// A band of values for each step of time, or for each colour; an alpha band has none.
TEST(RasterBand, OtherBandsAreNoted) {
  const TemporaryFolder folder;
  GDALAllRegister();
  for (const bool with_alpha : {false, true}) {
    const std::string path = folder / "bands.tif";
    GDALDataset* const dataset =
        GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path.c_str(), 2, 2, 3, GDT_Float32, nullptr);
    ASSERT_NE(dataset, nullptr);
    double transform[6] = {0.0, 1.0, 0.0, 2.0, 0.0, -1.0};
    dataset->SetGeoTransform(transform);
    for (int b = 1; b <= 3; ++b) dataset->GetRasterBand(b)->Fill(b);
    if (with_alpha) dataset->GetRasterBand(3)->SetColorInterpretation(GCI_AlphaBand);
    GDALClose(dataset);
    const RasterBand first(path);
    EXPECT_EQ(first.read({0, 0, 1, 1}), std::vector<double>{1.0});
    EXPECT_EQ(first.geometry().notes, std::vector<std::string>{"'" + path + "' has " + (with_alpha ? "2" : "3") +
                                                               " bands, of which the first is read; 'vrt://" + path +
                                                               "?bands=2' is the second"});
    const RasterBand second("vrt://" + path + "?bands=2");
    EXPECT_EQ(second.read({0, 0, 1, 1}), std::vector<double>{2.0});
    EXPECT_EQ(second.geometry().notes, std::vector<std::string>());
  }
}

TEST(RasterBand, ACrsThatCannotBeUsedNamesTheFile) {
  const TemporaryFolder folder;
  const std::string path = folder / "grads.tif";
  GDALAllRegister();
  GDALDataset* const dataset =
      GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path.c_str(), 2, 2, 1, GDT_Float32, nullptr);
  ASSERT_NE(dataset, nullptr);
  double transform[6] = {0.0, 1.0, 0.0, 2.0, 0.0, -1.0};
  dataset->SetGeoTransform(transform);
  OGRSpatialReference grads;
  ASSERT_EQ(grads.importFromEPSG(4807), OGRERR_NONE);
  dataset->SetSpatialRef(&grads);
  GDALClose(dataset);
  try {
    const RasterBand band(path);
    ADD_FAILURE() << "was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'" + path + "': the CRS \"NTF (Paris)\" does not measure in degrees"),
              std::string::npos)
        << error.what();
  }
}

TEST(RasterBand, ComplexNumbersAreRefused) {
  const TemporaryFolder folder;
  const std::string path = folder / "complex.tif";
  GDALAllRegister();
  GDALDataset* const dataset =
      GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path.c_str(), 2, 2, 1, GDT_CFloat32, nullptr);
  double transform[6] = {0.0, 1.0, 0.0, 2.0, 0.0, -1.0};
  dataset->SetGeoTransform(transform);
  GDALClose(dataset);
  EXPECT_THROW(RasterBand{path}, InputError);
  EXPECT_THROW(readRasterGeometry(path), InputError);
}

}  // namespace
}  // namespace coastmesh
