#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "core/delaunay.hpp"
#include "core/metric.hpp"
#include "gis/follow/coast_follow.hpp"
#include "tests/support/followed_coasts.hpp"
#include "tests/support/mesh_checks.hpp"

namespace coastmesh {
namespace {

// A sea of side 60 and an island along its southern shore, 30 long, with a strait 1 wide between them.
Domain seaWithStrait() {
  Domain domain;
  addShore(domain, {{0, 0}, {60, 0}, {60, 60}, {0, 60}});
  addShore(domain, {{15, 1}, {15, 11}, {45, 11}, {45, 1}});
  return domain;
}

TEST(FollowSizes, AStraitThatIsClosedIsNamedThoughNothingIsCutOff) {
  CleanReport report;
  const Domain coarse = followSizes(seaWithStrait(), ConstantSize(2.0), {}, oneFeature(), report);
  EXPECT_EQ(boundaryLoops(constrainedDelaunay(coarse.pslg)).size(), 1u);
  ASSERT_EQ(report.notes.size(), 1u);
  double x = 0.0, y = 0.0, length = 0.0, width = 0.0;
  ASSERT_EQ(std::sscanf(report.notes[0].c_str(),
                        "straits closed, the longest of 1: (%lf, %lf), about %lf long, %lf wide; keep it", &x, &y,
                        &length, &width),
            4)
      << report.notes[0];
  EXPECT_NEAR(x, 30.0, 2.0);
  EXPECT_NEAR(y, 0.5, 0.5);
  EXPECT_NEAR(length, 30.0, 3.0);
  EXPECT_NEAR(width, 1.0, 0.3);
  EXPECT_NE(report.notes[0].find("--passages"), std::string::npos);
}

TEST(FollowSizes, APassageStaysOpenAndIsWidened) {
  for (const double elements : {1.0, 2.0}) {
    CleanReport report;
    const ShoreGuides guides{{{{{5, 0.5}, {55, 0.5}}, "narrows", elements}}, {}};
    const Domain coarse = followSizes(seaWithStrait(), ConstantSize(2.0), {}, oneFeature(), report, guides);
    EXPECT_EQ(boundaryLoops(constrainedDelaunay(coarse.pslg)).size(), 2u);
    EXPECT_EQ(countOf(report, EditKind::WidenedPassage), 1u);
    ASSERT_EQ(report.notes.size(), 1u);
    EXPECT_NE(report.notes[0].find("passage 'narrows' was widened to " + std::string(elements == 1.0 ? "2" : "4")),
              std::string::npos)
        << report.notes[0];
    double width = 1e300;
    for (const Point& p : coarse.pslg.points) {
      if (p.x < 10 || p.x > 50 || p.y < 0.6 || p.y > 8) continue;
      for (const Segment& segment : coarse.pslg.segments) {
        const Point &a = coarse.pslg.points[segment.a], &b = coarse.pslg.points[segment.b];
        if (a.y < 0.6 && b.y < 0.6) width = std::min(width, std::sqrt(squaredDistanceToSegment(p, a, b)));
      }
    }
    EXPECT_GE(width, 0.8 * 2.0 * elements);
    EXPECT_LE(width, 1.5 * 2.0 * elements);
  }
}

TEST(FollowSizes, APassageThatIsWideEnoughChangesNothingAndOneOnLandIsSaidToBeSo) {
  CleanReport plain, guided;
  const ShoreGuides guides{{{{{5, 25}, {55, 25}}, "", 2.0}, {{{20, 5}, {40, 5}}, "", 2.0}}, {}};
  const Domain before = followSizes(seaWithStrait(), ConstantSize(2.0), {}, oneFeature(), plain);
  const Domain after = followSizes(seaWithStrait(), ConstantSize(2.0), {}, oneFeature(), guided, guides);
  EXPECT_EQ(after.pslg.points, before.pslg.points);
  EXPECT_EQ(countOf(guided, EditKind::WidenedPassage), 0u);
  ASSERT_EQ(guided.notes.size(), plain.notes.size() + 1);
  EXPECT_NE(guided.notes[0].find("passage 2 meets no water"), std::string::npos) << guided.notes[0];
}

TEST(FollowSizes, APassageIsCutThroughLand) {
  Domain domain;
  addShore(domain, {{0, 0}, {20, 0}, {20, 20}, {0, 20}});
  addShore(domain, {{30, 0}, {50, 0}, {50, 20}, {30, 20}});
  CleanReport report;
  const ShoreGuides guides{{{{{-5, 10}, {60, 10}}, ""}}, {}};
  const Domain coarse = followSizes(std::move(domain), ConstantSize(2.0), {}, oneFeature(), report, guides);
  EXPECT_EQ(parts(coarse), 1u);
  for (const Point& p : coarse.pslg.points) EXPECT_TRUE(p.x > -1.0 && p.x < 51.0) << p.x;  // not beyond the last water
}

TEST(FollowSizes, ABarrierClosesTheWaterItCrosses) {
  CleanReport open, report;
  const ShoreGuides guides{{}, {{{{25, 4}, {25, 16}}, ""}}};
  EXPECT_EQ(parts(followSizes(twoLakes(5.0), ConstantSize(2.0), {}, oneFeature(), open)), 1u);
  const Domain closed = followSizes(twoLakes(5.0), ConstantSize(2.0), {}, oneFeature(), report, guides);
  EXPECT_EQ(parts(closed), 2u);
  EXPECT_EQ(countOf(report, EditKind::Barrier), 1u);
  CleanReport one;
  EXPECT_EQ(
      parts(followSizes(twoLakes(5.0), ConstantSize(2.0), {.keep = KeepWater::Largest}, oneFeature(), one, guides)),
      1u);
}

TEST(FollowSizes, ABarrierThatClosesNothingIsSaidTo) {
  const auto notesOf = [](std::vector<ShoreLine> barriers) {
    CleanReport report;
    followSizes(twoLakes(5.0), ConstantSize(2.0), {}, oneFeature(), report, ShoreGuides{{}, std::move(barriers)});
    std::erase_if(report.notes, [](const std::string& note) { return !note.starts_with("barrier "); });
    return report.notes;
  };
  // Across the channel, to the land beside it; then also with an end that touches another.
  EXPECT_TRUE(notesOf({{{{25, 4}, {25, 16}}, ""}}).empty());
  EXPECT_TRUE(notesOf({{{{10, -2}, {10, 10}}, ""}, {{{10.5, 10}, {10.5, 22}}, ""}}).empty());
  const auto short_of = notesOf({{{{10, -2}, {10, 10}}, "mole"}});
  ASSERT_EQ(short_of.size(), 1u);
  EXPECT_EQ(short_of[0].find("barrier 'mole' ends in the water, at (10, 10), an element or more"), 0u) << short_of[0];
  const auto dry = notesOf({{{{25, 4}, {25, 16}}, ""}, {{{25, 30}, {25, 40}}, ""}});
  ASSERT_EQ(dry.size(), 1u);
  EXPECT_EQ(dry[0].find("barrier 2 meets no water here"), 0u) << dry[0];
}

}  // namespace
}  // namespace coastmesh
