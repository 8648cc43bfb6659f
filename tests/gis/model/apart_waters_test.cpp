#include "gis/model/apart_waters.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "gis/crs/geodesy.hpp"
#include "gis/grid/grid_edit.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

// Separate squares with these sides, two triangles each, in a row. The first has an open boundary.
Grid squares(const std::vector<double>& sides) {
  Grid grid;
  double west = 0.0;
  for (const double side : sides) {
    const auto first = static_cast<std::uint32_t>(grid.nodes.size());
    for (const Point& p : {Point{west, 0}, Point{west + side, 0}, Point{west + side, side}, Point{west, side}})
      grid.nodes.push_back(p);
    for (const GridCorners& corners :
         {GridCorners{first, first + 1, first + 2}, GridCorners{first, first + 2, first + 3}}) {
      grid.triangles.push_back(corners);
      grid.area_m2.push_back(0.5 * side * side);
    }
    grid.boundaries.push_back(
        {first == 0 ? BoundaryRole::Open : BoundaryRole::Land, true, {first, first + 1, first + 2, first + 3}});
    west += side + 1.0;
  }
  return grid;
}

TEST(ApartWaters, AreThoseWithoutAnOpenBoundary) {
  const Grid grid = squares({3.0, 1.0, 2.0});
  const std::vector<ApartWater> apart = apartWaters(grid);
  ASSERT_EQ(apart.size(), 2u);
  EXPECT_EQ(apart[0].triangle, 2u);
  EXPECT_EQ(apart[1].triangles, 2u);
  Grid closed = grid;
  closed.boundaries[0].role = BoundaryRole::Land;
  EXPECT_TRUE(apartWaters(closed).empty());
  EXPECT_EQ(dropApartWaters(closed).waters, 0u);
}

TEST(ApartWaters, OneWaterHangsTogetherThroughEdges) {
  EXPECT_TRUE(isOneWater(squares({2.0})));
  EXPECT_FALSE(isOneWater(squares({2.0, 1.0})));
  // A triangle that shares only a node with the square.
  Grid pinched = squares({2.0});
  pinched.nodes.push_back({4.0, 2.0});
  pinched.nodes.push_back({3.0, 3.0});
  pinched.triangles.push_back({2, 4, 5});
  pinched.area_m2.push_back(1.0);
  pinched.boundaries.push_back({BoundaryRole::Land, true, {2, 4, 5}});
  EXPECT_FALSE(isOneWater(pinched));
  EXPECT_EQ(apartWaters(pinched).size(), 1u);
}

TEST(ApartWaters, AreTheSameHoweverWorkIsShared) {
  std::vector<double> sides(30000, 1.0);
  const Grid grid = squares(sides);
  const std::vector<ApartWater> apart = apartWaters(grid);
  EXPECT_EQ(apart.size(), sides.size() - 1);
  EXPECT_EQ(apart, apartWaters(grid, testing::backwards));
  EXPECT_FALSE(isOneWater(grid, testing::backwards));
  EXPECT_TRUE(isOneWater(squares({2.0}), testing::backwards));
}

TEST(ApartWaters, AreTakenOutOfTheGrid) {
  Grid grid = squares({3.0, 1.0, 2.0});
  const DroppedWaters dropped = dropApartWaters(grid);
  EXPECT_EQ(dropped.waters, 2u);
  EXPECT_DOUBLE_EQ(dropped.area_m2, 5.0);
  EXPECT_DOUBLE_EQ(dropped.share, 5.0 / 14.0);
  EXPECT_GT(dropped.place.x, 6.0);  // in the larger one
  EXPECT_EQ(grid.triangles.size(), 2u);
  EXPECT_EQ(grid.nodes.size(), 4u);
  EXPECT_EQ(grid.boundaries.size(), 1u);
  EXPECT_NO_THROW(requireConsistent(grid));
}

TEST(ApartWaters, TheirPlaceIsWithinThemAcrossTheAntimeridian) {
  Grid grid = squares({3.0, 2.0});
  grid.crs = wgs84();
  for (Point& node : grid.nodes) node.x += node.x > 4.5 ? 174.5 - 360.0 : 174.5;
  const DroppedWaters dropped = dropApartWaters(grid);
  EXPECT_EQ(dropped.waters, 1u);
  EXPECT_GT(std::abs(dropped.place.x), 178.0);
}

// Squares of which the first three have an open boundary: 100, 16 and 4, and one without of 1.
Grid squaresOpen() {
  Grid grid = squares({10.0, 4.0, 2.0, 1.0});
  for (const std::size_t square : {1u, 2u}) grid.boundaries[square].role = BoundaryRole::Open;
  return grid;
}

TEST(ApartWaters, AreThoseThatTheFrameOnlyGrazes) {
  Grid grid = squaresOpen();
  EXPECT_EQ(apartWaters(grid).size(), 1u);
  const DroppedWaters dropped = dropApartWaters(grid);
  EXPECT_EQ(dropped.waters, 2u);
  EXPECT_EQ(dropped.at_open, 1u);
  EXPECT_DOUBLE_EQ(dropped.area_m2, 5.0);
  EXPECT_EQ(grid.triangles.size(), 4u);
  EXPECT_NO_THROW(requireConsistent(grid));
}

TEST(ApartWaters, GrazedOnesStayOnRequest) {
  Grid grid = squaresOpen();
  const DroppedWaters dropped = dropApartWaters(grid, GrazedWaters::Keep);
  EXPECT_EQ(dropped.waters, 1u);
  EXPECT_EQ(dropped.at_open, 0u);
  EXPECT_EQ(grid.triangles.size(), 6u);
}

TEST(ApartWaters, StayIfTheFrameOnlyGrazesTheOthers) {
  Grid grid = squares({1.0, 5.0});
  EXPECT_EQ(dropApartWaters(grid).waters, 0u);
  EXPECT_EQ(grid.triangles.size(), 4u);
}

}  // namespace
}  // namespace coastmesh
