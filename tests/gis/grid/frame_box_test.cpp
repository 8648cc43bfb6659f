#include "gis/grid/frame_box.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/quality.hpp"
#include "gis/crs/crs.hpp"
#include "gis/grid/local_plane.hpp"

namespace coastmesh {
namespace {

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

// A triangle half a metre wide; its last node is 0.44 m outside the box. Its angles are from 24.8 to 94.8 degrees, and
// from 21.8 to 136.4 with that node on the box.
Grid tinyTriangleAtTheTop() {
  Grid grid;
  grid.crs = wgs84();
  grid.nodes = {{0.5, 60.0}, {0.500005, 59.999999}, {0.50001, 60.000004}};
  grid.triangles = {{0, 1, 2}};
  return grid;
}

TEST(KeepInFrame, MovesNodesOntoTheBox) {
  Grid grid = tinyTriangleAtTheTop();
  grid.min_angle_deg = {24.8};
  const FrameMoves moves = keepInFrame(grid, boxAt60North(), {20.0, 180.0});
  EXPECT_EQ(moves.nodes, 1u);
  EXPECT_EQ(grid.nodes[2].y, 60.0);
  ASSERT_EQ(moves.angles_before.size(), 1u);
  ASSERT_EQ(moves.angles_after.size(), 1u);
  EXPECT_NEAR(std::ranges::min(moves.angles_before[0]), 24.8, 0.1);
  EXPECT_NEAR(std::ranges::max(moves.angles_after[0]), 136.4, 0.1);
  EXPECT_EQ(grid.min_angle_deg[0], std::ranges::min(moves.angles_after[0]));
}

TEST(KeepInFrame, LeavesNodesIfATriangleWouldBreakABound) {
  // 30 degrees: it has less already, which must not become worse.
  for (const AngleBounds bounds : {AngleBounds{23.0, 180.0}, AngleBounds{30.0, 180.0}, AngleBounds{20.0, 120.0}}) {
    Grid grid = tinyTriangleAtTheTop();
    EXPECT_EQ(keepInFrame(grid, boxAt60North(), bounds).nodes, 0u);
    EXPECT_EQ(grid.nodes, tinyTriangleAtTheTop().nodes);
  }
}

// With both nodes on the box, both triangles would be crushed; with the middle one beyond it, both hold.
TEST(KeepInFrame, OtherNodesOfATriangleMayMove) {
  Grid grid = tinyTriangleAtTheTop();
  grid.nodes.push_back({0.500015, 60.000003});
  grid.triangles.push_back({1, 3, 2});
  const Point beyond = grid.nodes[2];
  keepInFrame(grid, boxAt60North(), {23.0, 180.0});
  EXPECT_EQ(grid.nodes[2], beyond);
  for (const auto& triangle : grid.triangles) {
    const auto p = localPlane(grid, triangle);
    EXPECT_GE(leastAngleDeg(p[0], p[1], p[2]), 23.0);
  }
}

}  // namespace
}  // namespace coastmesh
