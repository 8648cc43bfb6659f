// Crests of weirs from rasters of made levees: against their crests, which are known.
#include "gis/weirs/raster_crests.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "gis/crs/crs.hpp"
#include "gis/error.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/weirs/open_weirs.hpp"
#include "tests/gis/check/target_samples.hpp"
#include "tests/support/rasters.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::kNoValue;
using testing::RasterShape;
using testing::TemporaryFolder;
using testing::writeRaster;

constexpr const char* kUtm = "EPSG:32631";
constexpr double kY = 4 * 866.0;  // of the line, which runs from x = 0 to 4000, a node each 1000 m
constexpr double kPixel = 5.0;

using Height = std::function<double(double x)>;

// Within 100 m of the line, which lies 12 m south of a levee whose flat crest is two pixels wide, over ground at 1 m.
double leveeAt(double x, double y, const Height& crest) {
  const double off = std::abs(y - (kY + 12.0));
  return off <= kPixel ? crest(x) : std::max(1.0, crest(x) - 0.4 * (off - kPixel));
}

class RasterCrestsTest : public ::testing::Test {
 protected:
  RasterCrestsTest() : grid_(testing::soundGrid(false)) {
    grid_.crs = parseCrs(kUtm);
    for (Point& p : grid_.nodes) p.x += kEast;
    add({at(2, 4), at(3, 4), at(4, 4), at(5, 4), at(6, 4)});
  }

  static constexpr double kEast = 500000.0;
  static std::uint32_t at(int i, int j) { return static_cast<std::uint32_t>(j * 9 + i); }

  void add(const std::vector<std::uint32_t>& nodes, WeirCrest crest = {}) {
    const std::string name = "w" + std::to_string(sources_.size());
    std::vector<Point> points;
    for (const std::uint32_t node : nodes) points.push_back(grid_.nodes[node]);
    grid_.lines.push_back(lineOfNodes(LineKind::Weir, name, nodes));
    sources_.push_back({name, {points}, crest, "'levees.gpkg', feature " + std::to_string(sources_.size())});
  }

  // `value` takes x from the line's first node.
  std::string raster(const std::string& name, const std::function<double(double x, double y)>& value,
                     double from = -200.0, double to = 4200.0, double pixel = kPixel) const {
    const RasterShape shape{static_cast<int>((to - from) / pixel), static_cast<int>(200.0 / pixel), kEast + from,
                            kY + 100.0, pixel};
    writeRaster(folder_ / name, kUtm, shape, [&](double x, double y) { return value(x - kEast, y); });
    return folder_ / name;
  }
  std::string levee(const Height& crest) const {
    return raster("levee.tif", [&](double x, double y) { return leveeAt(x, y, crest); });
  }

  RasterCrests found(const std::vector<std::string>& files, double search_m = 30.0, double zero_m = 0.0) const {
    return findRasterCrests(grid_, sources_, {files, search_m, zero_m}, {});
  }
  // Of the only weir: heights of its pairs, from its first.
  std::vector<double> heights(const RasterCrests& crests) {
    Grid grid = grid_;
    report_ = openWeirs(grid, sources_, 30.0, inOrder, crests);
    std::vector<double> all;
    for (const Boundary& boundary : grid.boundaries)
      for (std::size_t i = 0; i < boundary.weir.size(); i += 3) all.push_back(boundary.weir[i]);
    return all;
  }

  TemporaryFolder folder_;
  Grid grid_;
  std::vector<WeirSource> sources_;
  WeirReport report_;
};

// From 5 m it falls by 1 m each kilometre: the lowest crest of a pair is half an edge behind it.
TEST_F(RasterCrestsTest, AreTheLowestUpToHalfWayToTheNextNodes) {
  const RasterCrests crests = found({levee([](double x) { return 5.0 - 0.001 * x; })});
  EXPECT_THAT(crests.warnings, IsEmpty());
  ASSERT_EQ(crests.of_edges.size(), 4u);
  for (int i = 2; i < 6; ++i) {
    const auto& [first, second] = crests.of_edges.at(edgeKey(at(i, 4), at(i + 1, 4)));
    EXPECT_NEAR(first, 5.0 - (i - 2 + 0.5), 0.01);
    EXPECT_NEAR(second, 5.0 - (i - 1), 0.01);
  }
  const std::vector<double> pairs = heights(crests);
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_NEAR(pairs[0], 3.5, 0.01);
  EXPECT_NEAR(pairs[1], 2.5, 0.01);
  EXPECT_NEAR(pairs[2], 2.0, 0.01);  // water does not pass the edge behind it
  EXPECT_THAT(report_.warnings, IsEmpty());
  EXPECT_THAT(crests.notes, ElementsAre(HasSubstr("the highest terrain within 30 m of their lines")));
}

TEST_F(RasterCrestsTest, AreAboveTheZeroOfDepths) {
  const std::string file = levee([](double) { return 5.0; });
  EXPECT_THAT(heights(found({file})), ElementsAre(5, 5, 5));
  EXPECT_THAT(heights(found({file}, 30.0, 0.75)), ElementsAre(4.25, 4.25, 4.25));
}

// The levee's crest is 7 to 17 m away.
TEST_F(RasterCrestsTest, AreSoughtWithinADistance) {
  const std::string file = levee([](double) { return 5.0; });
  EXPECT_THAT(heights(found({file}, 12.0)), ElementsAre(5, 5, 5));
  const RasterCrests on_slope = found({file}, 0.0);
  for (const double height : heights(on_slope)) EXPECT_LT(height, 4.0);
  // A hill 70 m away is no levee.
  const std::string hill = raster(
      "hill.tif", [](double x, double y) { return y < kY - 70.0 ? 40.0 : leveeAt(x, y, [](double) { return 5.0; }); });
  EXPECT_THAT(heights(found({hill})), ElementsAre(5, 5, 5));
  EXPECT_THAT(heights(found({hill}, 80.0)), ElementsAre(40, 40, 40));
}

TEST_F(RasterCrestsTest, HaveGapsBetweenNodes) {
  // 20 m wide, 200 m beyond the pair in the middle.
  const auto crest = [](double x) { return std::abs(x - 2200.0) < 10.0 ? 2.0 : 5.0; };
  const RasterCrests crests = found({levee(crest)});
  EXPECT_THAT(heights(crests), ElementsAre(5, 2, 5));
  EXPECT_THAT(crests.warnings, ElementsAre(::testing::AllOf(
                                   HasSubstr("drop by more than 1 m below their mean along half an edge, 1 time, "
                                             "the most to 2 m where the mean is 4.91 m, in 'levees.gpkg', "
                                             "feature 0 at (50219"),
                                   HasSubstr(": water passes there"))));
  // Of one pixel there is none: pixels of a narrow crest may touch at corners only.
  EXPECT_THAT(heights(found({levee([](double x) { return std::abs(x - 2202.5) < 2.0 ? 2.0 : 5.0; })})),
              ElementsAre(5, 5, 5));
}

// A wall of single pixels that touch at their corners, along a line across the rows.
TEST_F(RasterCrestsTest, OfAWallAcrossThePixelsHaveNoGaps) {
  grid_.lines.clear();
  sources_.clear();
  add({at(3, 3), at(4, 4), at(5, 5)});
  const Point from = grid_.nodes[at(3, 3)], to = grid_.nodes[at(5, 5)];
  const std::string file = folder_ / "wall.tif";
  for (const double shift : {0.0, 1.2, 3.7}) {
    const RasterShape shape{500, 800, from.x - 500.0, to.y + 500.0, kPixel};
    const double slope = (to.x - from.x) / (to.y - from.y);
    writeRaster(file, kUtm, shape, [&](double x, double y) {
      return std::abs(x - (from.x + shift + slope * (y - from.y))) <= 0.5 * kPixel ? 6.0 : 0.0;
    });
    const RasterCrests crests = found({file}, 10.0);
    EXPECT_THAT(crests.warnings, IsEmpty()) << shift;
    for (const auto& [edge, halves] : crests.of_edges) EXPECT_THAT(halves, ElementsAre(6, 6)) << shift;
    EXPECT_EQ(crests.of_edges.size(), 2u);
  }
}

// The mesh's edge cuts a bend of the line: the terrain is sought along the line.
TEST_F(RasterCrestsTest, AreThoseAlongTheLineNotTheEdge) {
  const auto lineAt = [](double x) { return kY + 60.0 * std::max(0.0, 1.0 - std::abs(x - 2500.0) / 400.0); };
  std::vector<Point>& points = sources_[0].lines[0];
  points = {{kEast, kY}, {kEast + 2100, kY}, {kEast + 2500, kY + 60}, {kEast + 2900, kY}, {kEast + 4000, kY}};
  const std::string file =
      raster("bend.tif", [&](double x, double y) { return std::abs(y - lineAt(x) - 12.0) <= kPixel ? 5.0 : 1.0; });
  EXPECT_THAT(heights(found({file}, 20.0)), ElementsAre(5, 5, 5));
}

TEST_F(RasterCrestsTest, OfTheFirstRasterWithAValue) {
  const std::string coarse = raster(
      "coarse.tif", [](double, double) { return 4.5; }, -200, 4200, 40.0);
  const std::string fine = raster(
      "fine.tif", [](double x, double y) { return leveeAt(x, y, [](double) { return 5.0; }); }, 1200.0, 4200.0);
  const RasterCrests crests = found({fine, coarse});
  EXPECT_THAT(crests.warnings, IsEmpty());
  EXPECT_THAT(heights(crests), ElementsAre(4.5, 5, 5));
  EXPECT_THAT(heights(found({coarse, fine})), ElementsAre(4.5, 4.5, 4.5));
}

TEST_F(RasterCrestsTest, WithoutAValueLeaveEdges) {
  // Water without heights beside the levee is no gap, and a hole of 30 m across it is one that a warning names.
  const std::string holes = raster("holes.tif", [](double x, double y) {
    if (y < kY || std::abs(x - 2200.0) < 15.0) return kNoValue;
    return leveeAt(x, y, [](double) { return 5.0; });
  });
  const RasterCrests crests = found({holes});
  EXPECT_THAT(heights(crests), ElementsAre(5, 5, 5));
  EXPECT_THAT(crests.warnings,
              ElementsAre(HasSubstr("no raster of --weir-heights has a value within 30 m of weirs at 5 places along "
                                    "them, the first of 'levees.gpkg', feature 0 at (5021")));
  // The last edge is beyond the raster.
  const std::string part = raster(
      "part.tif", [](double x, double y) { return leveeAt(x, y, [](double) { return 5.0; }); }, -200.0, 3400.0);
  const RasterCrests of_part = found({part});
  EXPECT_EQ(of_part.of_edges.size(), 3u);
  EXPECT_THAT(of_part.warnings,
              ElementsAre(::testing::AllOf(HasSubstr("weir 'w0' ('levees.gpkg', feature 0) from "),
                                           HasSubstr(" stays edges of the mesh along 1 of its 4, at (50340"))));
  EXPECT_THAT(heights(of_part), ElementsAre(5, 5));
  EXPECT_THAT(report_.warnings, IsEmpty());
  // All of it.
  const std::string far = raster(
      "far.tif", [](double, double) { return 5.0; }, 5000.0, 6000.0);
  const RasterCrests none = found({far});
  EXPECT_THAT(none.warnings, ElementsAre(HasSubstr(" stays edges of the mesh, at (500")));
  EXPECT_THAT(heights(none), IsEmpty());
}

TEST_F(RasterCrestsTest, AreForWeirsWithoutAHeight) {
  add({at(2, 6), at(3, 6), at(4, 6), at(5, 6)}, WeirCrest{2.5, 0.9, 0.8});
  const std::string file = levee([](double) { return 5.0; });
  const RasterCrests crests = found({file});
  EXPECT_EQ(crests.of_edges.size(), 4u);
  EXPECT_THAT(heights(crests), ElementsAre(5, 5, 5, 2.5, 2.5));
  sources_[0].crest.height_m = 4.0;
  EXPECT_THAT(found({file}).warnings,
              ElementsAre("--weir-heights has no effect: every weir in the mesh has a height of its own"));
  // Nobody asks for rasters.
  EXPECT_THAT(found({}).warnings, IsEmpty());
}

// Where two lines meet the lower crest of both counts, as it does within one; coefficients are those of its line.
TEST_F(RasterCrestsTest, OfLinesThatRunOnAreTheLower) {
  grid_.lines.clear();
  sources_.clear();
  add({at(2, 4), at(3, 4), at(4, 4)}, WeirCrest{std::nullopt, 0.9, 0.8});
  add({at(4, 4), at(5, 4), at(6, 4)});
  const RasterCrests crests = found({levee([](double x) { return x < 2000.0 ? 4.5 : 5.0; })});
  Grid grid = grid_;
  openWeirs(grid, sources_, 30.0, inOrder, crests);
  EXPECT_THAT(grid.boundaries.back().weir, ElementsAre(4.5, 0.9, 0.8, 4.5, 0.9, 0.8, 5, 1, 1));
}

TEST_F(RasterCrestsTest, BesideTheLeveeAreWarnedOf) {
  const RasterCrests crests = found({levee([](double) { return 9.0; })}, 8.0);
  EXPECT_THAT(crests.warnings, IsEmpty());  // too few pixels to tell
  const std::string slope = raster("slope.tif", [](double, double y) { return 2.0 + 0.05 * (y - kY + 100.0); });
  EXPECT_THAT(found({slope}).warnings,
              ElementsAre(HasSubstr("along most of it the terrain is highest 30 m away, where the search ends")));
}

TEST_F(RasterCrestsTest, NumbersThatMeanNoValueAreRefused) {
  const std::string file = raster("bad.tif", [](double x, double) { return x > 1000.0 ? 3.4e38 : 5.0; });
  EXPECT_THAT([&] { found({file}); }, ::testing::ThrowsMessage<InputError>(::testing::AllOf(
                                          HasSubstr("bad.tif' has a height of 3.4e+38 m at a weir, near (50"),
                                          HasSubstr("gdal_translate -a_nodata"))));
  const std::string low = raster("low.tif", [](double, double y) { return y < kY ? 5.0 : -32768.0; });
  EXPECT_THAT([&] { found({low}); }, ::testing::ThrowsMessage<InputError>(HasSubstr(" a height of -32768 m")));
}

// Distances are metres on the ground where coordinates are degrees, at any turn, and the raster is in another CRS.
TEST_F(RasterCrestsTest, AreFoundFromDegrees) {
  const double metre = 1.0 / 111320.0;
  grid_.crs = wgs84();
  for (Point& p : grid_.nodes) p = {3.0 + 2.0 * metre * (p.x - kEast), 60.0 + metre * (p.y - kY)};
  for (Point& p : sources_[0].lines[0]) p = {363.0 + 2.0 * metre * (p.x - kEast), 60.0 + metre * (p.y - kY)};
  const std::string file = folder_ / "levee.tif";
  // On the central meridian, where the line is at its northing: from PROJ, of 3 E 60 N.
  constexpr double kNorthing = 6651411.190;
  const RasterShape shape{900, 50, kEast - 200.0, kNorthing + 125.0, kPixel};
  writeRaster(file, kUtm, shape,
              [&](double, double y) { return std::abs(y - (kNorthing + 22.0)) <= kPixel ? 5.0 : 1.0; });
  const RasterCrests crests = found({file});
  ASSERT_EQ(crests.of_edges.size(), 4u);
  for (const auto& [edge, halves] : crests.of_edges) EXPECT_THAT(halves, ElementsAre(5, 5));
  for (const auto& [edge, halves] : found({file}, 8.0).of_edges) EXPECT_THAT(halves, ElementsAre(1, 1));
}

}  // namespace
}  // namespace coastmesh
