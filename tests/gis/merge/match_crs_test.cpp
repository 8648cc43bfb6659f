#include "gis/merge/match_crs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gis/crs/geodesy.hpp"
#include "gis/error.hpp"
#include "tests/gis/merge/merged.hpp"

namespace coastmesh {
namespace {

using namespace coastmesh::testing;
using ::testing::HasSubstr;

Grid around(const char* crs, const Point& corner, double length) {
  Grid grid = gridOf({4, 4, length, corner});
  grid.crs = parseCrs(crs);
  return grid;
}

TEST(MatchCrs, BringsMetresToDegrees) {
  Grid metres = around("EPSG:32616", {500000.0, 4600000.0}, 1000.0);
  const BulkList<double> before = triangleAreas(metres.nodes, metres.triangles, metres.crs);
  matchCrs(metres, around("EPSG:4326", {-88.0, 41.0}, 0.1), "a.nc");
  EXPECT_TRUE(metres.crs.geographic);
  EXPECT_NEAR(metres.nodes[0].x, -87.0, 1e-9);
  EXPECT_NEAR(metres.nodes[0].y, 41.55, 0.01);
  const BulkList<double> after = triangleAreas(metres.nodes, metres.triangles, metres.crs);
  for (std::size_t t = 0; t < before.size(); ++t) EXPECT_NEAR(after[t], before[t], 1e-3 * before[t]);
}

TEST(MatchCrs, KeepsTheBitsOfTheSameCrs) {
  Grid grid = around("EPSG:32616", {500000.1, 4600000.3}, 1000.7);
  const Grid before = grid;
  matchCrs(grid, around("EPSG:32616", {0.0, 0.0}, 1.0), "a.nc");
  EXPECT_EQ(grid.nodes, before.nodes);
}

TEST(MatchCrs, LongitudesAreInTheTurnOfTheOther) {
  Grid grid = around("EPSG:4326", {-179.5, 50.0}, 0.1);
  matchCrs(grid, around("EPSG:4326", {176.0, 49.0}, 2.0), "a.nc");
  EXPECT_NEAR(grid.nodes[0].x, 180.5, 1e-12);
  matchCrs(grid, around("EPSG:4326", {-180.0, 49.0}, 2.0), "a.nc");
  EXPECT_NEAR(grid.nodes[0].x, -179.5, 1e-12);
}

TEST(MatchCrs, RefusesAPlaneBesideTheEarth) {
  const auto refusal = [](Grid grid, const Grid& beside) -> std::string {
    try {
      matchCrs(grid, beside, "a.14");
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(refusal(gridOf({4, 4}), around("EPSG:4326", {0.0, 0.0}, 0.1)),
              HasSubstr("'a.14' does not say its CRS, and the other mesh is in EPSG:4326"));
  EXPECT_THAT(refusal(around("EPSG:4326", {0.0, 0.0}, 0.1), gridOf({4, 4})), HasSubstr("the other mesh does not say"));
  EXPECT_EQ(refusal(gridOf({4, 4}), gridOf({4, 4})), "none");
}

}  // namespace
}  // namespace coastmesh
