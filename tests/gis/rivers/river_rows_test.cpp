#include "gis/rivers/river_rows.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "core/metric.hpp"
#include "core/predicates.hpp"

namespace coastmesh {
namespace {

RiverReach reachOf(const PlaneRiver& river) {
  RiverReach reach{0, 1, river.points, {}};
  reach.line_of.assign(river.points.size() - 1, 0);
  return reach;
}

RiverCourse courseOf(const PlaneRiver& river) { return {reachOf(river), RiverWidths(std::span(&river, 1))}; }

void expectConvex(const RiverRows& rows) {
  ASSERT_EQ(rows.nodes.size(), rows.sections.size() * (rows.cells + 1));
  for (std::size_t row = 0; row + 1 < rows.sections.size(); ++row)
    for (std::size_t i = 0; i < rows.cells; ++i) {
      const std::array corners{rows.node(row, i), rows.node(row + 1, i), rows.node(row + 1, i + 1),
                               rows.node(row, i + 1)};
      for (unsigned k = 0; k < 4; ++k)
        EXPECT_GT(orient2d(corners[k], corners[(k + 1) % 4], corners[(k + 2) % 4]), 0) << "row " << row;
    }
}

TEST(RiverRows, OfAStraightReachAreRectangles) {
  const RiverCourse course = courseOf({{{0, 0}, {600, 0}}, 40.0});
  EXPECT_EQ(course.moved(), 0.0);
  const RiverRows rows = riverRows(course, 0.0, course.length(), 2, 3.0);
  expectConvex(rows);
  ASSERT_EQ(rows.sections.size(), 11u);
  for (std::size_t row = 0; row < rows.sections.size(); ++row)
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(rows.node(row, i).x, 60.0 * double(row), 1e-9);
      EXPECT_NEAR(rows.node(row, i).y, 20.0 * double(i) - 20.0, 1e-9);
    }
}

TEST(RiverCourse, SharpTurnsAreRoundedAndTheRestStays) {
  const RiverCourse course = courseOf({{{0, 0}, {1000, 0}, {1000, 1000}}, 100.0});
  EXPECT_GT(course.moved(), 5.0);
  EXPECT_LT(course.moved(), 60.0);
  EXPECT_LT(distance(course.movedPlace(), {1000, 0}), 60.0);
  for (const double along : {100.0, 500.0}) EXPECT_NEAR(course.sectionAt(along).place.y, 0.0, 1e-9);
  expectConvex(riverRows(course, 0.0, course.length(), 3, 4.0));
}

TEST(RiverRows, GrowGraduallyOutOfABend) {
  const RiverCourse course = courseOf({{{0, 0}, {4000, 0}, {6000, 3464}}, 350.0});
  const RiverRows rows = riverRows(course, 0.0, course.length(), 2, 3.0);
  double shortest = 1e9, longest = 0.0;
  for (std::size_t row = 0; row + 2 < rows.sections.size(); ++row) {
    const double here = distance(rows.sections[row].place, rows.sections[row + 1].place);
    const double next = distance(rows.sections[row + 1].place, rows.sections[row + 2].place);
    EXPECT_LT(std::max(here, next), 1.8 * std::min(here, next)) << "row " << row;
    shortest = std::min(shortest, here);
    longest = std::max(longest, here);
  }
  EXPECT_GT(longest, 2.5 * shortest);
}

TEST(RiverCourse, StepsOfARasterAreSmoothed) {
  PlaneRiver river{{}, 100.0};
  for (int i = 0; i < 60; ++i) {
    river.points.push_back({30.0 * i, 30.0 * i});
    river.points.push_back({30.0 * i + 30.0, 30.0 * i});
  }
  const RiverCourse course = courseOf(river);
  EXPECT_LT(course.moved(), 30.0);
  expectConvex(riverRows(course, 0.0, course.length(), 2, 3.0));
}

TEST(RiverCourse, WidthsOfLinesThatFollowOneAnotherChangeGradually) {
  const std::vector<PlaneRiver> rivers{{{{0, 0}, {2000, 0}}, 400.0}, {{{2000, 0}, {4000, 0}}, 100.0}};
  const RiverCourse course({0, 1, {{0, 0}, {2000, 0}, {4000, 0}}, {0, 1}}, RiverWidths(rivers));
  EXPECT_NEAR(course.sectionAt(0.0).width, 400.0, 1e-9);
  EXPECT_NEAR(course.sectionAt(3000.0).width, 100.0, 1e-9);
  EXPECT_NEAR(course.sectionAt(1000.0).width, 300.0, 10.0);
  EXPECT_EQ(course.sectionAt(500.0).line, 0u);
  EXPECT_EQ(course.sectionAt(3500.0).line, 1u);
}

TEST(RiverRows, OfAnyWalkAreConvex) {
  std::mt19937 random(7);
  std::normal_distribution<double> turn(0.0, 0.5);
  for (int walk = 0; walk < 40; ++walk) {
    PlaneRiver river{{{0, 0}}, 20.0 + 10.0 * walk};
    double heading = 0.0;
    for (int i = 0; i < 200; ++i) {
      heading += turn(random);
      river.points.push_back(river.points.back() + 40.0 * Point{std::cos(heading), std::sin(heading)});
    }
    const RiverCourse course = courseOf(river);
    expectConvex(riverRows(course, 0.0, course.length(), 1 + static_cast<std::size_t>(walk % 4), 2.5));
  }
}

}  // namespace
}  // namespace coastmesh
