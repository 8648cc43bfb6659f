// Straits are as wide as in the data, whatever was removed beside them.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "gis/follow/coast_follow.hpp"
#include "tests/support/followed_coasts.hpp"

namespace coastmesh {
namespace {

struct Way {
  double x = 0.0, y = 0.0, width = 0.0;
};

// The connection of the n-th water that is cut off.
Way wayBehind(const CleanReport& report, std::size_t n = 0) {
  Way way;
  const NotedWaters& waters = report.waters.cut_off;
  if (n >= waters.largest.size()) {
    ADD_FAILURE() << "no water " << n << " is cut off";
    return way;
  }
  const std::string& text = waters.largest[n].after;
  const std::size_t at = text.find(", behind");
  EXPECT_EQ(std::sscanf(at == std::string::npos ? "" : text.c_str() + at, ", behind water %lf wide at (%lf, %lf)",
                        &way.width, &way.x, &way.y),
            3)
      << text;
  return way;
}

// The strait of the only water that is joined.
Way wayJoined(const CleanReport& report) {
  Way way;
  EXPECT_EQ(report.waters.joined.count, 1u);
  if (report.waters.joined.count != 1) return way;
  const std::string& text = report.waters.joined.largest[0].before;
  EXPECT_EQ(std::sscanf(text.c_str(), "(%lf, %lf), %lf wide", &way.x, &way.y, &way.width), 3) << text;
  return way;
}

// A sea of 80 by 40, and a spit as thick as 1 that leaves a strait as wide as 1 at its northern end.
Domain seaWithASpit() {
  Domain domain;
  addShore(domain, {{0, 0}, {39, 0}, {39, 39}, {40, 39}, {40, 0}, {80, 0}, {80, 40}, {0, 40}});
  return domain;
}

TEST(DataStraits, AnElementWiderThanASpitDoesNotOpenTheStraitBesideIt) {
  for (const double size : {1.2, 1.6, 2.0, 2.4, 2.6, 3.0, 3.5, 4.0, 5.0, 6.0}) {
    CleanReport report;
    const Domain coarse = followSizes(seaWithASpit(), ConstantSize(size), {.strait_min = 0.4}, oneFeature(), report);
    const bool joined = 1.0 / size >= 0.4;
    EXPECT_EQ(parts(coarse), joined ? 1u : 2u) << size;
    EXPECT_EQ(report.waters.cut_off.count, joined ? 0u : 1u) << size;
    const Way way = joined ? wayJoined(report) : wayBehind(report);
    EXPECT_NEAR(way.width, 1.0, 1e-3) << size;
    EXPECT_NEAR(way.x, 39.5, 1.0) << size;
    EXPECT_NEAR(way.y, 39.5, 0.01) << size;
  }
}

// A wide opening in the spit's middle is the connection, whatever the strait at its end.
TEST(DataStraits, ASpitIsRemovedWhereTheDataConnectTheWatersBesideIt) {
  Domain domain;
  addShore(domain, {{0, 0}, {39, 0}, {39, 30}, {40, 30}, {40, 0}, {80, 0}, {80, 40}, {0, 40}});
  CleanReport report;
  const Domain coarse = followSizes(std::move(domain), ConstantSize(4.0), {.strait_min = 0.4}, oneFeature(), report);
  EXPECT_EQ(parts(coarse), 1u);
  EXPECT_EQ(countOf(report, EditKind::DroppedSpit), 1u);
  EXPECT_EQ(report.waters.joined.count, 0u);
}

// A tooth that is removed as too fine narrows the channel from 1 to 0.6.
TEST(DataStraits, DetailFinerThanAnElementCounts) {
  for (const double size : {3.0, 4.0, 5.0}) {
    Domain domain;
    addShore(domain, {{0, 0},
                      {20, 0},
                      {20, 9.5},
                      {24.9, 9.5},
                      {25, 9.9},
                      {25.1, 9.5},
                      {30, 9.5},
                      {30, 0},
                      {50, 0},
                      {50, 20},
                      {30, 20},
                      {30, 10.5},
                      {20, 10.5},
                      {20, 20},
                      {0, 20}});
    CleanReport report;
    followSizes(std::move(domain), ConstantSize(size), {.strait_min = 0.4}, oneFeature(), report);
    const Way way = wayBehind(report);
    EXPECT_NEAR(way.width, 0.6, 1e-3) << size;
    EXPECT_NEAR(way.x, 25.0, 0.1) << size;
  }
}

// Three lakes in a row, the largest first, joined by channels as wide as these.
Domain threeLakes(double first, double second) {
  Domain domain;
  addShore(domain, {{0, 0},
                    {30, 0},
                    {30, 10 - first / 2},
                    {40, 10 - first / 2},
                    {40, 0},
                    {60, 0},
                    {60, 10 - second / 2},
                    {70, 10 - second / 2},
                    {70, 0},
                    {88, 0},
                    {88, 20},
                    {70, 20},
                    {70, 10 + second / 2},
                    {60, 10 + second / 2},
                    {60, 20},
                    {40, 20},
                    {40, 10 + first / 2},
                    {30, 10 + first / 2},
                    {30, 20},
                    {0, 20}});
  return domain;
}

TEST(DataStraits, TheNarrowestOnTheWayIsNamed) {
  for (const auto& [first, second] : {std::pair(1.2, 0.8), std::pair(0.8, 1.2)}) {
    CleanReport report;
    followSizes(threeLakes(first, second), ConstantSize(3.5), {.strait_min = 0.4}, oneFeature(), report);
    ASSERT_EQ(report.waters.cut_off.count, 2u);
    const Way near = wayBehind(report, 0), far = wayBehind(report, 1);
    EXPECT_NEAR(near.width, first, 1e-3);
    EXPECT_NEAR(near.x, 35.0, 5.1);
    EXPECT_NEAR(far.width, 0.8, 1e-3);
    EXPECT_NEAR(far.x, second < first ? 65.0 : 35.0, 5.1);
  }
}

// With an island in the middle of the channel, smaller than an element, the wider channel beside it counts; a rock
// does not.
TEST(DataStraits, IslandsSmallerThanAnElementDivideStraits) {
  for (const double side : {0.1, 1.0}) {
    Domain domain = twoLakes(3.0);
    const double low = 9.8 - side / 2, high = low + side, west = 25 - side / 2, east = west + side;
    addShore(domain, {{west, low}, {west, high}, {east, high}, {east, low}});
    CleanReport report;
    const Domain coarse = followSizes(std::move(domain), ConstantSize(4.0), {.strait_min = 0.4}, oneFeature(), report);
    const bool divides = side == 1.0;
    EXPECT_EQ(parts(coarse), divides ? 2u : 1u);
    const Way way = divides ? wayBehind(report) : wayJoined(report);
    EXPECT_NEAR(way.width, divides ? 1.2 : 3.0, 1e-3);
  }
}

// Both channels around an island are as wide as in the data, however much is removed of the land beside one.
TEST(DataStraits, ClosedStraitsAreAsWideAsInTheData) {
  Domain domain;
  addShore(domain, {{0, 0}, {60, 0}, {60, 20}, {0, 20}});
  addShore(domain, {{10, 0.7}, {10, 10}, {50, 10}, {50, 0.7}});
  CleanReport report;
  followSizes(std::move(domain), ConstantSize(3.0), {.strait_min = 0.4}, oneFeature(), report);
  ASSERT_EQ(report.waters.straits.count, 1u);
  const std::string& text = report.waters.straits.longest[0].text;
  double width = 0.0;
  ASSERT_EQ(std::sscanf(text.c_str() + text.find("long"), "long, %lf wide", &width), 1) << text;
  EXPECT_NEAR(width, 0.7, 1e-3);
}

}  // namespace
}  // namespace coastmesh
