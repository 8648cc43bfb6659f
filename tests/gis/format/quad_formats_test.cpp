// Quadrilaterals in files: kept by formats that hold them, divided by others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gis/crs/geodesy.hpp"
#include "gis/elements/elements.hpp"
#include "gis/format/grid_losses.hpp"
#include "gis/grid/grid_edit.hpp"
#include "tests/gis/format/read_grid.hpp"
#include "tests/gis/quad_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using testing::elementsOf;
using ::testing::HasSubstr;
using testing::mixedGrid;

// A river of quadrilaterals between triangles, with depths, features, angles and areas.
Grid riverGrid() {
  Grid grid = mixedGrid(
      8, 5, [](int i, int j) { return i > 1 && (j == 1 || j == 2); }, wgs84(), 0.01);
  for (const Point& p : grid.nodes) grid.z.push_back(-5.0 - p.x);
  grid.features = {{1, "", {}}, {2, "", {}}};
  const Elements elements(grid);
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t)
    grid.feature_of.push_back(elements.isQuad(elements.elementOf(t)) ? 1 : 0);
  sortFeatures(grid);
  grid.area_m2 = triangleAreas(grid.nodes, grid.triangles, grid.crs);
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t)
    grid.min_angle_deg.push_back(elements.isQuad(elements.elementOf(t)) ? 90.0 : 26.5);
  return grid;
}

class QuadFormats : public ::testing::TestWithParam<GridFormat> {
 protected:
  std::string write(const Grid& grid) {
    const std::string path = folder_ / ("mesh" + std::string(GetParam().endings.front()));
    StagedOutput output(path, GetParam(), true);
    output.write(grid);
    output.commit();
    return path;
  }

  testing::TemporaryFolder folder_;
};

TEST_P(QuadFormats, AreReadAsTheyWereWritten) {
  const Grid grid = riverGrid();
  const Grid got = readGrid(write(grid), wgs84());
  EXPECT_EQ(elementsOf(got), elementsOf(grid));
  EXPECT_EQ(got.triangles, grid.triangles);
  EXPECT_TRUE(lossesIn(grid, GetParam(), LossesOf::Grid).find("quadrilateral") == std::string::npos);
  if (!got.feature_of.empty()) {
    EXPECT_EQ(got.feature_of, grid.feature_of);
  }
  if (!got.min_angle_deg.empty()) {
    EXPECT_EQ(got.min_angle_deg, grid.min_angle_deg);
  }
  for (std::size_t t = 0; t < got.area_m2.size(); ++t)
    EXPECT_NEAR(got.area_m2[t], grid.area_m2[t], 1e-6 * grid.area_m2[t]);
  EXPECT_TRUE(got.notes.empty());
}

// All elements, and files without triangles.
TEST_P(QuadFormats, AloneAreReadToo) {
  const Grid grid = [] {
    Grid all = mixedGrid(
        4, 3, [](int, int) { return true; }, wgs84(), 0.01);
    for (const Point& p : all.nodes) all.z.push_back(-5.0 - p.x);
    return all;
  }();
  const Grid got = readGrid(write(grid), wgs84());
  EXPECT_EQ(elementsOf(got), elementsOf(grid));
  EXPECT_EQ(Elements(got).quads(), 12u);
}

std::vector<GridFormat> formatsThat(bool hold_quads) {
  std::vector<GridFormat> formats;
  for (const GridFormat& format : gridFormats())
    if (format.readable && format.writable && format.holds.has(GridPart::Quads) == hold_quads)
      formats.push_back(format);
  return formats;
}

INSTANTIATE_TEST_SUITE_P(Formats, QuadFormats, ::testing::ValuesIn(formatsThat(true)),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(FormatsOfTriangles, SayThatQuadrilateralsAreDivided) {
  const Grid grid = riverGrid();
  std::vector<std::string> names;
  for (const GridFormat& format : formatsThat(false)) {
    names.emplace_back(format.name);
    EXPECT_THAT(lossesIn(grid, format, LossesOf::Grid),
                HasSubstr("12 quadrilaterals, which become two triangles each"));
  }
  EXPECT_THAT(names, ::testing::IsSupersetOf({"adcirc", "telemac", "fvcom", "ww3", "fesom"}));
}

TEST_F(ReadGrid, AdcircWithQuadrilaterals) {
  const Grid grid = readGrid(put("m.14",
                                 "quads\n2 6\n1 0 0 1\n2 1 0 1\n3 2 0 1\n4 0 1 1\n5 1 1 1\n6 2 1 1\n"
                                 "1 4 2 5 4 1\n2 3 2 3 5\n"));
  EXPECT_THAT(elementsOf(grid),
              ElementsAre(std::vector<std::uint32_t>{1, 4, 3, 0}, std::vector<std::uint32_t>{1, 2, 4}));
}

TEST_F(ReadGrid, ElementsOfOtherKindsAreNamed) {
  EXPECT_THAT(errorIn("m.gr3", "five\n1 5\n1 0 0 1\n2 1 0 1\n3 1 1 1\n4 0 1 1\n5 0 .5 1\n1 5 1 2 3 4 5\n"),
              HasSubstr("line 8: an element of 5 nodes; only triangles and quadrilaterals can be read"));
  EXPECT_THAT(errorIn("m.2dm", "MESH2D\nE6T 1 1 2 3 4 5 6 1\n"),
              HasSubstr("an element of kind E6T; only triangles (E3T) and quadrilaterals (E4Q) can be read"));
  EXPECT_THAT(errorIn("m.2dm", "MESH2D\nE4Q 1 1 2 3 9 1\nND 1 0 0 0\nND 2 1 0 0\nND 3 1 1 0\n"),
              HasSubstr("element 1 names node 9, which is not there"));
}

}  // namespace
}  // namespace coastmesh
