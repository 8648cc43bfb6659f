#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <unistd.h>

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "core/metric.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/error.hpp"
#include "gis/size/size_channel.hpp"
#include "gis/size/size_depth.hpp"
#include "gis/size/size_distance.hpp"
#include "gis/size/size_raster.hpp"
#include "gis/size/size_source.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double one(const Point&) { return 1.0; }

Pslg rectangle(double width, double height) {
  Pslg pslg;
  pslg.points = {{0.0, 0.0}, {width, 0.0}, {width, height}, {0.0, height}};
  for (VertexId i = 0; i < 4; ++i) pslg.segments.push_back({i, (i + 1) % 4, 0, 0, kOutside});
  return pslg;
}

Domain planeDomain(Pslg pslg) {
  Domain domain;
  domain.input_points = pslg.points;
  domain.pslg = std::move(pslg);
  return domain;
}

std::unique_ptr<SizeFunction> sizesIn(const SizeOptions& options, const Domain& domain, const Crs& crs = {}) {
  return makeSizeFunction(options, readSizeInputs(options, crs), domain, kInfinity, inOrder).function;
}

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

TEST(DistanceField, IsTheLeastOverAllLines) {
  std::mt19937_64 random(5);
  std::vector<SizedLine> lines;
  for (int i = 0; i < 300; ++i) {
    const Point a{uniform(random, 0.0, 10.0), uniform(random, 0.0, 10.0)};
    const Point b = i % 5 == 0 ? a : a + Point{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)};
    lines.push_back({a, b, uniform(random, 0.1, 2.0), uniform(random, 0.0, 0.5)});
  }
  const DistanceField field(lines, [](const Point&) { return 2.0; });
  std::vector<Point> places;
  std::vector<SizeBox> boxes;
  for (int i = 0; i < 2000; ++i) {
    places.push_back({uniform(random, -5.0, 15.0), uniform(random, -5.0, 15.0)});
    boxes.push_back({places.back(), uniform(random, 0.0, 2.0)});
  }
  std::vector<double> sizes(places.size());
  std::vector<SizeRange> ranges(boxes.size());
  field.sample(places, sizes);
  field.bound(boxes, ranges);
  const auto naive = [&](const Point& x) {
    double least = kInfinity;
    for (const SizedLine& l : lines) {
      // By steps along the line, in place of the foot of a perpendicular.
      double nearest = std::min(distance(x, l.a), distance(x, l.b));
      for (int k = 1; k < 200; ++k) nearest = std::min(nearest, distance(x, l.a + (k / 200.0) * (l.b - l.a)));
      least = std::min(least, l.size_m + l.rate * nearest / 2.0);
    }
    return least;
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_NEAR(sizes[i], naive(places[i]), 2e-3);
    EXPECT_EQ(ranges[i].at_centre, sizes[i]);
    const Point inside = places[i] + boxes[i].half * Point{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)};
    EXPECT_GE(naive(inside), ranges[i].low - 1e-9);
    EXPECT_LE(naive(inside), ranges[i].high + 2e-3);
  }
}

// Where all lines are alike squares of distances are compared, in another way.
TEST(DistanceField, FindsTheNearestOfLinesThatAreAlike) {
  std::mt19937_64 random(6);
  for (const std::size_t count : {1u, 7u, 8u, 9u, 500u}) {
    std::vector<SizedLine> lines;
    for (std::size_t i = 0; i < count; ++i) {
      const Point a{uniform(random, 0.0, 10.0), uniform(random, 0.0, 10.0)};
      lines.push_back(
          {a, i % 5 == 0 ? a : a + Point{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)}, 0.5, 0.2});
    }
    constexpr double kMost = 0.9;
    const DistanceField field(
        lines, [](const Point&) { return 1.0; }, kMost);
    std::vector<Point> places;
    std::vector<SizeBox> boxes;
    for (int i = 0; i < 1000; ++i) {
      places.push_back({uniform(random, -5.0, 15.0), uniform(random, -5.0, 15.0)});
      boxes.push_back({places.back(), uniform(random, 0.0, 2.0)});
    }
    std::vector<double> sizes(places.size());
    std::vector<SizeRange> ranges(boxes.size());
    field.sample(places, sizes);
    field.bound(boxes, ranges);
    for (std::size_t i = 0; i < places.size(); ++i) {
      double nearest = kInfinity;
      for (const SizedLine& l : lines) nearest = std::min(nearest, squaredDistanceToSegment(places[i], l.a, l.b));
      EXPECT_NEAR(sizes[i], std::min(kMost, 0.5 + 0.2 * std::sqrt(nearest)), 1e-12);
      EXPECT_EQ(ranges[i].at_centre, sizes[i]);
    }
  }
}

TEST(Wavelength, HoldsTheDispersionRelation) {
  for (const double period : {3.0, 10.0, 600.0, 44712.0}) {
    for (const double depth : {0.1, 1.0, 17.0, 200.0, 4000.0, 11000.0}) {
      const double k = 2.0 * std::numbers::pi / wavelengthOf(period, depth), w = 2.0 * std::numbers::pi / period;
      EXPECT_NEAR(9.81 * k * std::tanh(k * depth) / (w * w), 1.0, 1e-9) << period << " s, " << depth << " m";
    }
  }
  // The long wave of the tide: T sqrt(g d).
  EXPECT_NEAR(wavelengthOf(44712.0, 100.0) / (44712.0 * std::sqrt(9.81 * 100.0)), 1.0, 1e-4);
}

TEST(ChannelLines, FindTheWidthOfAChannel) {
  // Long sides without vertices: the width has to be found between them.
  const std::vector<SizedLine> lines = channelLines(rectangle(100.0, 2.0), 4.0, 0.2, 0.01, 100.0, one).lines;
  ASSERT_GT(lines.size(), 50u);
  double first = 100.0, last = 0.0;
  for (const SizedLine& line : lines) {
    EXPECT_NEAR(line.size_m, 0.5, 1e-6);
    first = std::min(first, line.a.x);
    last = std::max(last, line.a.x);
  }
  EXPECT_LT(first, 3.0);
  EXPECT_GT(last, 97.0);
}

// A millionth of the extent across, along all of its length; the circles begin with the extent.
TEST(ChannelLines, AreFoundHoweverNarrow) {
  for (const double width : {1.0, 0.1, 0.01}) {
    const double length = 1e4 * width < 2000.0 ? 2000.0 : 1e4 * width;
    Pslg pslg = rectangle(length, width);
    pslg.points.insert(pslg.points.end(), {{2e5, -1e5}, {2e5 + 1, -1e5}, {2e5, 1 - 1e5}});  // another water, far away
    pslg.segments.insert(pslg.segments.end(), {{4, 5, 0, 0, kOutside}, {5, 6, 0, 0, kOutside}, {6, 4, 0, 0, kOutside}});
    const ChannelLines found = channelLines(pslg, 4.0, 0.2, 1e-4, 1e6, one);
    std::array<int, 2> tenths{};  // bits: of the length, along either shore
    for (const SizedLine& line : found.lines)
      if (std::abs(line.size_m - width / 4.0) < 1e-6 * width)
        tenths[line.a.y > 0.5 * width] |= 1 << static_cast<int>(10.0 * line.a.x / length);
    EXPECT_EQ(tenths, (std::array{1023, 1023})) << width;
  }
}

// Edges of half a metre on 200 square metres, two triangles of a quarter of sqrt(3) of their square a vertex.
TEST(ChannelLines, StopWhereTheyAskForMoreThanIsAllowed) {
  const Pslg channel = rectangle(100.0, 2.0);
  const ChannelLines all = channelLines(channel, 4.0, 0.2, 0.01, 100.0, one);
  ASSERT_TRUE(all.complete);
  const double vertices = 200.0 / (0.5 * 0.5 * std::sqrt(3.0) / 2.0);
  EXPECT_NEAR(all.vertices / vertices, 1.0, 0.15);
  const auto lines = static_cast<double>(all.lines.size());
  for (const ChannelRoom& room : {ChannelRoom{0.1 * vertices, 1e9}, ChannelRoom{1e9, 0.1 * lines}}) {
    const ChannelLines some = channelLines(channel, 4.0, 0.2, 0.01, 100.0, one, room);
    EXPECT_FALSE(some.complete);
    EXPECT_LE(static_cast<double>(some.lines.size()), 0.15 * lines);
    EXPECT_NEAR(some.vertices / vertices, 1.0, 0.3);
  }
}

TEST(ChannelLines, BendsOfOneShoreAreNone) {
  // A sea with a toothed shore, its teeth blunt: wide everywhere.
  Pslg pslg;
  for (int i = 0; i <= 40; ++i) pslg.points.push_back({static_cast<double>(i), i % 2 == 0 ? 0.0 : 0.3});
  pslg.points.push_back({40.0, 60.0});
  pslg.points.push_back({0.0, 60.0});
  const auto count = static_cast<VertexId>(pslg.points.size());
  for (VertexId i = 0; i < count; ++i) pslg.segments.push_back({i, (i + 1) % count, 0, 0, kOutside});
  for (const SizedLine& line : channelLines(pslg, 1.0, 0.2, 0.01, 100.0, one).lines) EXPECT_GT(line.size_m, 5.0);
}

TEST(ComposedSizes, ShoreDistanceInThePlane) {
  SizeOptions options;
  options.shore_m = 0.05;
  options.shore_rate = 0.1;
  options.most_m = 0.3;
  const Domain domain = planeDomain(rectangle(20.0, 10.0));
  const auto size = sizesIn(options, domain);
  std::mt19937_64 random(7);
  for (int i = 0; i < 2000; ++i) {
    const Point p{uniform(random, 0.0, 20.0), uniform(random, 0.0, 10.0)};
    const double d = std::min({p.x, p.y, 20.0 - p.x, 10.0 - p.y});
    const double wanted = std::min(0.3, 0.05 + 0.1 * d);
    EXPECT_NEAR(size->at(p) / wanted, 1.0, 0.04) << p.x << ", " << p.y;
  }
}

TEST(ComposedSizes, RoughOnesAreOffByATenthAndSmaller) {
  SizeOptions options;
  options.shore_m = 100.0;
  options.shore_rate = 0.2;
  options.channel_elements = 0.01;  // asks for nothing here, but that is known of a map alone
  const Domain domain = planeDomain(rectangle(10000.0, 6000.0));
  const auto made = [&](SizeAccuracy accuracy) {
    return makeSizeFunction(options, {}, domain, kInfinity, inOrder, accuracy).function;
  };
  const auto rough = made(SizeAccuracy::Rough), fine = made(SizeAccuracy::Fine);
  EXPECT_LE(dynamic_cast<const SizeTree&>(*rough).cells(), dynamic_cast<const SizeTree&>(*fine).cells());
  std::mt19937_64 random(3);
  for (int i = 0; i < 2000; ++i) {
    const Point x{uniform(random, 0.0, 10000.0), uniform(random, 0.0, 6000.0)};
    const double wanted = 100.0 + 0.2 * std::min({x.x, 10000.0 - x.x, x.y, 6000.0 - x.y});
    EXPECT_NEAR(rough->at(x) / wanted, 1.0, 0.15);
  }
}

TEST(ComposedSizes, RoughOnesByTheShoreAloneAreExactAndNoMap) {
  SizeOptions options;
  options.shore_m = 100.0;
  options.shore_rate = 0.2;
  options.least_m = 150.0;
  options.most_m = 600.0;
  Domain domain = planeDomain(rectangle(10000.0, 6000.0));
  domain.pslg.segments[3].tag = kOpenTag;  // the left side
  const auto made = [&](double most_vertices) {
    return makeSizeFunction(options, {}, domain, most_vertices, inOrder, SizeAccuracy::Rough);
  };
  const DomainSizes sizes = made(kInfinity);
  EXPECT_EQ(dynamic_cast<const SizeTree*>(sizes.function.get()), nullptr);
  EXPECT_EQ(sizes.rate, 0.2);
  EXPECT_EQ(sizes.shore_m, 150.0);
  EXPECT_EQ(leastWanted(options, {}), 150.0);
  std::mt19937_64 random(3);
  std::vector<Point> places;
  for (int i = 0; i < 2000; ++i) places.push_back({uniform(random, 0.0, 10000.0), uniform(random, 0.0, 6000.0)});
  std::vector<double> sampled(places.size());
  sizes.function->sample(places, sampled);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Point& x = places[i];
    const double wanted = std::clamp(100.0 + 0.2 * std::min({10000.0 - x.x, x.y, 6000.0 - x.y}), 150.0, 600.0);
    EXPECT_NEAR(sizes.function->at(x) / wanted, 1.0, 1e-9);
    EXPECT_DOUBLE_EQ(sampled[i], sizes.function->at(x));
    EXPECT_LE(sizes.function->least(), wanted);
    EXPECT_GE(sizes.function->most(), wanted);
  }
  // Where the shore may ask for more than there is room for a map finds out, which is made or refused.
  EXPECT_NE(dynamic_cast<const SizeTree*>(made(1000.0).function.get()), nullptr);
  EXPECT_THROW(made(100.0), TooManyVertices);
  options.channel_elements = 2.0;
  EXPECT_EQ(leastWanted(options, {}), 150.0);
  options.least_m = 0.0;
  EXPECT_EQ(leastWanted(options, {}), 0.0);
  EXPECT_TRUE(std::isnan(made(kInfinity).rate));
}

TEST(ComposedSizes, ChannelsHaveTheirElementsAcross) {
  SizeOptions options;
  options.size_m = 0.4;
  options.least_m = 0.001;
  options.channel_elements = 5.0;
  const Domain domain = planeDomain(narrowChannel(0.1));
  const auto size = sizesIn(options, domain);
  double least = kInfinity;
  for (const Point& p : domain.pslg.points) least = std::min(least, size->at(p));
  EXPECT_NEAR(least, 0.02, 0.003);
  EXPECT_GT(size->most(), 0.1);
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

// What it is measured by is then the shore alone, wherever that asks for less.
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

// Against many places of each box, boxes from a hundredth of a pixel to several.
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

// As asked for: in metres, along geodesics. Far from the middle of such a plane the scale is not 1, and changes.
TEST(ComposedSizes, GradedOnTheGround) {
  for (const double rate : {0.05, 0.2, 1.0}) {
    Coastline coast;
    coast.crs = wgs84();
    coast.features.emplace_back();
    coast.features.back().polygons.push_back(
        {{{-60.0, 0.0}, {0.0, -10.0}, {20.0, 50.0}, {-10.0, 75.0}, {-70.0, 60.0}}, {}});
    CleanReport report;
    const Projection projection = Projection::fitted(coast, {0});
    const Domain domain = cleanFeatures(coast, {0}, projection, {}, report);
    SizeOptions options;
    options.shore_m = 20000.0;
    options.shore_rate = rate;
    options.gradation = 0.2;
    const auto size = sizesIn(options, domain, coast.crs);
    const GeographicLib::Geodesic& geodesic = GeographicLib::Geodesic::WGS84();
    std::mt19937_64 random(9);
    double most = 0.0, largest = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const Point a{uniform(random, -50.0, 0.0), uniform(random, 5.0, 60.0)};
      const double reach = std::exp(uniform(random, std::log(1e-3), std::log(20.0)));
      const Point b = a + reach * Point{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)};
      double metres = 0.0;
      geodesic.Inverse(a.y, a.x, b.y, b.x, metres);
      const auto sizeAt = [&](const Point& p) {
        const Point place = projection.forward(p);
        return size->at(place) / projection.scaleAt(place);
      };
      most = std::max(most, std::abs(sizeAt(b) - sizeAt(a)) / metres);
      largest = std::max(largest, sizeAt(a));
    }
    EXPECT_LE(most, 0.2);
    EXPECT_GE(most, 0.8 * std::min(rate, 0.2));
    EXPECT_GT(largest, 20000.0 + 0.8 * std::min(rate, 0.18) * 1e6) << "not graded that much";
  }
}

TEST_F(SizeFiles, SlopesBandsAndTheTimeStep) {
  // 100 m deep in the west, falling by 5 in 100 from x = 5000 on.
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

TEST_F(SizeFiles, FeaturesWithoutSizesAreRefused) {
  std::ofstream(file("f.geojson")) << R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {"name": "x"}, "geometry": {"type": "Point", "coordinates": [3, 4]}}]})";
  std::ofstream(file("g.geojson")) << R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {"size": -3}, "geometry": {"type": "Point", "coordinates": [3, 4]}}]})";
  EXPECT_THROW(readSizedFeatures(file("f.geojson"), {}, 0.2), InputError);
  EXPECT_THROW(readSizedFeatures(file("g.geojson"), {}, 0.2), InputError);
}

// What is asked for is found before it is made, on few cells: none of these may take more than a second or so of any
// machine, which a test cannot tell; that they do not run out of memory it can.
class Demand : public SizeFiles {
 protected:
  // 100 km by 50 km, a lake of 80 km by 30 km in it.
  const Domain domain_ = planeDomain([] {
    Pslg pslg = rectangle(80e3, 30e3);
    for (Point& p : pslg.points) p = p + Point{10e3, 10e3};
    return pslg;
  }());
  std::string pixels(double there) {
    return raster("a.tif", 20, 10, {0.0, 5e3, 0.0, 50e3, 0.0, -5e3}, 0, [=](double x, double y) {
      return std::abs(x - 47.5e3) < 1.0 && std::abs(y - 22.5e3) < 1.0 ? there : 5e3;
    });
  }
  VertexDemand refused(const SizeOptions& options, double most_vertices) {
    try {
      makeSizeFunction(options, readSizeInputs(options, {}), domain_, most_vertices, inOrder);
    } catch (const TooManyVertices& error) {
      EXPECT_GT(error.demand.vertices, most_vertices);
      return error.demand;
    }
    ADD_FAILURE() << "was not refused";
    return {};
  }
};

TEST_F(Demand, OfOnePixel) {
  SizeOptions options;
  options.rasters = {pixels(1.0)};
  const double needed = 2.0 / std::sqrt(3.0) * 25e6;
  for (const double most : {2e4, 1e6}) {
    const VertexDemand demand = refused(options, most);
    EXPECT_NEAR(std::log(demand.vertices / needed), 0.0, std::log(3.0)) << most;
    EXPECT_EQ(demand.option, "--size-raster");
    EXPECT_NEAR(demand.size_m, 1.0, 1e-6);
    EXPECT_NEAR(demand.place.x, 47.5e3, 2.5e3);
    EXPECT_NEAR(demand.place.y, 22.5e3, 2.5e3);
  }
  options.rasters = {pixels(1e-38)};
  refused(options, 1e9);
  // What it asks for with a bound it gets: nothing is refused that there is room for.
  options.least_m = 100.0;
  const DomainSizes sizes = makeSizeFunction(options, readSizeInputs(options, {}), domain_, 2e4, inOrder);
  EXPECT_GT(sizes.demand.vertices, 2500.0);
  EXPECT_NEAR(sizes.function->at({47.5e3, 22.5e3}), 100.0, 1.0);
}

TEST_F(Demand, OfExtremes) {
  const auto with = [](auto&& set) {
    SizeOptions options;
    set(options);
    return options;
  };
  const std::vector<std::pair<std::string, SizeOptions>> cases = {
      {"--size", with([](SizeOptions& o) { o.size_m = 1e-3; })},
      {"--size", with([](SizeOptions& o) { o.size_m = 1e-300; })},
      {"--size-shore", with([](SizeOptions& o) { o.shore_m = 1e-3; })},
      {"--size-shore", with([](SizeOptions& o) { o.shore_m = 1e-300; })},
      {"--size-max", with([](SizeOptions& o) {
         o.shore_m = 5.0;
         o.most_m = 1e-3;
       })},
      {"--size-min", with([](SizeOptions& o) {
         o.shore_m = 1e-300;
         o.shore_rate = 0.0;
         o.least_m = 1e-2;
       })},
      {"--channel-elements", with([](SizeOptions& o) {
         o.channel_elements = 1e5;
         o.least_m = 1e-3;
       })},
  };
  for (const auto& [option, options] : cases) {
    for (const double most : {3e3, 1e6}) EXPECT_EQ(refused(options, most).option, option) << most;
  }
  SizeOptions waves;
  waves.bathymetry = {pixels(-100.0)};
  for (const double elements : {1e9, 1e308}) {
    waves.depth.wave_elements = elements;
    EXPECT_EQ(refused(waves, 3e3).option, "--wave-elements");
  }
}

// A place that is so small that nothing can be told apart there asks for few vertices all the same.
TEST_F(Demand, SizesBelowWhatCoordinatesTellApartAreRefused) {
  std::ofstream(file("p.geojson"))
      << R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"size":1e-300},
    "geometry":{"type":"Point","coordinates":[50000,25000]}}]})";
  SizeOptions options;
  options.size_m = 1e3;
  options.features = {file("p.geojson")};
  EXPECT_THROW(makeSizeFunction(options, readSizeInputs(options, {}), domain_, 1e6, inOrder), InputError);
  options.least_m = 0.1;
  EXPECT_NO_THROW(makeSizeFunction(options, readSizeInputs(options, {}), domain_, 1e6, inOrder));
}

TEST_F(Demand, IsTheIntegralOverTheDomain) {
  SizeOptions options;
  options.shore_m = 200.0;
  options.shore_rate = 0.1;
  options.most_m = 1500.0;
  const DomainSizes sizes = makeSizeFunction(options, readSizeInputs(options, {}), domain_, kInfinity, inOrder);
  // By the midpoint rule on squares of 20 m.
  double sum = 0.0;
  for (double x = 10e3 + 10.0; x < 90e3; x += 20.0)
    for (double y = 10e3 + 10.0; y < 40e3; y += 20.0) {
      const double h = sizes.function->at({x, y});
      sum += 2.0 / std::sqrt(3.0) * 400.0 / h / h;
    }
  EXPECT_NEAR(sizes.demand.vertices / sum, 1.0, 0.1);
}

// A graph that says with its holes what is inside.
TEST_F(Demand, OfAnUnlabelledGraph) {
  Pslg pslg = rectangle(10.0, 10.0);
  const Pslg island = rectangle(8.0, 8.0);
  for (const Point& p : island.points) pslg.points.push_back(p + Point{1.0, 1.0});
  for (const Segment& s : island.segments) pslg.segments.push_back({s.a + 4, s.b + 4});
  for (Segment& s : pslg.segments) s.left = s.right = kUnlabelled;
  pslg.holes = {{5.0, 5.0}};
  SizeOptions options;
  options.size_m = 0.1;
  const DomainSizes sizes =
      makeSizeFunction(options, readSizeInputs(options, {}), planeDomain(pslg), kInfinity, inOrder);
  EXPECT_NEAR(sizes.demand.vertices, 36.0 * 2.0 / std::sqrt(3.0) / 0.01, 400.0);
}

}  // namespace
}  // namespace coastmesh
