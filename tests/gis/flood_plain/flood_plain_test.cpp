// The low land beside the water, from rasters, and the domain that it makes.
#include "gis/flood_plain/flood_plain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/metric.hpp"
#include "gis/clean/clean.hpp"
#include "gis/clean/geodesic_area.hpp"
#include "gis/coast/flood_plains.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/error.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/framed_coasts.hpp"
#include "tests/support/gis_shapes.hpp"
#include "tests/support/rasters.hpp"

namespace coastmesh {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::kNoValue;
using ::testing::Not;
using testing::TemporaryFolder;
using testing::writeRaster;

constexpr double kLimit = 5.0, kHigh = 20.0, kLow = 1.0;

// Water in the west of a frame from (0, 0) to (100, 60) of a plane, land from x = 50 on. Heights have pixels of one
// unit.
class FloodPlainTest : public ::testing::Test {
 protected:
  using Height = std::function<double(double x, double y)>;

  std::string raster(const std::string& name, double west, double east, const Height& height) const {
    writeRaster(folder_ / name, "", {static_cast<int>(east - west), 60, west, 60.0, 1.0}, height);
    return folder_ / name;
  }
  std::string raster(const Height& height) const { return raster("dem.tif", 0.0, 100.0, height); }

  // The domain with the plain.
  Domain domainOf(std::vector<std::string> rasters, const CleanOptions& cleaning = {.snap_m = 0.0}) {
    return domainOf(std::move(rasters), {polygonFeature(1, {{50, -10}, {150, -10}, {150, 70}, {50, 70}})},
                    boxOf(0, 0, 100, 60, DomainSide::Outside), cleaning);
  }
  Domain domainOf(std::vector<std::string> rasters, std::vector<Feature> features, const FrameOptions& options,
                  const CleanOptions& cleaning = {.snap_m = 0.0}) {
    Framed framed = frame(coastlineOf(std::move(features)), options);
    FloodOptions flood;
    flood.height_m = kLimit;
    flood.heights.files = std::move(rasters);
    FloodPlain plain = floodPlainOf(framed.coastline, framed.domains, flood);
    notes_ = plain.notes;
    for (Feature& feature : plain.features) framed.coastline.features.push_back(std::move(feature));
    CleanReport report;
    Domain domain =
        cleanFeatures(framed.coastline, allMembers(framed.coastline), Projection::plane(), cleaning, report);
    for (const Edit& edit : report.edits) EXPECT_EQ(edit.kind, EditKind::SmallIsland);
    return domain;
  }
  static double areaOf(const Domain& domain) { return geodesicArea(domain, Crs{}); }
  // The length of segments whose tag `holds`.
  template <typename Holds>
  static double lengthOf(const Domain& domain, const Holds& holds) {
    double length = 0.0;
    for (const Segment& s : domain.pslg.segments)
      if (holds(s.tag)) length += distance(domain.pslg.points[s.a], domain.pslg.points[s.b]);
    return length;
  }

  TemporaryFolder folder_;
  std::vector<std::string> notes_;
};

TEST_F(FloodPlainTest, ASlopeUpToItsContour) {
  const Domain domain = domainOf({raster([](double x, double) { return 0.5 * (x - 50.0); })});  // 5 at x = 60
  EXPECT_NEAR(areaOf(domain), 60.0 * 60.0, 1e-6);
  EXPECT_NEAR(lengthOf(domain, isOpenTag), 60.0 + 2.0 * 60.0, 1e-6);  // sides of the frame cross the land too
  EXPECT_NEAR(lengthOf(domain, isLineTag), 60.0, 1e-6);               // the coast
  ASSERT_EQ(domain.lines.size(), 1u);
  EXPECT_EQ(domain.lines.front().name, kFloodedCoast);
  for (const Segment& s : domain.pslg.segments) {
    if (isLineTag(s.tag)) {
      EXPECT_EQ(s.left, s.right);
    }
  }
  EXPECT_THAT(notes_, Not(Contains(HasSubstr("stays out"))));
}

TEST_F(FloodPlainTest, APolderBehindARidgeStaysOut) {
  const auto height = [](double x, double y) {
    const double off = std::max(std::abs(x - 75.0), std::abs(y - 30.0));  // a ridge from 5 to 8 off the middle
    return x > 95.0 || (off > 5.0 && off < 8.0) ? kHigh : kLow;
  };
  const Domain domain = domainOf({raster(height)});
  // The contour lies between centres of pixels at the share of the height.
  const double share = (kLimit - kLow) / (kHigh - kLow) - 0.5;
  const double hole = 2.0 * (8.0 - share);
  EXPECT_NEAR(areaOf(domain), (95.0 + share) * 60.0 - hole * hole, 2.0);  // corners are cut
  EXPECT_THAT(notes_, Contains(HasSubstr("100 of low land in 1 part without a connection")));
  EXPECT_THAT(notes_, Contains(HasSubstr("stays out")));
}

TEST_F(FloodPlainTest, LandBehindAGapBelongs) {
  const auto height = [](double gap) {
    return [gap](double x, double y) { return x > 60.0 && x < 63.0 && std::abs(y - 30.0) > gap ? kHigh : kLow; };
  };
  EXPECT_GT(areaOf(domainOf({raster(height(2.0))})), 5700.0);
  EXPECT_LT(areaOf(domainOf({raster(height(0.0))})), 3700.0);
}

TEST_F(FloodPlainTest, AnIslandOfHighLand) {
  const auto height = [](double x, double y) {
    return std::max(std::abs(x - 75.0), std::abs(y - 30.0)) < 4.0 ? kHigh : kLow;
  };
  const std::string dem = raster(height);
  const double with = areaOf(domainOf({dem}));
  const double side = 2.0 * (4.5 - (kLimit - kLow) / (kHigh - kLow));
  EXPECT_NEAR(with, 6000.0 - side * side, 2.0);
  EXPECT_NEAR(areaOf(domainOf({dem}, {.snap_m = 0.0, .min_island_area_m2 = 30.0})), with, 1e-9);
  EXPECT_NEAR(areaOf(domainOf({dem}, {.snap_m = 0.0, .min_island_area_m2 = 100.0})), 6000.0, 1e-6);
}

TEST_F(FloodPlainTest, LandWithoutAHeightStaysOut) {
  const Domain domain = domainOf({raster([](double x, double) { return x > 70.0 ? kNoValue : kLow; })});
  EXPECT_NEAR(areaOf(domain), 70.0 * 60.0, 1e-6);
}

TEST_F(FloodPlainTest, WaterIsWaterWhateverItsHeight) {
  const auto height = [](double x, double) { return x < 30.0 ? kHigh : x < 50.0 ? kNoValue : x < 70.0 ? kLow : kHigh; };
  const double share = (kLimit - kLow) / (kHigh - kLow) - 0.5;
  EXPECT_NEAR(areaOf(domainOf({raster(height)})), (70.0 + share) * 60.0, 1e-6);
}

TEST_F(FloodPlainTest, TheFirstRasterWithAValueCounts) {
  const std::string west = raster("west.tif", 0.0, 70.0, [](double, double) { return kLow; });
  const std::string all = raster([](double x, double) { return x < 80.0 ? kLow : kHigh; });
  const std::string high = raster("high.tif", 0.0, 100.0, [](double, double) { return kHigh; });
  const double share = (kLimit - kLow) / (kHigh - kLow) - 0.5;
  EXPECT_NEAR(areaOf(domainOf({west, all})), (80.0 + share) * 60.0, 1e-6);
  EXPECT_NEAR(areaOf(domainOf({west, high})), (70.0 + share) * 60.0, 1e-6);
  EXPECT_NEAR(areaOf(domainOf({high, west})), 50.0 * 60.0, 1e-6);
}

TEST_F(FloodPlainTest, BesideAPolygonOfWater) {
  const auto height = [](double x, double) { return 0.5 * (x - 50.0); };
  FrameOptions inside;
  inside.side = DomainSide::Inside;
  const Domain domain =
      domainOf({raster(height)}, {polygonFeature(1, {{10, 10}, {50, 10}, {50, 50}, {10, 50}})}, inside);
  EXPECT_NEAR(areaOf(domain), 60.0 * 60.0, 1.0);  // where the raster has heights, but for its corners
  EXPECT_NEAR(lengthOf(domain, isLineTag), 160.0, 1e-6);
}

TEST_F(FloodPlainTest, CellsOfARasterInAnotherCrs) {
  // Land from longitude 3.01 on; heights in the Transverse Mercator plane of that zone.
  writeRaster(folder_ / "utm.tif", "EPSG:32631", {400, 400, 490'000.0, 5'580'000.0, 100.0},
              [](double x, double) { return x < 505'000.0 ? kLow : kHigh; });
  Coastline coastline =
      coastlineOf({polygonFeature(1, {{3.01, 50.0}, {3.5, 50.0}, {3.5, 50.4}, {3.01, 50.4}})}, wgs84());
  Framed framed = frame(std::move(coastline), boxOf(2.95, 50.1, 3.15, 50.2, DomainSide::Outside));
  FloodOptions flood;
  flood.height_m = kLimit;
  flood.heights.files = {folder_ / "utm.tif"};
  const FloodPlain plain = floodPlainOf(framed.coastline, framed.domains, flood);
  double west = 180.0, east = -180.0;  // in the middle of the frame
  for (const Feature& feature : plain.features)
    for (const Point& p : feature.polygons.front().outer) {
      if (std::abs(p.y - 50.15) > 0.02) continue;
      west = std::min(west, p.x);
      east = std::max(east, p.x);
    }
  // 5 km east of the zone's middle, on the ellipsoid: 5000 / (0.9996 N cos 50.15 degrees).
  const double expected =
      3.0 + 5000.0 / (0.9996 * 6'390'750.0 * std::cos(50.15 * std::numbers::pi / 180.0)) * 180.0 / std::numbers::pi;
  constexpr double kPixel = 0.0015;  // degrees
  EXPECT_NEAR(east, expected, kPixel);
  EXPECT_LT(west, 3.01);  // it reaches into the water
  EXPECT_GT(west, 3.01 - 2.0 * kPixel);
}

TEST_F(FloodPlainTest, RastersThatLieElsewhereAreRefused) {
  const std::string elsewhere = raster("far.tif", 1000.0, 1100.0, [](double, double) { return kLow; });
  try {
    domainOf({elsewhere});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no raster of --bathymetry has a value in 0,0,100,60"));
  }
}

}  // namespace
}  // namespace coastmesh
