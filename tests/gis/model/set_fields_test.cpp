// Nodal attributes from rasters: against values computed by hand.
#include "gis/model/set_fields.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "gis/error.hpp"
#include "gis/fields/node_fields.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/item_loops.hpp"
#include "tests/support/rasters.hpp"

namespace coastmesh {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::kNoValue;
using testing::RasterShape;
using ::testing::SizeIs;
using testing::TemporaryFolder;
using testing::writeRaster;

constexpr const char* kUtm = "EPSG:32632";

// A square with its middle as a fifth node, in metres.
Grid fan(double side) {
  Grid grid;
  grid.crs = parseCrs(kUtm);
  grid.nodes = {{0, 0}, {side, 0}, {side, side}, {0, side}, {side / 2, side / 2}};
  grid.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  return grid;
}

class SetFields : public ::testing::Test {
 protected:
  std::string raster(const std::string& name, const RasterShape& shape,
                     const std::function<double(double, double)>& value) {
    writeRaster(folder_ / name, kUtm, shape, value);
    return folder_ / name;
  }
  std::string table(const std::string& text, const std::string& name = "table.csv") {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  static FieldReport set(Grid& grid, const std::vector<FieldSource>& sources, DepthFill fill = DepthFill::Neighbours) {
    std::vector<FieldReport> reports = setFields(grid, sources, DepthMethod::Bilinear, fill);
    EXPECT_THAT(reports, SizeIs(1));
    return reports.front();
  }
  std::string refusalOf(const std::vector<FieldSource>& sources) {
    Grid grid = fan(100);
    try {
      setFields(grid, sources, DepthMethod::Bilinear, DepthFill::None);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  TemporaryFolder folder_;
};

TEST_F(SetFields, AreInterpolatedAndNotTakenForLengths) {
  const std::string file =
      raster("a.tif", {30, 30, -100, 200, 10}, [](double x, double y) { return 0.02 + 1e-4 * x + 2e-5 * y; });
  Grid grid = fan(100);
  const FieldReport report = set(grid, {{"mannings_n_at_sea_floor", {}, file}});
  ASSERT_THAT(grid.node_fields, SizeIs(1));
  const NodeField& field = grid.node_fields[0];
  EXPECT_THAT(field.values, ElementsAre(0.02, 0.03, 0.032, 0.022, 0.026));
  EXPECT_EQ(field.unit, "s/m^(1/3)");
  EXPECT_TRUE(std::isnan(field.usual));
  EXPECT_THAT(report.nodes_of_file, ElementsAre(5));
  EXPECT_EQ(report.least, 0.02);
  EXPECT_EQ(report.greatest, 0.032);
  EXPECT_THAT(report.warnings, IsEmpty());
  EXPECT_THAT(grid.z, IsEmpty());
}

TEST_F(SetFields, StatesAreThoseOfTheNearestPixel) {
  // Between the middles of pixels at 40 and 80 m, the fifth node would be 0.75.
  const RasterShape shape{10, 10, -100, 200, 40};
  const std::string file = raster("a.tif", shape, [](double x, double) { return x < 60 ? 1.0 : 0.0; });
  for (const DepthMethod method : {DepthMethod::Bilinear, DepthMethod::Average}) {
    Grid grid = fan(100);
    setFields(grid, {{"surface_submergence_state", {}, file}}, method, DepthFill::Neighbours);
    EXPECT_THAT(grid.node_fields[0].values, ElementsAre(1, 0, 0, 1, 1));
  }
  const std::string gaps = raster("b.tif", {40, 40, -100, 200, 10}, [](double x, double y) {
    return x + y < 40 ? 1.0 : x + y > 160 ? 0.0 : kNoValue;
  });
  Grid grid = fan(100);
  EXPECT_EQ(set(grid, {{"surface_submergence_state", {}, gaps}}).filled, 3u);
  for (const double state : grid.node_fields[0].values) EXPECT_TRUE(state == 0.0 || state == 1.0) << state;
}

TEST_F(SetFields, ANumberIsThatOfNodesWithoutAValue) {
  // No value east of 50 m, not even in the pixel around it.
  const std::string file =
      raster("a.tif", {30, 30, -100, 200, 10}, [](double x, double) { return x < 40 ? 2.0 : kNoValue; });
  Grid grid = fan(100);
  const FieldReport report = set(grid, {{"a", {}, file}, {"a", 0.5}});
  EXPECT_THAT(grid.node_fields[0].values, ElementsAre(2, 0.5, 0.5, 2, 0.5));
  EXPECT_EQ(grid.node_fields[0].usual, 0.5);
  EXPECT_EQ(report.of_number, 3u);
  set(grid, {{"a", 7.0}});
  EXPECT_THAT(grid.node_fields[0].values, Each(7.0));
}

TEST_F(SetFields, OtherwiseNodesKeepWhatTheyHaveOrAreFilled) {
  const std::string file =
      raster("a.tif", {30, 30, -100, 200, 10}, [](double x, double) { return x < 40 ? 2.0 : kNoValue; });
  Grid grid = fan(100);
  grid.node_fields = {{"a", "", 0, 1.5, {9, 8, std::numeric_limits<double>::quiet_NaN(), 6, 5}}};
  const FieldReport report = set(grid, {{"a", {}, file}}, DepthFill::Nearest);
  EXPECT_THAT(grid.node_fields[0].values, ElementsAre(2, 8, 5, 2, 5));
  EXPECT_EQ(grid.node_fields[0].usual, 1.5);
  EXPECT_EQ(report.kept, 2u);
  EXPECT_EQ(report.filled, 1u);
  Grid bare = fan(100);
  EXPECT_EQ(set(bare, {{"a", {}, file}}, DepthFill::None).unknown, 3u);
  EXPECT_THAT(set(bare, {{"a", {}, file}}, DepthFill::Neighbours).warnings,
              ElementsAre(HasSubstr("no raster of a has a value for 3 of 5 nodes, the first at (100, 0)")));
  EXPECT_THAT(bare.node_fields[0].values, Each(2.0));
}

TEST_F(SetFields, TheFirstRasterWithAValueIsUsed) {
  const std::string west =
      raster("w.tif", {30, 30, -100, 200, 10}, [](double x, double) { return x < 40 ? 1.0 : kNoValue; });
  const std::string all = raster("a.tif", {30, 30, -100, 200, 10}, [](double, double) { return 3.0; });
  Grid grid = fan(100);
  EXPECT_THAT(set(grid, {{"a", {}, west}, {"a", {}, all}}).nodes_of_file, ElementsAre(2, 3));
  EXPECT_THAT(grid.node_fields[0].values, ElementsAre(1, 3, 3, 1, 3));
}

// Classes 1 west of 50 m and 2 east of it. No centre of a pixel is on an edge of the mesh.
TEST_F(SetFields, ClassesAreAveragedOverTheTrianglesOfANode) {
  const std::string file =
      raster("a.tif", {30, 30, -103, 204, 10}, [](double x, double) { return x < 50 ? 1.0 : 2.0; });
  Grid grid = fan(100);
  const FieldReport report = set(grid, {{"a", {}, file, table("1,0.02\n2,0.1\n")}});
  EXPECT_EQ(report.averaged, 5u);
  double sum = 0.0, pixels = 0.0;  // in the triangles of node 0, in the south and in the west
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j) {
      const double x = 2 + 10 * i, y = 9 + 10 * j;
      if (!(y < x && y < 100 - x) && !(x < y && x < 100 - y)) continue;
      sum += x < 50 ? 0.02 : 0.1;
      pixels += 1.0;
    }
  EXPECT_GT(pixels, 40.0);
  EXPECT_EQ(grid.node_fields[0].values[0], roundedValue(sum / pixels));
  EXPECT_EQ(grid.node_fields[0].values[4], 0.06);  // half of each class
}

TEST_F(SetFields, ThePixelOfANodeIsUsedWherePixelsAreLarger) {
  const std::string file = raster("a.tif", {3, 3, -110, 200, 100}, [](double x, double y) {
    return (x < -10 ? 1 : x < 90 ? 2 : 3) + (y > 0 ? 0 : 10);
  });
  Grid grid = fan(100);
  const std::string text = "\xEF\xBB\xBF\"class\";\"friction\"\r\n# land\r\n2;0.5\r\n3;0.75\r\n12;1\r\n13;2\r\n";
  const FieldReport report = set(grid, {{"a", {}, file, table(text)}});
  EXPECT_EQ(report.averaged, 0u);
  EXPECT_THAT(grid.node_fields[0].values, ElementsAre(1, 2, 0.75, 0.5, 0.5));
}

TEST_F(SetFields, AClassWithoutAValueIsNamedWithItsPlace) {
  const std::string file =
      raster("a.tif", {30, 30, -100, 200, 10}, [](double x, double y) { return x > 90 && y > 90 ? 7.0 : 1.0; });
  const std::string text = refusalOf({{"a", {}, file, table("1,0.02\n2,0.1\n")}});
  EXPECT_THAT(text, HasSubstr("a.tif' has class 7 at (95, 95)"));
  EXPECT_THAT(text, HasSubstr("table.csv' lacks"));
  const std::string coarse = raster("b.tif", {1, 1, -100, 200, 300}, [](double, double) { return 4.0; });
  EXPECT_THAT(refusalOf({{"a", {}, coarse, table("1,0.02\n")}}), HasSubstr("b.tif' has class 4 at (50, 50)"));
  // Classes outside the mesh need none.
  const std::string beyond =
      raster("c.tif", {30, 30, -100, 200, 10}, [](double x, double) { return x > 100 ? 7.0 : 1.0; });
  EXPECT_EQ(refusalOf({{"a", {}, beyond, table("1,0.02\n")}}), "");
}

TEST_F(SetFields, DamagedTablesAreRefused) {
  const std::string file = raster("a.tif", {30, 30, -100, 200, 10}, [](double, double) { return 1.0; });
  const auto refusal = [&](const std::string& text) { return refusalOf({{"a", {}, file, table(text)}}); };
  EXPECT_THAT(refusal("class,n\n1,0.02,7\n"), HasSubstr("line 2: it has more than two columns"));
  EXPECT_THAT(refusal("1\n"), HasSubstr("line 1: class 1 has no value"));
  EXPECT_THAT(refusal("1,sand\n"), HasSubstr("line 1"));
  EXPECT_THAT(refusal("1,0.1\nsand,0.1\n"), HasSubstr("line 2"));
  EXPECT_THAT(refusal("1,0.1\n1,0.2\n"), HasSubstr("two values for class 1, 0.1 and 0.2"));
  EXPECT_THAT(refusal("class,n\n"), HasSubstr("has no classes"));
  EXPECT_EQ(refusal("1,0.1\n1,0.1\n"), "");
  EXPECT_THAT(refusalOf({{"a", {}, file, folder_ / "none.csv"}}), HasSubstr("none.csv"));
}

TEST_F(SetFields, ClassesTakenForFrictionAreWarnedOf) {
  const std::string file = raster("a.tif", {30, 30, -100, 200, 10}, [](double, double) { return 42.0; });
  Grid grid = fan(100);
  EXPECT_THAT(set(grid, {{"mannings_n_at_sea_floor", {}, file}}).warnings,
              ElementsAre(HasSubstr("is as large as 42: if a raster holds classes of land cover")));
}

}  // namespace
}  // namespace coastmesh
