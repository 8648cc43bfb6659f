#include "gis/cut/cut_region.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numeric>

#include "gis/error.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

using coastmesh::testing::TemporaryFolder;

// Squares of a degree, two triangles each.
Grid degrees(double west, double south, int columns, int rows) {
  Grid grid;
  grid.crs = wgs84();
  const TriMesh mesh = coastmesh::testing::lattice(
      columns, rows, [](int, int) { return true; },
      [&](int i, int j) {
        return Point{west + i, south + j};
      });
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  return grid;
}

class CutRegionTest : public ::testing::Test {
 protected:
  std::string polygons(const std::string& name, const std::string& coordinates) const {
    std::ofstream(folder_ / name) << R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},)"
                                  << R"("geometry":{"type":"MultiPolygon","coordinates":)" << coordinates << "}}]}";
    return folder_ / name;
  }
  std::size_t count(const Grid& grid, const CutRegion& region) const {
    std::vector<std::string> warnings;
    const auto taken = trianglesIn(region, grid, warnings);
    EXPECT_EQ(trianglesIn(region, grid, warnings, coastmesh::testing::backwards), taken);
    return static_cast<std::size_t>(std::accumulate(taken.begin(), taken.end(), 0));
  }

  TemporaryFolder folder_;
};

TEST_F(CutRegionTest, ABoxTakesTrianglesByTheirMiddle) {
  const Grid grid = degrees(10, 50, 8, 8);
  EXPECT_EQ(count(grid, {.box = Box{12, 51, 15, 53}}), 12u);
  EXPECT_EQ(count(grid, {.box = Box{12.5, 51, 15, 53}}), 10u);  // of a square's two, the middle of one is east of it
  EXPECT_EQ(count(grid, {.box = Box{372, 51, 375, 53}}), 12u);
  EXPECT_EQ(count(grid, {.box = Box{-180, -90, 180, 90}}), 128u);
  EXPECT_EQ(count(grid, {.box = Box{0, 0, 1, 1}}), 0u);
}

TEST_F(CutRegionTest, BoxesCrossTheAntimeridian) {
  for (const double west : {176.0, -184.0}) {
    const Grid grid = degrees(west, -4, 8, 4);
    EXPECT_EQ(count(grid, {.box = Box{179, -2, -178, 0}}), 12u) << west;
    EXPECT_EQ(count(grid, {.box = Box{179, -2, 182, 0}}), 12u) << west;
  }
  // Longitudes that jump.
  Grid jumping = degrees(176, -4, 8, 4);
  for (Point& p : jumping.nodes)
    if (p.x > 180.0) p.x -= 360.0;
  EXPECT_EQ(count(jumping, {.box = Box{179, -2, -178, 0}}), 12u);
  Grid plane = degrees(0, 0, 4, 4);
  plane.crs = {};
  std::vector<std::string> warnings;
  EXPECT_THROW(trianglesIn({.box = Box{3, 0, 1, 2}}, plane, warnings), InputError);
}

TEST_F(CutRegionTest, PolygonsTakeWhatIsInThemButNotInTheirHoles) {
  const Grid grid = degrees(10, 50, 8, 8);
  const std::string ring = polygons("ring.geojson",
                                    "[[[[11,51],[17,51],[17,57],[11,57],[11,51]],"
                                    "[[13,53],[15,53],[15,55],[13,55],[13,53]]]]");
  EXPECT_EQ(count(grid, {.within = {ring}}), 2u * (36 - 4));
  EXPECT_EQ(count(grid, {.outside = {ring}}), 2u * (64 - 36 + 4));
  EXPECT_EQ(count(grid, {.box = Box{10, 50, 18, 52}, .within = {ring}}), 2u * 6);
  // Files, and polygons that overlap, are united.
  const std::string other = polygons("other.geojson", "[[[[10,50],[12,50],[12,52],[10,52],[10,50]]]]");
  EXPECT_EQ(count(grid, {.within = {ring, other}}), 2u * (36 - 4 + 3));
  EXPECT_EQ(count(grid, {.within = {ring}, .outside = {other}}), 2u * (36 - 4 - 1));
}

TEST_F(CutRegionTest, PolygonsMayBeInAnotherCrsAndAcrossTheAntimeridian) {
  Grid grid = degrees(176, -4, 8, 4);
  const std::string across = polygons("across.geojson", "[[[[179,-2],[-178,-2],[-178,0],[179,0],[179,-2]]]]");
  EXPECT_EQ(count(grid, {.within = {across}}), 12u);
  for (Point& p : grid.nodes)
    if (p.x > 180.0) p.x -= 360.0;
  EXPECT_EQ(count(grid, {.within = {across}}), 12u);
  // The mesh in metres, the polygon in degrees.
  const Crs utm = parseCrs("EPSG:32632");
  const Grid metres = coastmesh::testing::sampleGrid(utm, {500000.0, 5500000.0}, 1000.0, 6);
  const std::string half = polygons("half.geojson", "[[[[8,49],[9.04,49],[9.04,50],[8,50],[8,49]]]]");
  const std::size_t taken = count(metres, {.within = {half}});
  EXPECT_GT(taken, metres.triangles.size() / 10);
  EXPECT_LT(taken, metres.triangles.size() / 2);
  EXPECT_EQ(count(metres, {.outside = {half}}), metres.triangles.size() - taken);
}

TEST_F(CutRegionTest, AGridInAPlaneTakesCoordinatesAsTheyAre) {
  Grid grid = degrees(10, 50, 8, 8);
  grid.crs = {};
  const std::string square = polygons("square.geojson", "[[[[11,51],[17,51],[17,57],[11,57],[11,51]]]]");
  EXPECT_EQ(count(grid, {.within = {square}}), 72u);
}

TEST_F(CutRegionTest, AFileWithoutPolygonsIsRefused) {
  const Grid grid = degrees(10, 50, 2, 2);
  std::ofstream(folder_ / "points.geojson") << R"({"type":"Point","coordinates":[10,50]})";
  std::vector<std::string> warnings;
  EXPECT_THROW(trianglesIn({.within = {folder_ / "points.geojson"}}, grid, warnings), InputError);
  EXPECT_THROW(trianglesIn({.within = {folder_ / "none.geojson"}}, grid, warnings), InputError);
}

}  // namespace
}  // namespace coastmesh
