#include "gis/grid/frame_box.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gis/crs/crs.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Coastline boxAt60North() {
  Coastline coastline;
  coastline.crs = wgs84();
  coastline.framed_by_box = true;
  Feature frame;
  frame.use = FeatureUse::Frame;
  frame.polygons.resize(1);
  frame.polygons[0].outer = {{0.0, 59.0}, {1.0, 59.0}, {1.0, 60.0}, {0.0, 60.0}};
  coastline.features.push_back(frame);
  return coastline;
}

// A triangle half a metre wide; its middle node is 0.44 m outside the box. Its smallest angle is 24.8 degrees, and 21.8
// with that node on the box.
Grid tinyTriangleAtTheTop() {
  Grid grid;
  grid.crs = wgs84();
  grid.nodes = {{0.5, 60.0}, {0.500005, 59.999999}, {0.50001, 60.000004}};
  grid.triangles = {{0, 1, 2}};
  return grid;
}

TEST(KeepInFrame, NamesTrianglesThatItMakesFallShort) {
  Grid grid = tinyTriangleAtTheTop();
  const FrameMoves moves = keepInFrame(grid, boxAt60North(), 23.0);
  EXPECT_EQ(moves.nodes, 1u);
  EXPECT_EQ(grid.nodes[2].y, 60.0);
  EXPECT_THAT(moves.fell_short, ElementsAre(0u));
}

TEST(KeepInFrame, NamesNoneThatHoldsOrWasShortBefore) {
  for (const double min_angle_deg : {20.0, 30.0}) {
    Grid grid = tinyTriangleAtTheTop();
    const FrameMoves moves = keepInFrame(grid, boxAt60North(), min_angle_deg);
    EXPECT_EQ(moves.nodes, 1u);
    EXPECT_THAT(moves.fell_short, IsEmpty());
  }
}

}  // namespace
}  // namespace coastmesh
