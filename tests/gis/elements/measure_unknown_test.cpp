#include "gis/elements/measure_unknown.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gis/elements/quads.hpp"

namespace coastmesh {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// A rectangle of 3 by 1 as a quadrilateral, and a right triangle beside it.
Grid rectangle() {
  Grid grid;
  grid.nodes = {{0, 0}, {3, 0}, {3, 1}, {0, 1}, {4, 0}};
  addElement(grid, std::array{0u, 1u, 2u, 3u});
  addElement(grid, std::array{1u, 4u, 2u});
  return grid;
}

TEST(MeasureUnknown, HalvesHaveTheAngleOfTheirQuadrilateral) {
  Grid grid = rectangle();
  grid.min_angle_deg.assign(3, kUnknown);
  grid.area_m2.assign(3, kUnknown);
  measureUnknown(grid);
  for (const std::size_t half : {0u, 1u}) {
    EXPECT_NEAR(grid.min_angle_deg[half], 90.0, 1e-9);
    EXPECT_DOUBLE_EQ(grid.area_m2[half], 1.5);
  }
  EXPECT_NEAR(grid.min_angle_deg[2], 45.0, 1e-9);
  EXPECT_DOUBLE_EQ(grid.area_m2[2], 0.5);
}

TEST(MeasureUnknown, WhatIsKnownStays) {
  Grid grid = rectangle();
  measureUnknown(grid);
  EXPECT_TRUE(grid.min_angle_deg.empty());
  EXPECT_TRUE(grid.area_m2.empty());
  grid.min_angle_deg.assign(3, 7.0);
  grid.min_angle_deg[2] = kUnknown;
  grid.area_m2.assign(3, 5.0);
  measureUnknown(grid);
  EXPECT_EQ(grid.min_angle_deg[0], 7.0);
  EXPECT_NEAR(grid.min_angle_deg[2], 45.0, 1e-9);
  EXPECT_EQ(grid.area_m2[2], 5.0);
}

}  // namespace
}  // namespace coastmesh
