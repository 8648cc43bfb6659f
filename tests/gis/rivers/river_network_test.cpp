#include "gis/rivers/river_network.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace coastmesh {
namespace {

std::vector<std::size_t> degreesOf(const RiverNetwork& network) {
  std::vector<std::size_t> degrees(network.nodes.size(), 0);
  for (const RiverReach& reach : network.reaches) {
    ++degrees[reach.from];
    ++degrees[reach.to];
  }
  std::ranges::sort(degrees);
  return degrees;
}

void expectSound(const RiverNetwork& network) {
  for (const RiverReach& reach : network.reaches) {
    ASSERT_GE(reach.points.size(), 2u);
    EXPECT_EQ(reach.line_of.size(), reach.points.size() - 1);
    EXPECT_EQ(reach.points.front(), network.nodes[reach.from]);
    EXPECT_EQ(reach.points.back(), network.nodes[reach.to]);
    for (std::size_t i = 0; i + 1 < reach.points.size(); ++i) EXPECT_FALSE(reach.points[i] == reach.points[i + 1]);
  }
}

TEST(RiverNetwork, LinesThatFollowOneAnotherAreOneReachInEitherDirection) {
  const std::vector<PlaneRiver> rivers{
      {{{0, 0}, {10, 0}}, 2.0}, {{{20, 0.5}, {10.4, 0.3}}, 2.0}, {{{20, 0.5}, {30, 5}}, 1.0}};
  const RiverNetwork network = riverNetwork(rivers);
  expectSound(network);
  ASSERT_EQ(network.reaches.size(), 1u);
  EXPECT_THAT(network.reaches[0].line_of,
              ::testing::AnyOf(::testing::ElementsAre(0, 1, 2), ::testing::ElementsAre(2, 1, 0)));
}

TEST(RiverNetwork, ALineThatAsWideAsItIsEndsInAnotherJoinsIt) {
  const PlaneRiver main{{{0, 0}, {100, 0}}, 10.0};
  const RiverNetwork joined = riverNetwork(std::vector{main, PlaneRiver{{{50, 40}, {50, 5.9}}, 2.0}});
  expectSound(joined);
  EXPECT_THAT(degreesOf(joined), ::testing::ElementsAre(1, 1, 1, 3));
  const RiverNetwork apart = riverNetwork(std::vector{main, PlaneRiver{{{50, 40}, {50, 6.1}}, 2.0}});
  expectSound(apart);
  EXPECT_THAT(degreesOf(apart), ::testing::ElementsAre(1, 1, 1, 1));
}

TEST(RiverNetwork, TheMainRiverKeepsItsCourseAtAJunction) {
  const RiverNetwork network =
      riverNetwork(std::vector{PlaneRiver{{{0, 0}, {100, 0}}, 10.0}, PlaneRiver{{{50, 40}, {51, -3}}, 2.0}});
  for (const Point& node : network.nodes)
    if (node.x > 10 && node.x < 90 && node.y < 30) {
      EXPECT_EQ(node.y, 0.0);
    }
}

TEST(RiverNetwork, LinesThatCrossAreJoined) {
  const RiverNetwork network =
      riverNetwork(std::vector{PlaneRiver{{{0, 0}, {100, 0}}, 2.0}, PlaneRiver{{{40, -30}, {60, 30}}, 2.0}});
  expectSound(network);
  EXPECT_THAT(degreesOf(network), ::testing::ElementsAre(1, 1, 1, 1, 4));
}

TEST(RiverNetwork, ALineThatCrossesItselfMakesALoop) {
  const RiverNetwork network =
      riverNetwork(std::vector{PlaneRiver{{{0, 0}, {100, 0}, {100, 50}, {50, 50}, {50, -50}}, 2.0}});
  expectSound(network);
  EXPECT_THAT(degreesOf(network), ::testing::ElementsAre(1, 1, 4));
}

TEST(RiverNetwork, ALineGivenTwiceIsThereOnce) {
  const PlaneRiver river{{{0, 0}, {60, 10}, {100, 0}}, 5.0};
  const RiverNetwork network = riverNetwork(std::vector{river, PlaneRiver{{{0, 0}, {30, 5}, {60, 10}, {100, 0}}, 5.0}});
  expectSound(network);
  EXPECT_EQ(network.reaches.size(), 1u);
  EXPECT_THAT(network.within, ::testing::ElementsAre(1));
}

TEST(RiverNetwork, WhatOfALineRunsWithinAWiderOneBelongsToThat) {
  // A tributary that is drawn on to the mouth.
  const RiverNetwork network = riverNetwork(
      std::vector{PlaneRiver{{{40, 50}, {50, 2}, {60, -1}, {100, 1}}, 4.0}, PlaneRiver{{{0, 0}, {100, 0}}, 20.0}});
  expectSound(network);
  EXPECT_THAT(network.within, ::testing::IsEmpty());
  EXPECT_THAT(degreesOf(network), ::testing::ElementsAre(1, 1, 1, 3));
  for (const RiverReach& reach : network.reaches) {
    if (reach.line_of.front() != 0) continue;
    EXPECT_EQ(reach.line_of.back(), 0u);
    for (const Point& p : reach.points) EXPECT_LT(p.x, 55.0);
  }
}

TEST(RiverNetwork, ARingWithoutJunctionsHasOneNode) {
  const RiverNetwork network = riverNetwork(std::vector{PlaneRiver{{{0, 0}, {100, 0}, {50, 90}, {0, 0}}, 2.0}});
  expectSound(network);
  EXPECT_THAT(degreesOf(network), ::testing::ElementsAre(2));
}

}  // namespace
}  // namespace coastmesh
