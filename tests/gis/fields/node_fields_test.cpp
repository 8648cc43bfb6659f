// Nodal attributes under edits of a grid.
#include "gis/fields/node_fields.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gis/grid/grid_edit.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::IsNan;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

Grid square(double from) {
  Grid grid;
  grid.nodes = {{from, 0}, {from + 1, 0}, {from + 1, 1}, {from, 1}};
  grid.triangles = {{0, 1, 2}, {0, 2, 3}};
  return grid;
}

NodeField field(const std::string& name, std::vector<double> values, double usual = kUnknown) {
  return {name, "1", 0, usual, std::move(values)};
}

TEST(NodeFields, FollowNodes) {
  Grid grid = square(0);
  grid.node_fields = {field("a", {10, 11, 12, 13}), field("b", {0, 1, 2, 3})};
  orderNodes(grid, {3, 1, 0, 2});
  EXPECT_THAT(grid.node_fields[0].values, ElementsAre(13, 11, 10, 12));
  EXPECT_EQ(addNodeBetween(grid, 0, 1, 0.25), 4u);
  EXPECT_EQ(copyNode(grid, 3, {7, 7}), 5u);
  EXPECT_EQ(addNode(grid, {8, 8}), 6u);
  EXPECT_THAT(grid.node_fields[1].values, ElementsAre(3, 1, 0, 2, 2.5, 2, ::testing::IsNan()));
  moveNode(grid, 2, 0, 3, 0.5);
  EXPECT_EQ(grid.node_fields[0].values[2], 10 + 0.5 * (12.5 - 10));
  removeNodes(grid, {false, false, false, false, true, true, true});
  EXPECT_THAT(grid.node_fields[1].values, ElementsAre(3, 1, 1.25, 2));
  EXPECT_NO_THROW(requireConsistent(grid));
  grid.node_fields[1].values.pop_back();
  EXPECT_THROW(requireConsistent(grid), std::logic_error);
}

TEST(NodeFields, OfAppendedGridsAreUnknownWhereOneHasNone) {
  Grid grid = square(0), part = square(5);
  grid.node_fields = {field("a", {1, 2, 3, 4}), field("b", {5, 6, 7, 8})};
  part.node_fields = {field("c", {1, 1, 1, 1}, 1), field("a", {9, 9, 9, 8})};
  appendGrid(grid, std::move(part));
  ASSERT_EQ(grid.node_fields.size(), 3u);
  EXPECT_THAT(findField(grid, "a")->values, ElementsAre(1, 2, 3, 4, 9, 9, 9, 8));
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(std::isnan(findField(grid, "b")->values[i]), i >= 4);
    EXPECT_EQ(std::isnan(findField(grid, "c")->values[i]), i < 4);
  }
  EXPECT_EQ(findField(grid, "c")->usual, 1.0);
}

TEST(NodeFields, MissingOnesGetTheirDefault) {
  Grid grid = square(0), other = square(5);
  other.node_fields = {field("a", {1, 2, 3, 4}, 0.5), field("b", {5, 6, 6, kUnknown}),
                       field("surface_canopy_coefficient", {0, 0, 0, 1})};
  EXPECT_THAT(addMissingFields(grid, other), ElementsAre("a", "b", "surface_canopy_coefficient"));
  EXPECT_THAT(findField(grid, "a")->values, ElementsAre(0.5, 0.5, 0.5, 0.5));
  EXPECT_THAT(findField(grid, "b")->values, ElementsAre(6, 6, 6, 6));
  EXPECT_THAT(findField(grid, "surface_canopy_coefficient")->values, ElementsAre(1, 1, 1, 1));
  EXPECT_THAT(addMissingFields(grid, other), IsEmpty());
}

TEST(NodeFields, StatesAreRoundedAndOthersAreNot) {
  Grid grid = square(0);
  grid.node_fields = {field("surface_submergence_state", {0.49, 0.5, 1, kUnknown}), field("a", {0.49, 0.5, 1, 0})};
  roundStates(grid);
  EXPECT_THAT(grid.node_fields[0].values, ElementsAre(0, 1, 1, IsNan()));
  EXPECT_THAT(grid.node_fields[1].values, ElementsAre(0.49, 0.5, 1, 0));
}

TEST(NodeFields, MostFrequentIsTheLeastOfSeveral) {
  EXPECT_EQ(mostFrequentOf(field("a", {3, 1, 2, 3, 1})), 1.0);
  EXPECT_EQ(mostFrequentOf(field("a", {kUnknown, kUnknown, 4})), 4.0);
  EXPECT_TRUE(std::isnan(mostFrequentOf(field("a", {kUnknown}))));
}

TEST(NodeFields, ComputedValuesHaveSevenDigits) {
  EXPECT_EQ(roundedValue(0.02500000037252903), 0.025);
  EXPECT_EQ(roundedValue(1.23456789e-9), 1.234568e-9);
  EXPECT_EQ(roundedValue(-123456789.0), -123456800.0);
  EXPECT_FALSE(std::signbit(roundedValue(-0.0)));
  EXPECT_TRUE(std::isnan(roundedValue(kUnknown)));
}

}  // namespace
}  // namespace coastmesh
