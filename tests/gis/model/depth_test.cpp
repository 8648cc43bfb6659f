// Depths at nodes from rasters whose values are known functions of the place.
#include "gis/model/depth.hpp"

#include <gdal.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gis/error.hpp"
#include "gis/projection/projection.hpp"
#include "gis/rounded_depth.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/item_loops.hpp"
#include "tests/support/rasters.hpp"

namespace coastmesh {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::kNoValue;
using testing::lattice;
using testing::RasterShape;
using testing::TemporaryFolder;
using testing::writeRaster;

// Squares of two triangles each, with corners at `origin` and `size` apart.
Grid squares(const std::string& crs, Point origin, double size, int columns, int rows) {
  const TriMesh mesh = lattice(
      columns, rows, [](int, int) { return true; },
      [&](int i, int j) {
        return Point{origin.x + size * i, origin.y + size * j};
      });
  Grid grid;
  grid.crs = parseCrs(crs);
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  grid.boundaries = findBoundaries(mesh);
  return grid;
}

double slope(double x, double y) { return -50.0 + 3.0 * x - 2.0 * y; }

class Depth : public ::testing::Test {
 protected:
  std::string raster(const std::string& name, const std::string& crs, const RasterShape& shape,
                     const std::function<double(double, double)>& value) {
    writeRaster(folder_ / name, crs, shape, value);
    return folder_ / name;
  }

  TemporaryFolder folder_;
};

TEST_F(Depth, BilinearIsExactOnAPlane) {
  Grid grid = squares("EPSG:4326", {10.03, 50.07}, 0.31, 7, 5);
  const DepthReport report =
      setDepths(grid, {{raster("dem.tif", "EPSG:4326", {40, 40, 9.0, 53.0, 0.1}, slope)}, DepthMethod::Bilinear});
  for (std::size_t i = 0; i < grid.nodes.size(); ++i)
    EXPECT_NEAR(grid.z[i], slope(grid.nodes[i].x, grid.nodes[i].y), 0.51e-6);
  EXPECT_THAT(report.nodes_of_file, ElementsAre(grid.nodes.size()));
  EXPECT_EQ(report.filled + report.unknown + report.partial, 0u);
}

// The raster covers the west of the mesh.
TEST_F(Depth, NodesBesideTheRasterKeepWhatTheyHave) {
  const std::string file = raster("dem.tif", "EPSG:4326", {10, 40, 9.0, 53.0, 0.1}, slope);
  Grid grid = squares("EPSG:4326", {9.23, 50.07}, 0.31, 7, 5);
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) grid.z.push_back(-1000.0 - static_cast<double>(i));
  grid.z[7] = std::numeric_limits<double>::quiet_NaN();  // in the east: must be filled
  const std::vector<double> before = grid.z;
  const DepthReport report = setDepths(grid, {.files = {file}, .keep_known = true});
  std::size_t kept = 0;
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
    if (grid.nodes[i].x < 9.95) {
      EXPECT_NEAR(grid.z[i], slope(grid.nodes[i].x, grid.nodes[i].y), 1e-9);
    }
    if (grid.nodes[i].x < 10.0 || i == 7) continue;
    EXPECT_EQ(grid.z[i], before[i]);
    ++kept;
  }
  EXPECT_EQ(report.kept, kept);
  EXPECT_EQ(report.filled, 1u);
  EXPECT_THAT(report.warnings, Contains(HasSubstr(std::to_string(kept) + " of 48 nodes, which keep the depths")));
}

TEST_F(Depth, ZeroEverywhereIsNoDepth) {
  Grid grid = squares("EPSG:4326", {9.23, 50.07}, 0.31, 2, 2);
  EXPECT_FALSE(hasDepths(grid));
  grid.z.assign(grid.nodes.size(), 0.0);
  EXPECT_FALSE(hasDepths(grid));
  grid.z[3] = 0.5;
  EXPECT_TRUE(hasDepths(grid));
  grid.z.assign(grid.nodes.size(), std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(hasDepths(grid));
}

// A value that stands for missing depths, which the raster does not declare.
TEST_F(Depth, ThatEarthDoesNotHaveAreWarnedOf) {
  const auto warningsOf = [&](double value, bool positive_down) {
    Grid grid = squares("EPSG:4326", {10.03, 50.07}, 0.31, 7, 5);
    const auto odd = [&](double x, double y) { return std::hypot(x - 11.0, y - 51.0) < 0.3 ? value : -20.0; };
    const std::string path = raster("dem.tif", "EPSG:4326", {40, 40, 9.0, 53.0, 0.1}, odd);
    const GDALDatasetH dataset = GDALOpen(path.c_str(), GA_Update);
    EXPECT_EQ(GDALDeleteRasterNoDataValue(GDALGetRasterBand(dataset, 1)), CE_None);
    GDALClose(dataset);
    DepthOptions options{{path}, DepthMethod::Bilinear};
    options.positive_down = positive_down;
    std::string all;
    for (const std::string& warning : setDepths(grid, options).warnings) all += warning;
    return all;
  };
  EXPECT_NE(warningsOf(-32767.0, false).find("gdal_translate -a_nodata -32767)"), std::string::npos);
  EXPECT_NE(warningsOf(-32767.0, false).find("such as 32767 m at ("), std::string::npos);
  EXPECT_NE(warningsOf(99999.0, true).find("gdal_translate -a_nodata 99999)"), std::string::npos);
  EXPECT_NE(warningsOf(-9999.0, false).find("the value -9999, which often means none, the first at ("),
            std::string::npos);
  EXPECT_NE(warningsOf(-9999.0, false).find("gdal_translate -a_nodata -9999)"), std::string::npos);
  EXPECT_EQ(warningsOf(-9998.0, false), "");
  EXPECT_EQ(warningsOf(-10900.0, false), "");
  EXPECT_EQ(warningsOf(8848.0, false), "");
}

// Three tiles of the raster, two of them with enough nodes for a separate reader; a part of the raster has no values
// and gets the depths of other nodes.
TEST_F(Depth, SameInAnyOrder) {
  const auto withGap = [](double x, double y) { return x > 11.0 && y > 51.0 ? kNoValue : slope(x, y); };
  const std::string file = raster("dem.tif", "EPSG:4326", {1600, 1600, 9.0, 53.0, 0.0025}, withGap);
  const Grid without = squares("EPSG:4326", {9.2, 49.2}, 0.012, 300, 300);
  for (const DepthFill fill : {DepthFill::Neighbours, DepthFill::Nearest}) {
    DepthOptions options{{file}};
    options.fill = fill;
    Grid grid = without, other = without;
    const DepthReport report = setDepths(grid, options);
    EXPECT_EQ(setDepths(other, options, {}, testing::backwards).nodes_of_file, report.nodes_of_file);
    EXPECT_GT(report.filled, 1000u);
    EXPECT_EQ(report.unknown, 0u);
    EXPECT_EQ(other.z, grid.z);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i)
      if (const Point& p = grid.nodes[i]; p.x < 10.99 || p.y < 50.99) {
        EXPECT_NEAR(grid.z[i], slope(p.x, p.y), 1e-9);
      }
  }
}

TEST_F(Depth, SignAndWaterLevel) {
  Grid grid = squares("EPSG:4326", {10.0, 50.0}, 0.5, 4, 4);
  DepthOptions options{{raster("dem.tif", "EPSG:4326", {40, 40, 9.0, 53.0, 0.1}, slope)}};
  options.positive_down = true;
  options.water_level_m = 2.5;
  setDepths(grid, options);
  for (std::size_t i = 0; i < grid.nodes.size(); ++i)
    EXPECT_NEAR(grid.z[i], -slope(grid.nodes[i].x, grid.nodes[i].y) - 2.5, 0.51e-6);
}

// Interpolating in a flat bed of -3274 m gave -3274.0000000000005; files shall have what the raster has.
TEST_F(Depth, NoDigitsThatRoundingMade) {
  Grid grid = squares("EPSG:4326", {10.03, 50.07}, 0.31, 7, 5);
  const auto bed = [](double x, double y) {
    return std::hypot(x - 11.0, y - 51.0) < 0.5 ? kNoValue : y > 50.9 ? slope(x, y) : -0.3;
  };
  DepthOptions options{{raster("dem.tif", "EPSG:4326", {40, 40, 9.0, 53.0, 0.1}, bed)}};
  options.water_level_m = 0.1;
  EXPECT_GT(setDepths(grid, options).filled, 0u);
  std::size_t flat = 0;
  for (const double z : grid.z) {
    EXPECT_EQ(z, std::round(z * 1e6) / 1e6);
    flat += z == -0.4;
  }
  EXPECT_GT(flat, 10u);
}

TEST_F(Depth, RoundedHasNoMinusZero) {
  EXPECT_EQ(roundedDepth(-3274.0000000000005), -3274.0);
  EXPECT_EQ(roundedDepth(12.3456785), 12.345679);
  EXPECT_FALSE(std::signbit(roundedDepth(-1e-9)));
  EXPECT_TRUE(std::isnan(roundedDepth(std::numeric_limits<double>::quiet_NaN())));
}

// A raster in degrees under a projected mesh: values are found by place, not by coordinates.
TEST_F(Depth, AnyCrs) {
  Grid grid = squares("EPSG:32632", {400000.0, 5500000.0}, 5000.0, 8, 8);
  setDepths(grid, {{raster("dem.tif", "EPSG:4326", {400, 400, 7.0, 51.0, 0.01}, slope)}});
  const Projection toDegrees = Projection::to(parseCrs("EPSG:32632"), wgs84());
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
    const Point place = toDegrees.forward(grid.nodes[i]);
    EXPECT_NEAR(grid.z[i], slope(place.x, place.y), 1e-6);
  }
}

// The mean of a plane over all triangles around a node is its value at their common centroid.
TEST_F(Depth, AverageIsTheMeanOverTheTriangles) {
  Grid grid = squares("plane", {0.0, 0.0}, 16.0, 6, 5);
  const auto file = raster("dem.tif", "", {1200, 1000, -10.0, 90.0, 0.125}, slope);
  const DepthReport report = setDepths(grid, {{file}, DepthMethod::Average});
  EXPECT_EQ(report.averaged, grid.nodes.size());
  std::vector<double> area(grid.nodes.size()), sum(grid.nodes.size());
  for (const auto& [a, b, c] : grid.triangles) {
    const Point &p = grid.nodes[a], &q = grid.nodes[b], &r = grid.nodes[c];
    const double twice = (q.x - p.x) * (r.y - p.y) - (r.x - p.x) * (q.y - p.y);
    for (const std::uint32_t node : {a, b, c}) {
      area[node] += twice;
      sum[node] += twice * slope((p.x + q.x + r.x) / 3.0, (p.y + q.y + r.y) / 3.0);
    }
  }
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) EXPECT_NEAR(grid.z[i], sum[i] / area[i], 0.15) << i;
}

// Thousands of triangles over several tiles, each tile read separately; many triangles are on two tiles.
TEST_F(Depth, AverageIsTheSameInAnyOrder) {
  const std::string file = raster("dem.tif", "", {1600, 1600, 0.0, 1600.0, 1.0}, slope);
  Grid grid = squares("plane", {100.0, 100.0}, 7.0, 200, 200), other = grid;
  const DepthOptions options{{file}, DepthMethod::Average};
  const DepthReport report = setDepths(grid, options);
  EXPECT_EQ(report.averaged, grid.nodes.size());
  EXPECT_EQ(setDepths(other, options, {}, testing::backwards).averaged, report.averaged);
  EXPECT_EQ(other.z, grid.z);
  // Within one triangle of the node.
  for (std::size_t i = 0; i < grid.nodes.size(); ++i)
    EXPECT_NEAR(grid.z[i], slope(grid.nodes[i].x, grid.nodes[i].y), 7.0 * 5.0);
}

// Pixels much smaller than triangles: a rough surface averages out, unlike its value at a point.
TEST_F(Depth, AverageSmooths) {
  const auto wild = [](double x, double y) { return -100.0 + 60.0 * std::sin(9.7 * x) * std::sin(8.3 * y); };
  const auto file = raster("dem.tif", "", {1000, 1000, 0.0, 100.0, 0.1}, wild);
  Grid grid = squares("plane", {10.0, 10.0}, 12.0, 5, 5);
  setDepths(grid, {{file}, DepthMethod::Average});
  for (const double z : grid.z) EXPECT_NEAR(z, -100.0, 3.0);
  // Triangles smaller than a pixel have no mean: bilinear there.
  Grid fine = squares("plane", {50.0, 50.0}, 0.02, 4, 4);
  const DepthReport report = setDepths(fine, {{file}, DepthMethod::Average});
  EXPECT_EQ(report.averaged, 0u);
  EXPECT_NEAR(fine.z[0], wild(50.0, 50.0), 20.0);
}

TEST_F(Depth, FirstRasterThatHasAValueCounts) {
  Grid grid = squares("EPSG:4326", {10.0, 50.0}, 0.25, 8, 8);
  // The fine one covers the west, with a hole in it.
  const auto hole = [](double x, double y) { return std::hypot(x - 10.5, y - 51.0) < 0.3; };
  const auto fine = raster("fine.tif", "EPSG:4326", {1000, 2100, 9.99, 52.1, 0.001},
                           [&](double x, double y) { return hole(x, y) ? kNoValue : -10.0; });
  const auto coarse = raster("coarse.tif", "EPSG:4326", {60, 60, 8.0, 54.0, 0.1}, [](double, double) { return -20.0; });
  const DepthReport report = setDepths(grid, {{fine, coarse}});
  std::size_t of_fine = 0;
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
    const bool in_fine = grid.nodes[i].x < 10.99 && !hole(grid.nodes[i].x, grid.nodes[i].y);
    of_fine += in_fine;
    EXPECT_EQ(grid.z[i], in_fine ? -10.0 : -20.0) << grid.nodes[i].x << ' ' << grid.nodes[i].y;
  }
  EXPECT_THAT(report.nodes_of_file, ElementsAre(of_fine, grid.nodes.size() - of_fine));
  EXPECT_EQ(report.filled, 0u);
}

TEST_F(Depth, GapsAreFilledAndCounted) {
  const auto half = raster("half.tif", "EPSG:4326", {200, 200, 10.0, 52.0, 0.01},
                           [](double x, double) { return x < 11.0 ? -x : kNoValue; });
  for (const DepthFill fill : {DepthFill::Neighbours, DepthFill::Nearest, DepthFill::None}) {
    Grid grid = squares("EPSG:4326", {10.05, 50.05}, 0.15, 12, 12);
    DepthOptions options{{half}};
    options.fill = fill;
    const DepthReport report = setDepths(grid, options);
    const auto beyond =
        static_cast<std::size_t>(std::ranges::count_if(grid.nodes, [](const Point& p) { return p.x > 11.0; }));
    EXPECT_GT(beyond, 0u);
    EXPECT_THAT(report.warnings, ElementsAre(HasSubstr("no raster has a value for " + std::to_string(beyond) + " of " +
                                                       std::to_string(grid.nodes.size()))));
    EXPECT_EQ(report.filled, fill == DepthFill::None ? 0 : beyond);
    EXPECT_EQ(report.unknown, fill == DepthFill::None ? beyond : 0);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
      if (grid.nodes[i].x < 11.0) {
        EXPECT_NEAR(grid.z[i], -grid.nodes[i].x, 0.006);
      } else if (fill == DepthFill::None) {
        EXPECT_TRUE(std::isnan(grid.z[i]));
      } else {
        EXPECT_NEAR(grid.z[i], -10.95, 0.02);  // the last column of nodes with a value
      }
    }
  }
}

// A hole in a planar bed: filled depths are on the plane, within the error of the means.
TEST_F(Depth, AGapIsFilledAsSmoothlyAsTheBedAroundIt) {
  const auto holed = raster("holed.tif", "EPSG:4326", {400, 400, 10.0, 52.0, 0.005}, [](double x, double y) {
    return std::hypot(x - 11.0, y - 51.0) < 0.4 ? kNoValue : slope(x, y);
  });
  Grid grid = squares("EPSG:4326", {10.1, 50.1}, 0.02, 90, 90), other = grid;
  const DepthReport report = setDepths(grid, {{holed}});
  EXPECT_GT(report.filled, 1000u);
  for (std::size_t i = 0; i < grid.nodes.size(); ++i)
    EXPECT_NEAR(grid.z[i], slope(grid.nodes[i].x, grid.nodes[i].y), 0.02) << i;
  setDepths(other, {{holed}}, {}, testing::backwards);
  EXPECT_EQ(other.z, grid.z);
}

// Nodes across the antimeridian get the depth of the nearest ones, on whichever side of it they are.
TEST_F(Depth, NearestDepthsAcrossTheAntimeridian) {
  const auto west =
      raster("west.tif", "EPSG:4326", {130, 200, 178.5, 11.0, 0.01}, [](double, double) { return -100.0; });
  const auto east =
      raster("east.tif", "EPSG:4326", {100, 200, -179.0, 11.0, 0.01}, [](double, double) { return -10.0; });
  Grid grid = squares("EPSG:4326", {179.0, 9.5}, 0.1, 20, 10);
  for (Point& p : grid.nodes)
    if (p.x > 180.0) p.x -= 360.0;
  DepthOptions options{{west, east}};
  options.fill = DepthFill::Nearest;
  EXPECT_GT(setDepths(grid, options).filled, 50u);
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
    const double x = grid.nodes[i].x < 0.0 ? grid.nodes[i].x + 360.0 : grid.nodes[i].x;
    if (x < 180.31) {
      EXPECT_EQ(grid.z[i], -100.0) << x;
    }
    if (x > 180.49) {
      EXPECT_EQ(grid.z[i], -10.0) << x;
    }
  }
}

// A second water east of the raster, without a connection to the first.
TEST_F(Depth, AWaterWithoutAnyValueGetsThatOfTheNearestNode) {
  const auto west = raster("west.tif", "EPSG:4326", {100, 200, 10.0, 52.0, 0.01}, [](double x, double) { return -x; });
  for (const DepthFill fill : {DepthFill::Neighbours, DepthFill::Nearest, DepthFill::None}) {
    Grid grid = squares("EPSG:4326", {10.05, 50.05}, 0.15, 6, 12);
    const Grid other = squares("EPSG:4326", {12.0, 50.05}, 0.15, 3, 3);
    const auto first = static_cast<std::uint32_t>(grid.nodes.size());
    grid.nodes.insert(grid.nodes.end(), other.nodes.begin(), other.nodes.end());
    for (const auto& [a, b, c] : other.triangles) grid.triangles.push_back({a + first, b + first, c + first});
    DepthOptions options{{west}};
    options.fill = fill;
    const DepthReport report = setDepths(grid, options);
    if (fill == DepthFill::None) {
      EXPECT_EQ(report.unknown, other.nodes.size());
      continue;
    }
    EXPECT_EQ(report.filled, other.nodes.size());
    EXPECT_EQ(report.unknown, 0u);
    EXPECT_THAT(report.warnings, Contains(HasSubstr("waters of 16 nodes, such as at (12, 50.05)")));
    for (std::size_t i = first; i < grid.nodes.size(); ++i) EXPECT_NEAR(grid.z[i], -10.95, 0.02);
  }
}

// A raster that ends slightly before the mesh needs no warning.
TEST_F(Depth, AFewNodesWithoutAValueAreNotWarnedOf) {
  const auto most = raster("most.tif", "EPSG:4326", {200, 200, 10.0, 52.0, 0.01},
                           [](double x, double y) { return x > 10.1 || y > 50.1 ? -x : kNoValue; });
  Grid grid = squares("EPSG:4326", {10.05, 50.05}, 0.15, 12, 12);
  const DepthReport report = setDepths(grid, {{most}});
  EXPECT_EQ(report.filled, 1u);
  EXPECT_TRUE(report.warnings.empty());
}

// Longitudes of another turn, and a raster whose last column adjoins its first.
TEST_F(Depth, GoesRoundTheEarth) {
  const auto wave = [](double x, double) { return -100.0 + 50.0 * std::cos(x * M_PI / 180.0); };
  const auto world = raster("world.tif", "EPSG:4326", {720, 360, 0.0, 90.0, 0.5}, wave);
  for (const DepthMethod method : {DepthMethod::Bilinear, DepthMethod::Average}) {
    Grid grid = squares("EPSG:4326", {-11.0, -10.0}, 2.0, 10, 8);
    const DepthReport report = setDepths(grid, {{world}, method});
    EXPECT_EQ(report.filled + report.partial, 0u);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i)
      EXPECT_NEAR(grid.z[i], wave(grid.nodes[i].x, 0.0), method == DepthMethod::Bilinear ? 0.01 : 0.8);
  }
}

// World rasters that GDAL does not know to wrap: in Mercator and without a CRS. Deep but at the antimeridian.
TEST_F(Depth, TheMeanOfTrianglesAcrossTheAntimeridianIsTakenThere) {
  constexpr double kHalf = 20037508.342789244;  // of the equator in Mercator
  const auto shallowAt = [](double half) {
    return [half](double x, double) { return std::abs(x) > 0.9 * half ? -100.0 : -5000.0; };
  };
  const std::vector<std::string> files{
      raster("mercator.tif", "EPSG:3857", {1440, 1440, -kHalf, kHalf, kHalf / 720.0}, shallowAt(kHalf)),
      raster("degrees.tif", "", {1440, 720, -180.0, 90.0, 0.25}, shallowAt(180.0))};
  for (const std::string& file : files) {
    Grid grid = squares("EPSG:4326", {176.3, -18.2}, 1.0, 8, 4);
    const DepthReport report = setDepths(grid, {{file}, DepthMethod::Average});
    EXPECT_EQ(report.averaged, grid.nodes.size()) << file;
    EXPECT_EQ(report.partial, 0u) << file;
    for (const double z : grid.z) EXPECT_NEAR(z, -100.0, 1e-6) << file;
  }
}

TEST_F(Depth, LeastDepth) {
  Grid grid = squares("EPSG:4326", {10.0, 50.0}, 0.25, 8, 8);
  DepthOptions options{
      {raster("dem.tif", "EPSG:4326", {60, 60, 8.0, 54.0, 0.1}, [](double x, double) { return 11.0 - x; })}};
  options.min_depth_m = 0.5;
  const DepthReport report = setDepths(grid, options);
  for (std::size_t i = 0; i < grid.nodes.size(); ++i)
    EXPECT_NEAR(grid.z[i], std::min(-0.5, 11.0 - grid.nodes[i].x), 1e-9);
  EXPECT_GT(report.lowered, 0u);
  EXPECT_EQ(report.above_water, 0u);
}

TEST_F(Depth, WarnsOfTheWrongSign) {
  Grid grid = squares("EPSG:4326", {10.0, 50.0}, 0.25, 8, 8);
  const auto depths = raster("dep.tif", "EPSG:4326", {60, 60, 8.0, 54.0, 0.1}, [](double, double) { return 40.0; });
  ASSERT_EQ(setDepths(grid, {{depths}}).warnings.size(), 1u);
  EXPECT_THAT(setDepths(grid, {{depths}}).warnings[0], HasSubstr("--depth-sign"));
}

// A plain is above the water in the mesh already.
TEST_F(Depth, LandThatWasThereBeforeIsNoSign) {
  const auto heights = raster("dem.tif", "EPSG:4326", {60, 60, 8.0, 54.0, 0.1}, [](double, double) { return 3.0; });
  DepthOptions options{{heights}};
  options.keep_known = true;
  const auto warningsOf = [&](double z) {
    Grid grid = squares("EPSG:4326", {10.0, 50.0}, 0.25, 8, 8);
    grid.z.assign(grid.nodes.size(), z);
    return setDepths(grid, options).warnings;
  };
  EXPECT_THAT(warningsOf(2.5), IsEmpty());
  EXPECT_THAT(warningsOf(-2.5), ElementsAre(HasSubstr("--depth-sign")));
}

// A mesh with a plain, in a part of which nodes are new: only those in its water get the minimum depth.
TEST_F(Depth, LeastDepthSparesLandThatWasThereBefore) {
  const auto heights = raster("dem.tif", "EPSG:4326", {60, 60, 8.0, 54.0, 0.1}, [](double, double) { return 3.0; });
  DepthOptions options{{heights}};
  options.min_depth_m = 2.0;
  options.keep_known = true;
  for (const bool keeps : {true, false}) {
    options.keep_land = keeps;
    Grid grid = squares("EPSG:4326", {10.0, 50.0}, 0.25, 8, 8);
    for (const Point& p : grid.nodes) grid.z.push_back(p.x < 11.1 ? -2.5 : 2.5);
    setDepths(grid, options);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i)
      EXPECT_EQ(grid.z[i], grid.nodes[i].x < 11.1 || !keeps ? -2.0 : 3.0);
  }
}

// Heights of a lake's bed are all far above the raster's zero; depths given as heights begin at zero.
TEST_F(Depth, WarnsOfALakeAboveTheRastersZero) {
  Grid grid = squares("EPSG:4326", {10.0, 50.0}, 0.25, 8, 8);
  const auto warningsOf = [&](const char* name, double least) {
    const auto heights = raster(name, "EPSG:4326", {60, 60, 8.0, 54.0, 0.1},
                                [least](double x, double) { return least + 40.0 * (x - 10.0); });
    return setDepths(grid, {{heights}}).warnings;
  };
  const std::vector<std::string> lake = warningsOf("lake.tif", 1050.0), sea = warningsOf("sea.tif", 0.0);
  EXPECT_THAT(lake, ElementsAre(::testing::AllOf(HasSubstr("between 1050 and 1130 m"), HasSubstr("--water-level"),
                                                 HasSubstr("--depth-sign"))));
  EXPECT_THAT(sea,
              ElementsAre(::testing::AllOf(HasSubstr("--depth-sign"), ::testing::Not(HasSubstr("--water-level")))));
}

TEST_F(Depth, TellsWhatCannotBeUsed) {
  Grid grid = squares("EPSG:4326", {10.0, 50.0}, 0.25, 2, 2);
  EXPECT_THROW(setDepths(grid, {{folder_ / "none.tif"}}), InputError);
  std::ofstream(folder_ / "text.tif") << "no raster";
  EXPECT_THROW(setDepths(grid, {{folder_ / "text.tif"}}), InputError);
  const auto far = raster("far.tif", "EPSG:4326", {10, 10, 100.0, 10.0, 0.1}, slope);
  const DepthReport report = setDepths(grid, {{far}});
  EXPECT_EQ(report.unknown, grid.nodes.size());
  EXPECT_THAT(report.warnings, ElementsAre(HasSubstr("no raster has a value")));
}

}  // namespace
}  // namespace coastmesh
