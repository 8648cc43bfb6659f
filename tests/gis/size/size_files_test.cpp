#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/metric.hpp"
#include "gis/crs/ground_balls.hpp"
#include "gis/error.hpp"
#include "gis/size/size_depth.hpp"
#include "gis/size/size_features.hpp"
#include "gis/size/size_raster.hpp"
#include "gis/size/size_source.hpp"
#include "tests/gis/size/size_samples.hpp"
#include "tests/support/damaged_geopackage.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::kInfinity;
using testing::planeDomain;
using testing::rectangle;
using testing::SizeFiles;
using testing::sizesIn;

// A domain in degrees with this shore.
Domain degreesDomain(const Ring& shore) {
  Coastline coast;
  coast.crs = wgs84();
  coast.features.emplace_back();
  coast.features.back().polygons.push_back({shore, {}});
  CleanReport report;
  return cleanFeatures(coast, {0}, Projection::fitted(coast, {0}), {}, report);
}

TEST(Wavelength, HoldsTheDispersionRelation) {
  for (const double period : {3.0, 10.0, 600.0, 44712.0}) {
    for (const double depth : {0.1, 1.0, 17.0, 200.0, 4000.0, 11000.0}) {
      const double k = 2.0 * std::numbers::pi / wavelengthOf(period, depth), w = 2.0 * std::numbers::pi / period;
      EXPECT_NEAR(9.81 * k * std::tanh(k * depth) / (w * w), 1.0, 1e-9) << period << " s, " << depth << " m";
    }
  }
  // The long-wave limit, for the tide: T sqrt(g d).
  EXPECT_NEAR(wavelengthOf(44712.0, 100.0) / (44712.0 * std::sqrt(9.81 * 100.0)), 1.0, 1e-4);
}

TEST_F(SizeFiles, RasterOfSizes) {
  const auto f = [](double x, double y) { return 0.05 + 0.01 * x + 0.02 * y; };
  SizeOptions options;
  options.rasters = {raster("a.tif", 400, 200, {0.0, 0.05, 0.0, 10.0, 0.0, -0.05}, 0, f)};
  const auto size = sizesIn(options, planeDomain(rectangle(20.0, 10.0)));
  for (double x = 0.3; x < 20.0; x += 0.37)
    for (double y = 0.3; y < 10.0; y += 0.41) EXPECT_NEAR(size->at({x, y}) / f(x, y), 1.0, 0.04) << x << ", " << y;
}

TEST_F(SizeFiles, ACoarseRasterIsBilinear) {
  const auto f = [](double x, double) { return 0.05 + 0.01 * x; };
  SizeOptions options;
  options.rasters = {raster("a.tif", 20, 10, {0.0, 1.0, 0.0, 10.0, 0.0, -1.0}, 0, f)};
  const auto size = sizesIn(options, planeDomain(rectangle(20.0, 10.0)));
  for (double x = 0.6; x < 19.4; x += 0.1) EXPECT_NEAR(size->at({x, 5.2}) / f(x, 5.2), 1.0, 0.02) << x;
}

// Accuracy then depends on the shore alone, wherever the shore wants smaller sizes.
TEST_F(SizeFiles, ARasterThatDecidesNowhereChangesNothing) {
  SizeOptions options;
  options.shore_m = 0.05;
  options.shore_rate = options.gradation = 0.1;
  const Domain domain = planeDomain(rectangle(20.0, 10.0));
  const auto alone = sizesIn(options, domain);
  options.rasters = {raster("a.tif", 400, 200, {0.0, 0.05, 0.0, 10.0, 0.0, -0.05}, 0,
                            [](double x, double y) { return 2.0 + 0.1 * std::sin(7.0 * x) * std::cos(9.0 * y); })};
  const auto both = sizesIn(options, domain);
  EXPECT_EQ(dynamic_cast<const SizeTree&>(*both).cells(), dynamic_cast<const SizeTree&>(*alone).cells());
  for (double x = 0.3; x < 20.0; x += 0.37)
    for (double y = 0.3; y < 10.0; y += 0.41) EXPECT_EQ(both->at({x, y}), alone->at({x, y})) << x << ", " << y;
}

TEST_F(SizeFiles, ASpotOfOnePixelIsNotMissed) {
  SizeOptions options;
  options.gradation = 0.2;
  options.rasters = {raster("a.tif", 2000, 1000, {0.0, 0.01, 0.0, 10.0, 0.0, -0.01}, 0,
                            [](double x, double y) { return std::hypot(x - 13.005, y - 4.005) < 0.005 ? 0.01 : 2.0; })};
  const auto size = sizesIn(options, planeDomain(rectangle(20.0, 10.0)));
  EXPECT_LT(size->at({13.005, 4.005}), 0.025);
  EXPECT_NEAR(size->at({14.005, 4.005}), 0.2, 0.04);
}

// Many pixels fit into an element there.
TEST_F(SizeFiles, ALineNarrowerThanItsSizeIsNotMissed) {
  SizeOptions options;
  options.gradation = 0.2;
  options.rasters = {raster("a.tif", 2000, 1000, {0.0, 0.01, 0.0, 10.0, 0.0, -0.01}, 0,
                            [](double x, double) { return std::abs(x - 13.005) < 0.005 ? 0.4 : 6.0; })};
  const auto size = sizesIn(options, planeDomain(rectangle(20.0, 10.0)));
  for (double y = 0.3; y < 10.0; y += 0.41) {
    EXPECT_NEAR(size->at({13.005, y}), 0.4, 0.08) << y;
    EXPECT_NEAR(size->at({16.005, y}), 1.0, 0.12) << y;
  }
}

// Against many points of each box; boxes from a hundredth of a pixel to several pixels.
TEST_F(SizeFiles, BoundsOfARasterHoldAndAreTight) {
  std::mt19937_64 random(11);
  std::vector<float> values(20 * 10);
  for (float& value : values) {
    const double kind = uniform(random, 0.0, 1.0);
    value = kind < 0.1 ? -9999.0F : kind < 0.3 ? 0.001F : static_cast<float>(uniform(random, 0.5, 1.0));
  }
  const RasterGeometry geometry =
      readRasterGeometry(raster("a.tif", 20, 10, {0.0, 1.0, 0.0, 10.0, 0.0, -1.0}, 0, [&](double x, double y) {
        return values[static_cast<std::size_t>(20 * std::floor(10.0 - y) + std::floor(x))];
      }));
  const TileRule as_is{0.0, [](const RasterTile& tile, std::span<float> sizes) {
                         for (int y = 0; y < tile.height; ++y)
                           for (int x = 0; x < tile.width; ++x)
                             if (!std::isnan(tile.at(x, y)))
                               sizes[static_cast<std::size_t>(y * tile.width + x)] = tile.at(x, y);
                       }};
  const RasterField field(geometry, {}, Projection::plane(), Box::of({-1.0, -1.0}, {21.0, 11.0}), as_is, inOrder);
  int tight = 0;
  constexpr int kBoxes = 3000;
  for (int i = 0; i < kBoxes; ++i) {
    const SizeBox box{{uniform(random, -0.5, 20.5), uniform(random, -0.5, 10.5)},
                      0.01 * std::pow(300.0, uniform(random, 0.0, 1.0))};
    std::vector<Point> places;
    for (int k = 0; k < 400; ++k)
      places.push_back(box.centre + box.half * Point{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)});
    std::vector<double> sizes(places.size());
    field.sample(places, sizes);
    SizeRange range;
    field.bound(std::span(&box, 1), std::span(&range, 1));
    const auto [low, high] = std::ranges::minmax(sizes);
    EXPECT_LE(range.low, low * (1.0 + 1e-6)) << box.centre.x << ", " << box.centre.y << " half " << box.half;
    EXPECT_GE(range.high, high * (1.0 - 1e-6)) << box.centre.x << ", " << box.centre.y << " half " << box.half;
    double known = 0.0;
    for (const double size : sizes)
      if (size < kInfinity) known = std::max(known, size);
    EXPECT_GE(field.mostIn(box), known * (1.0 - 1e-6)) << box.centre.x << ", " << box.centre.y << " half " << box.half;
    EXPECT_LE(field.mostIn(box), 1.0);
    if (box.half < 0.1) tight += range.low >= 0.5 * low && (range.high <= 2.0 * high || high == kInfinity);
  }
  EXPECT_GT(tight, kBoxes / 4);
}

TEST_F(SizeFiles, TheFirstRasterThatCoversAPlaceCounts) {
  const std::string fine =
      raster("a.tif", 50, 50, {5.0, 0.1, 0.0, 10.0, 0.0, -0.1}, 0, [](double, double) { return 1.0; });
  const std::string wide =
      raster("b.tif", 200, 100, {0.0, 0.1, 0.0, 10.0, 0.0, -0.1}, 0, [](double, double) { return 0.5; });
  SizeOptions options;
  options.gradation = 1.0;
  options.rasters = {fine, wide};
  const auto size = sizesIn(options, planeDomain(rectangle(20.0, 10.0)));
  EXPECT_NEAR(size->at({7.5, 7.5}), 1.0, 0.01);
  EXPECT_NEAR(size->at({15.0, 2.5}), 0.5, 0.01);
}

// The first raster is too deep for the band, or flat: that it requests nothing there does not make room for the second.
TEST_F(SizeFiles, ADepthThatAsksForNothingCountsToo) {
  const std::array<double, 6> west{0.0, 100.0, 0.0, 10000.0, 0.0, -100.0};
  const std::string deep = raster("a.tif", 100, 100, west, 0, [](double, double) { return 300.0; });
  const std::string steep = raster("b.tif", 200, 100, west, 0, [](double x, double) { return 5.0 + 1e-3 * x; });
  const Domain domain = planeDomain(rectangle(20000.0, 10000.0));
  for (const bool bands : {true, false}) {
    SizeOptions options;
    options.bathymetry = {deep, steep};
    options.depth.positive_down = true;
    if (bands)
      options.depth.bands = {{0.0, 50.0, 500.0}};
    else
      options.depth.slope_elements = 200.0;
    options.least_m = 50.0;
    options.most_m = options.size_m = 2000.0;
    options.gradation = 0.3;
    const auto size = sizesIn(options, domain);
    EXPECT_NEAR(size->at({2000.0, 5000.0}), 2000.0, 20.0) << bands;  // 8 km from the second raster's sizes
    EXPECT_LT(size->at({15000.0, 5000.0}), 700.0) << bands;
  }
}

// Columns of a raster without a CRS are the input's longitudes, in whichever turn.
TEST_F(SizeFiles, ARasterWithoutACrsIsFoundInAnotherTurn) {
  const Domain domain = degreesDomain({{-60.0, 40.0}, {-58.0, 40.0}, {-58.0, 42.0}, {-60.0, 42.0}});
  SizeOptions options;
  options.gradation = 1.0;
  options.rasters = {raster("a.tif", 80, 80, {299.0, 0.05, 0.0, 43.0, 0.0, -0.05}, 0,
                            [](double x, double) { return x < 301.0 ? 3000.0 : 6000.0; })};
  const auto size = sizesIn(options, domain, wgs84());
  for (const auto& [lon, wanted] : {std::pair{-59.5, 3000.0}, {-58.3, 6000.0}}) {
    const Point place = domain.projection.forward({lon, 41.0});
    EXPECT_NEAR(size->at(place) / domain.projection.scaleAt(place) / wanted, 1.0, 0.02) << lon;
  }
}

// The bed slopes along parallels, by 100 m a degree. Tiles have 256 rows: here 21 degrees.
TEST_F(SizeFiles, SlopesAlongParallelsHoldOnTheGround) {
  Ring sea;
  for (int lat = 42; lat < 79; ++lat) sea.push_back({-16.0, static_cast<double>(lat)});
  for (int lat = 78; lat > 41; --lat) sea.push_back({-14.0, static_cast<double>(lat)});
  const Domain domain = degreesDomain(sea);
  SizeOptions options;
  const double pixel = 1.0 / 12.0;
  options.bathymetry = {raster("d.tif", 360, 480, {-30.0, pixel, 0.0, 80.0, 0.0, -pixel}, 4326,
                               [](double x, double) { return -2000.0 - 100.0 * (x + 15.0); })};
  options.depth.slope_elements = 200.0;
  options.least_m = 1000.0;
  const auto size = sizesIn(options, domain, wgs84());
  for (const double lat : {77.0, 72.0, 66.0, 60.0, 50.0, 44.0}) {
    const Point place = domain.projection.forward({-15.0, lat});
    const double degree_m = 6378137.0 * toRadians(1.0) * std::cos(toRadians(lat));
    const double wanted = 2.0 * std::numbers::pi * 2000.0 / (200.0 * 100.0 / degree_m);
    EXPECT_NEAR(size->at(place) / domain.projection.scaleAt(place) / wanted, 1.0, 0.09) << lat;
  }
}

TEST_F(SizeFiles, NoDataAsksForNothing) {
  SizeOptions options;
  options.size_m = 0.7;
  options.rasters = {raster("a.tif", 200, 100, {0.0, 0.1, 0.0, 10.0, 0.0, -0.1}, 0,
                            [](double x, double) { return x < 10.0 ? 0.2 : -9999.0; })};
  const auto size = sizesIn(options, planeDomain(rectangle(20.0, 10.0)));
  EXPECT_NEAR(size->at({5.0, 5.0}), 0.2, 0.005);
  EXPECT_NEAR(size->at({17.0, 5.0}), 0.7, 0.01);
}

TEST_F(SizeFiles, ASizeOfNothingIsRefused) {
  SizeOptions options;
  options.rasters = {raster("a.tif", 20, 10, {0.0, 1.0, 0.0, 10.0, 0.0, -1.0}, 0, [](double, double) { return 0.0; })};
  EXPECT_THROW(sizesIn(options, planeDomain(rectangle(20.0, 10.0))), InputError);
}

TEST_F(SizeFiles, UnreadableFilesAreRefused) {
  for (const auto& set : {&SizeOptions::rasters, &SizeOptions::bathymetry, &SizeOptions::features}) {
    SizeOptions options;
    options.*set = {file("nothing.here")};
    options.depth.wave_elements = 100.0;
    EXPECT_THROW(readSizeInputs(options, {}), InputError);
  }
}

TEST_F(SizeFiles, DepthsInAnotherCrsAskForWavelengths) {
  // The domain in degrees, the depths on a metre grid of UTM zone 32.
  const std::string depths = raster("utm.tif", 300, 300, {300000.0, 2000.0, 0.0, 5800000.0, 0.0, -2000.0}, 32632,
                                    [](double x, double) { return -(10.0 + (x - 300000.0) / 1000.0); });
  Coastline coast;
  coast.crs = wgs84();
  coast.features.emplace_back();
  coast.features.back().polygons.push_back({{{8.0, 50.0}, {9.5, 50.0}, {9.5, 51.0}, {8.0, 51.0}}, {}});
  CleanReport report;
  const Projection projection = Projection::fitted(coast, {0});
  const Domain domain = cleanFeatures(coast, {0}, projection, {}, report);
  SizeOptions options;
  options.bathymetry = {depths};
  options.depth.wave_elements = 400.0;
  const auto size = sizesIn(options, domain, coast.crs);
  OGRSpatialReference geographic, utm;
  geographic.importFromEPSG(4326);
  geographic.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  utm.importFromEPSG(32632);
  utm.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::unique_ptr<OGRCoordinateTransformation> to_utm(OGRCreateCoordinateTransformation(&geographic, &utm));
  for (double lon = 8.1; lon < 9.5; lon += 0.13) {
    double x = lon, y = 50.4;
    ASSERT_TRUE(to_utm->Transform(1, &x, &y));
    const Point place = projection.forward({lon, 50.4});
    const double wanted = 44712.0 * std::sqrt(9.81 * (10.0 + (x - 300000.0) / 1000.0)) / 400.0;
    EXPECT_NEAR(size->at(place) / projection.scaleAt(place) / wanted, 1.0, 0.03) << lon;
  }
}

TEST_F(SizeFiles, SlopesBandsAndTheTimeStep) {
  // 100 m deep in the west, with a slope of 5 % from x = 5000 on.
  const auto depth = [](double x, double) { return 100.0 + 0.05 * std::max(0.0, x - 5000.0); };
  const std::string depths = raster("d.tif", 400, 200, {0.0, 50.0, 0.0, 10000.0, 0.0, -50.0}, 0, depth);
  const Domain domain = planeDomain(rectangle(20000.0, 10000.0));
  SizeOptions options;
  options.bathymetry = {depths};
  options.depth.positive_down = true;
  options.depth.slope_elements = 30.0;
  options.least_m = 50.0;
  options.most_m = 3000.0;
  const double x = 12000.0, d = depth(x, 0.0);
  EXPECT_NEAR(sizesIn(options, domain)->at({x, 5000.0}) / (2.0 * std::numbers::pi * d / (30.0 * 0.05)), 1.0, 0.04);
  // Flat there, but graded from where the slope begins.
  const double begin = 2.0 * std::numbers::pi * 100.0 / (30.0 * 0.05);
  EXPECT_NEAR(sizesIn(options, domain)->at({500.0, 5000.0}) / (begin + 0.3 * 4500.0), 1.0, 0.06);

  options.depth.slope_elements = 0.0;
  options.depth.bands = {{0.0, 200.0, 300.0}, {200.0, kInfinity, 900.0}};
  EXPECT_NEAR(sizesIn(options, domain)->at({1000.0, 5000.0}), 300.0, 3.0);
  EXPECT_NEAR(sizesIn(options, domain)->at({19000.0, 5000.0}), 900.0, 9.0);

  options.time_step_s = 20.0;
  options.courant = 0.5;
  const double allowed = std::sqrt(9.81 * 100.0) * 20.0 / 0.5;
  EXPECT_GT(allowed, 300.0);
  const double size = sizesIn(options, domain)->at({1000.0, 5000.0});
  EXPECT_GT(size, allowed);
  EXPECT_LT(size, 2.0 * allowed);
}

TEST_F(SizeFiles, BumpsShorterThanTheFilterDoNotCount) {
  const std::string depths = raster("d.tif", 400, 200, {0.0, 50.0, 0.0, 10000.0, 0.0, -50.0}, 0, [](double x, double) {
    return 100.0 + 10.0 * std::sin(2.0 * std::numbers::pi * x / 400.0);
  });
  const Domain domain = planeDomain(rectangle(20000.0, 10000.0));
  SizeOptions options;
  options.bathymetry = {depths};
  options.depth.positive_down = true;
  options.depth.slope_elements = 30.0;
  options.least_m = 50.0;
  options.most_m = 2000.0;
  EXPECT_LT(sizesIn(options, domain)->at({10000.0, 5000.0}), 400.0);
  options.depth.slope_filter_m = 2000.0;
  EXPECT_GT(sizesIn(options, domain)->at({10000.0, 5000.0}), 1500.0);
}

// Pixels twice as high as wide, and a ripple along either axis: the filter smooths both equally.
TEST_F(SizeFiles, TheSlopeFilterIsAsLongAlongBothAxes) {
  std::array<double, 2> sizes;
  for (const bool along_x : {true, false}) {
    const auto ripple = [&](double column, double row) {
      return 100.0 + 10.0 * std::sin(2.0 * std::numbers::pi * (along_x ? column / 40.0 : row / 20.0));
    };
    const std::string depths =
        raster(along_x ? "x.tif" : "y.tif", 400, 200, {0.0, 50.0, 0.0, 20000.0, 0.0, -100.0}, 0, ripple);
    SizeOptions options;
    options.bathymetry = {depths};
    options.depth.positive_down = true;
    options.depth.slope_elements = 30.0;
    options.depth.slope_filter_m = 1200.0;
    options.least_m = 1.0;
    options.most_m = 1e6;
    const auto size = sizesIn(options, planeDomain(rectangle(20000.0, 20000.0)));
    double least = 1e6;
    for (double x = 8000.0; x < 12000.0; x += 50.0) least = std::min(least, size->at({x, x}));
    sizes[along_x ? 0 : 1] = least;
  }
  EXPECT_NEAR(sizes[0] / sizes[1], 1.0, 0.15);
}

// Columns of the world are narrow at the pole: more than the widest margin of rows, and at last more than there are.
TEST_F(SizeFiles, TheSlopeFilterGoesRoundThePole) {
  Ring ring;
  for (int lon = -180; lon < 180; lon += 10) ring.push_back({static_cast<double>(lon), 78.0});
  const Domain domain = degreesDomain(ring);
  SizeOptions options;
  options.bathymetry = {raster("d.tif", 1440, 720, {-180.0, 0.25, 0.0, 90.0, 0.0, -0.25}, 4326,
                               [](double, double y) { return -1000.0 - 100.0 * (90.0 - y); })};
  options.depth.slope_elements = 500.0;
  options.depth.slope_filter_m = 100000.0;
  options.least_m = 1000.0;
  options.most_m = 40000.0;
  const auto size = sizesIn(options, domain, wgs84());
  for (const double lon : {-179.9, -90.0, 12.0, 179.0}) {
    for (const double lat : {80.0, 84.0, 87.0}) {
      const Point place = domain.projection.forward({lon, lat});
      const double depth = 1000.0 + 100.0 * (90.0 - lat);
      const double wanted = 2.0 * std::numbers::pi * depth / (500.0 * 100.0 / 111650.0);
      EXPECT_NEAR(size->at(place) / domain.projection.scaleAt(place) / wanted, 1.0, 0.06) << lon << ", " << lat;
    }
  }
}

TEST_F(SizeFiles, FeaturesWithSizes) {
  std::ofstream(file("f.geojson")) << R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {"size": 0.02, "rate": 0.1}, "geometry":
      {"type": "Point", "coordinates": [3, 4]}},
    {"type": "Feature", "properties": {"size": 0.05}, "geometry":
      {"type": "LineString", "coordinates": [[10, 1], [10, 9]]}},
    {"type": "Feature", "properties": {"size": 0.1}, "geometry":
      {"type": "Polygon", "coordinates": [[[14, 2], [19, 2], [19, 8], [14, 8], [14, 2]]]}},
    {"type": "Feature", "properties": {"size": null}, "geometry": {"type": "Point", "coordinates": [1, 1]}}]})";
  SizeOptions options;
  options.size_m = 1.0;
  options.gradation = 0.25;
  options.features = {file("f.geojson")};
  const auto size = sizesIn(options, planeDomain(rectangle(20.0, 10.0)));
  EXPECT_NEAR(size->at({3.0, 4.0}), 0.02, 0.003);
  EXPECT_NEAR(size->at({3.0, 6.0}), 0.22, 0.02);
  EXPECT_NEAR(size->at({10.0, 5.0}), 0.05, 0.005);
  EXPECT_NEAR(size->at({11.0, 5.0}), 0.30, 0.02);
  EXPECT_NEAR(size->at({16.0, 5.0}), 0.1, 0.003);
  EXPECT_NEAR(size->at({13.0, 5.0}), 0.35, 0.02);
}

// The edges of the box are parallels: its corners alone would be a line from the pole.
TEST_F(SizeFiles, LongEdgesOfFeaturesFollowParallels) {
  Ring ring;
  for (int lon = -180; lon < 180; lon += 10) ring.push_back({static_cast<double>(lon), 75.0});
  const Domain domain = degreesDomain(ring);
  std::ofstream(file("f.geojson"))
      << R"({"type": "Feature", "properties": {"size": 30000}, "geometry": {"type": "Polygon",
      "coordinates": [[[-180, 80], [180, 80], [180, 90], [-180, 90], [-180, 80]]]}})";
  SizeOptions options;
  options.features = {file("f.geojson")};
  options.size_m = 90000.0;
  const auto size = sizesIn(options, domain, wgs84());
  for (const double lon : {-170.0, -100.0, 3.0, 90.0, 179.0}) {
    for (const double lat : {80.3, 85.0, 89.0, 77.0}) {
      const Point place = domain.projection.forward({lon, lat});
      const double wanted = std::min(90000.0, 30000.0 + 0.3 * 111600.0 * std::max(0.0, 80.0 - lat));
      EXPECT_NEAR(size->at(place) / domain.projection.scaleAt(place) / wanted, 1.0, 0.08) << lon << ", " << lat;
    }
  }
}

// Squares 5 and 35 km from the water, and one on the other side of the Earth.
TEST_F(SizeFiles, FeaturesTooFarToCountAreLeftOut) {
  const Domain domain = degreesDomain({{179.0, 50.0}, {180.2, 50.0}, {180.2, 51.0}, {179.0, 51.0}});
  FeatureScope scope{GroundBalls(wgs84()).around(domain.input_points), 5000.0, 0.2};
  const auto scale = [&](const Point& place) { return domain.projection.scaleAt(place); };
  for (const auto& [west, counts] : {std::pair{-179.7, true}, {-179.3, true}, {0.0, false}}) {
    std::ofstream text(file("f.geojson"));
    text << R"({"type": "Feature", "properties": {"size": 1000, "rate": 0.3}, )"
         << R"("geometry": {"type": "Polygon", "coordinates": [[)";
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.1, 0.0}, {0.1, 0.1}, {0.0, 0.1}})
      text << "[" << west + x << "," << 50.5 + y << "],";
    text << "[" << west << ",50.5]]]}}";
    text.close();
    const SizedFeatures features = readSizedFeatures(file("f.geojson"), wgs84(), 0.3);
    const auto some = featureFields(features, domain.projection, scale, scope);
    const auto all = featureFields(features, domain.projection, scale);
    EXPECT_EQ(some.size(), counts ? 2u : 1u) << west;
    EXPECT_EQ(all.size(), 2u);
    for (const Point& place : domain.pslg.points) {
      double with = 0.0, without = 0.0;
      some.front()->sample(std::span(&place, 1), std::span(&with, 1));
      all.front()->sample(std::span(&place, 1), std::span(&without, 1));
      EXPECT_EQ(std::min(with, 5000.0), std::min(without, 5000.0)) << west;
    }
  }
}

TEST_F(SizeFiles, FeaturesWithoutSizesAreRefused) {
  std::ofstream(file("f.geojson")) << R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {"name": "x"}, "geometry": {"type": "Point", "coordinates": [3, 4]}}]})";
  std::ofstream(file("g.geojson")) << R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {"size": -3}, "geometry": {"type": "Point", "coordinates": [3, 4]}}]})";
  EXPECT_THROW(readSizedFeatures(file("f.geojson"), {}, 0.2), InputError);
  EXPECT_THROW(readSizedFeatures(file("g.geojson"), {}, 0.2), InputError);
}

// Like those of other options.
TEST_F(SizeFiles, FeaturesWithSizesAreReadFromArchivesAndLayers) {
  const auto layer = [](GDALDataset& dataset, const char* name, const char* field) {
    OGRLayer* const made = dataset.CreateLayer(name, nullptr, wkbPoint, nullptr);
    OGRFieldDefn definition(field, OFTReal);
    EXPECT_EQ(made->CreateField(&definition), OGRERR_NONE);
    OGRFeature feature(made->GetLayerDefn());
    feature.SetField(0, 25.0);
    feature.SetGeometryDirectly(new OGRPoint(3, 4));
    EXPECT_EQ(made->CreateFeature(&feature), OGRERR_NONE);
  };
  const auto make = [&](const char* driver, const std::string& path) {
    return std::unique_ptr<GDALDataset>(
        GetGDALDriverManager()->GetDriverByName(driver)->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  };
  layer(*make("GeoJSON", file("p.geojson")), "p", "size");
  const std::string zipped = "/vsizip/" + file("p.zip") + "/in/p.geojson";
  ASSERT_EQ(CPLCopyFile(zipped.c_str(), file("p.geojson").c_str()), 0);
  {
    const auto dataset = make("GPKG", file("two.gpkg"));
    layer(*dataset, "depths", "depth");
    layer(*dataset, "pts", "size");
  }
  for (const std::string& path : {file("p.zip"), file("two.gpkg") + "|pts", file("two.gpkg") + "|layername=pts"})
    EXPECT_EQ(readSizedFeatures(path, {}, 0.2).parts.at(0).size_m, 25.0) << path;
  EXPECT_THAT([&] { readSizedFeatures(file("two.gpkg"), {}, 0.2); },
              ::testing::ThrowsMessage<InputError>(
                  AllOf(HasSubstr("two.gpkg|depths': has no attribute 'size'"), HasSubstr("FILE|LAYER"))));
}

TEST_F(SizeFiles, FeaturesWithSizesThatCannotBeReadToTheirEndAreRefused) {
  {
    const std::unique_ptr<GDALDataset> dataset(
        GetGDALDriverManager()->GetDriverByName("GPKG")->Create(file("p.gpkg").c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    OGRLayer* const layer = dataset->CreateLayer("p", nullptr, wkbPoint, nullptr);
    OGRFieldDefn size("size", OFTReal), name("name", OFTString);
    EXPECT_EQ(layer->CreateField(&size), OGRERR_NONE);
    EXPECT_EQ(layer->CreateField(&name), OGRERR_NONE);
    for (int i = 0; i < 1000; ++i) {
      OGRFeature feature(layer->GetLayerDefn());
      feature.SetField("size", 25.0);
      feature.SetField("name", "a buoy");
      feature.SetGeometryDirectly(new OGRPoint(i, 0));
      EXPECT_EQ(layer->CreateFeature(&feature), OGRERR_NONE);
    }
  }
  ASSERT_EQ(readSizedFeatures(file("p.gpkg"), {}, 0.2).parts.size(), 1000u);
  testing::damageRowsWith("a buoy", file("p.gpkg"));
  EXPECT_THAT([&] { readSizedFeatures(file("p.gpkg"), {}, 0.2); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("p.gpkg': cannot be read to its end")));
}

// OGR itself takes the leading number of a text, whatever unit follows.
TEST_F(SizeFiles, SizesAsTextsAreNumbersOrRefused) {
  const auto sizes = [this](const std::string& text) {
    std::ofstream(file("t.geojson")) << R"({"type": "FeatureCollection", "features": [
      {"type": "Feature", "properties": {"size": ")"
                                     << text << R"("}, "geometry":
        {"type": "Point", "coordinates": [3, 4]}}]})";
    return readSizedFeatures(file("t.geojson"), {}, 0.2);
  };
  EXPECT_EQ(sizes("150").parts.at(0).size_m, 150.0);
  EXPECT_EQ(sizes(" 1.5e2 ").parts.at(0).size_m, 150.0);
  for (const char* text : {"1 km", "100 m", "1,5", "fine", " "}) EXPECT_THROW(sizes(text), InputError) << text;
}

}  // namespace
}  // namespace coastmesh
