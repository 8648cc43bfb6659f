// The land of a flood plain, told from the water by the coastline, and what of it lies below the water.
#include "gis/flood_plain/plain_land.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/metric.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/flood_plain/low_land.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/framed_coasts.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::lattice;

// Land from x = 50 on in a frame from (0, 0) to (100, 60), with a lake.
PlainLand landInTheEast() {
  const Framed framed = frame(coastlineOf({polygonFeature(1, {{50, -10}, {150, -10}, {150, 70}, {50, 70}},
                                                          {{{60, 20}, {70, 20}, {70, 30}, {60, 30}}})}),
                              boxOf(0, 0, 100, 60, DomainSide::Outside));
  return PlainLand(framed.domains);
}

TEST(PlainLand, WhatIsInNoWater) {
  const PlainLand land = landInTheEast();
  EXPECT_FALSE(land.isLand({25, 30}));
  EXPECT_FALSE(land.isLand({49.9, 1e-9}));
  EXPECT_FALSE(land.isLand({0.1, 59.9}));
  EXPECT_FALSE(land.isLand({65, 25}));
  EXPECT_TRUE(land.isLand({50.1, 30}));
  EXPECT_TRUE(land.isLand({65, 35}));
  EXPECT_TRUE(land.isLand({65, 15}));
  EXPECT_TRUE(land.isLand({99, 59}));
}

// Pieces of a side along 60 degrees north, in whose plane they run north of the parallel by metres.
TEST(PlainLand, SidesAreStraightInTheWorkingPlane) {
  FrameOptions outside;
  outside.side = DomainSide::Outside;
  const Framed framed = frame(coastlineOf({polygonFeature(1, {{11, 50}, {20, 50}, {20, 70}, {11, 70}}),
                                           frameFeature(2, {{0, 58}, {12, 57}, {12, 60}, {0, 60}})},
                                          wgs84()),
                              outside);
  const PlainLand land(framed.domains);
  const Domain& domain = framed.domains.front();
  std::size_t pieces = 0;
  for (const Segment& s : domain.pslg.segments) {
    if (domain.input_points[s.a].y != 60.0 || domain.input_points[s.b].y != 60.0) continue;
    ++pieces;
    const Point middle = 0.5 * (domain.pslg.points[s.a] + domain.pslg.points[s.b]);
    const Point within = domain.projection.inverse(middle - Point{0.0, 1.0});
    EXPECT_GT(within.y, 60.00003);
    EXPECT_FALSE(land.isLand(within)) << within.x;
    EXPECT_TRUE(land.isLand(domain.projection.inverse(middle + Point{0.0, 1.0}))) << within.x;
  }
  EXPECT_GT(pieces, 10u);
}

// Squares of ten metres over the frame, with the coast as a line of edges.
Grid squares() {
  const TriMesh mesh = lattice(10, 6, [](int, int) { return true; });
  Grid grid;
  for (const Point& p : mesh.points) grid.nodes.push_back(10.0 * p);
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  return grid;
}

TEST(PlainLand, NodesAtTheCoastAreWater) {
  const Grid grid = squares();
  const PlainLand land = landInTheEast();
  EXPECT_TRUE(landFlags(grid, nullptr).nodes.empty());
  EXPECT_FALSE(landFlags(grid, nullptr).isLandNode(0));
  const LandFlags flags = landFlags(grid, &land);
  for (std::size_t v = 0; v < grid.nodes.size(); ++v) {
    const Point& p = grid.nodes[v];
    const bool at_lake = p.x >= 60 && p.x <= 70 && p.y >= 20 && p.y <= 30;
    EXPECT_EQ(flags.isLandNode(v), p.x > 50 && !at_lake) << p.x << " " << p.y;
  }
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    const auto& [a, b, c] = grid.triangles[t];
    const Point middle = (1.0 / 3.0) * (grid.nodes[a] + grid.nodes[b] + grid.nodes[c]);
    const bool in_lake = middle.x > 60 && middle.x < 70 && middle.y > 20 && middle.y < 30;
    EXPECT_EQ(flags.triangles[t] != 0, middle.x > 50 && !in_lake);
  }
}

// In a water that is narrower than the elements, a node on it is water.
TEST(PlainLand, ANodeInANarrowWaterIsWater) {
  const Framed framed = frame(coastlineOf({polygonFeature(1, {{50, -10}, {150, -10}, {150, 70}, {50, 70}},
                                                          {{{79, 39}, {81, 39}, {81, 41}, {79, 41}}})}),
                              boxOf(0, 0, 100, 60, DomainSide::Outside));
  const PlainLand land(framed.domains);
  const Grid grid = squares();
  const LandFlags flags = landFlags(grid, &land);
  for (std::size_t v = 0; v < grid.nodes.size(); ++v)
    if (grid.nodes[v].x > 50) {
      EXPECT_EQ(flags.isLandNode(v), !(grid.nodes[v] == Point{80, 40}));
    }
}

// Water 5 m deep, and a dike along x = 60; behind it a polder up to x = 80 at one metre below the water, at x = 90 two.
Grid polder() {
  Grid grid = squares();
  for (const Point& p : grid.nodes)
    grid.z.push_back(p.x <= 50 ? -5.0 : p.x <= 60 ? 4.0 : p.x <= 80 ? -1.0 : p.x <= 90 ? -2.0 : 3.0);
  return grid;
}

TEST(LowLand, APolderBehindADikeIsApart) {
  Grid grid = polder();
  const Framed framed = frame(coastlineOf({polygonFeature(1, {{50, -10}, {150, -10}, {150, 70}, {50, 70}})}),
                              boxOf(0, 0, 100, 60, DomainSide::Outside));
  const PlainLand land(framed.domains);
  const LowLand low = findLowLand(grid, landFlags(grid, &land));
  EXPECT_EQ(low.apart.size(), 3u * 7u);
  EXPECT_EQ(low.connected, 0u);
  EXPECT_EQ(low.lowest_m, 2.0);
  EXPECT_EQ(low.lowest, (Point{90, 0}));
  EXPECT_THAT(noteOf(low, false), HasSubstr("21 nodes of the flood plain lie below the still water without a"));
  EXPECT_THAT(noteOf(low, false), HasSubstr("the lowest by 2 m at (90, 0): models start them wet"));
  EXPECT_THAT(noteOf(low, true), HasSubstr("surface_submergence_state is 1 there"));
  markStartDry(grid, low);
  const NodeField* const field = findField(grid, "surface_submergence_state");
  ASSERT_NE(field, nullptr);
  EXPECT_EQ(field->usual, 0.0);
  for (std::size_t v = 0; v < grid.nodes.size(); ++v)
    EXPECT_EQ(field->values[v], grid.nodes[v].x > 60 && grid.nodes[v].x < 100 ? 1.0 : 0.0);
}

TEST(LowLand, WhatIsConnectedWithTheWaterThroughLowTrianglesIsNotApart) {
  Grid grid = polder();
  const Framed framed = frame(coastlineOf({polygonFeature(1, {{50, -10}, {150, -10}, {150, 70}, {50, 70}})}),
                              boxOf(0, 0, 100, 60, DomainSide::Outside));
  const PlainLand land(framed.domains);
  const auto zAt = [&](double x, double y) -> double& {
    return grid.z[static_cast<std::size_t>(std::ranges::find(grid.nodes, Point{x, y}) - grid.nodes.begin())];
  };
  zAt(60, 20) = -1.0;
  const LowLand gap = findLowLand(grid, landFlags(grid, &land));
  EXPECT_TRUE(gap.apart.empty());
  EXPECT_EQ(gap.connected, 3u * 7u + 1u);
  EXPECT_EQ(noteOf(gap, true), "");
  zAt(50, 10) = zAt(50, 30) = 1.0;  // an edge between low nodes is left, but no triangle
  const LowLand bar = findLowLand(grid, landFlags(grid, &land));
  EXPECT_EQ(bar.apart.size(), 3u * 7u + 1u);
  EXPECT_EQ(bar.connected, 0u);
}

}  // namespace
}  // namespace coastmesh
