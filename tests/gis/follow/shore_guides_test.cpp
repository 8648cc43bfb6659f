#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/follow/coast_follow.hpp"
#include "tests/support/followed_coasts.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/size_figures.hpp"

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
  addWaterNotes(report, {});
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

TEST(FollowSizes, AWidenedPassageIsListedWithItsOwnWater) {
  // The same sea once more, 100 to the east, as another feature.
  Domain domain = seaWithStrait();
  const auto count = static_cast<VertexId>(domain.pslg.points.size());
  for (VertexId v = 0; v < count; ++v) domain.pslg.points.push_back(domain.pslg.points[v] + Point{100.0, 0.0});
  const std::vector<Segment> segments = domain.pslg.segments;
  for (const Segment& s : segments) domain.pslg.segments.push_back({s.a + count, s.b + count, 0, 1, kOutside});
  domain.input_points = domain.pslg.points;
  Coastline coast;
  for (const std::int64_t fid : {7, 8}) coast.features.emplace_back().fid = fid;
  CleanReport report;
  const ShoreGuides guides{{{{{5, 0.5}, {55, 0.5}}, "", 1.0}, {{{105, 0.5}, {155, 0.5}}, "", 1.0}}, {}};
  followSizes(std::move(domain), ConstantSize(2.0), {}, coast, report, guides);
  std::vector<std::int64_t> fids;
  for (const Edit& edit : report.edits)
    if (edit.kind == EditKind::WidenedPassage) fids.push_back(edit.fid);
  EXPECT_EQ(fids, (std::vector<std::int64_t>{7, 8}));
}

TEST(FollowSizes, APassageThatIsWideEnoughChangesNothingAndOneOnLandIsSaidToBeSo) {
  CleanReport plain, guided;
  const ShoreGuides guides{{{{{5, 25}, {55, 25}}, "", 2.0}, {{{20, 5}, {40, 5}}, "", 2.0}}, {}};
  const Domain before = followSizes(seaWithStrait(), ConstantSize(2.0), {}, oneFeature(), plain);
  const Domain after = followSizes(seaWithStrait(), ConstantSize(2.0), {}, oneFeature(), guided, guides);
  EXPECT_EQ(after.pslg.points, before.pslg.points);
  EXPECT_EQ(countOf(guided, EditKind::WidenedPassage), 0u);
  EXPECT_EQ(guided.notes, plain.notes);
  ASSERT_EQ(guided.idle.size(), 1u);
  EXPECT_NE(guided.idle[0].find("passage 2 meets no water"), std::string::npos) << guided.idle[0];
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
  ASSERT_EQ(report.warnings.size(), 3u);  // the part dug through land, and both ends of the line
  double dug = 0.0, x = 0.0, y = 0.0, beyond = 0.0;
  ASSERT_EQ(std::sscanf(report.warnings[0].c_str(),
                        "passage 1 was dug through land: %lf of it, the longest piece, at (%lf, %lf)", &dug, &x, &y),
            3)
      << report.warnings[0];
  EXPECT_NEAR(dug, 10.0, 1.0);
  EXPECT_NEAR(x, 25.0, 1.0);
  EXPECT_EQ(y, 10.0);
  ASSERT_EQ(std::sscanf(report.warnings[2].c_str(), "passage 1 goes on for %lf beyond the water, from (%lf, %lf)",
                        &beyond, &x, &y),
            3)
      << report.warnings[2];
  EXPECT_NEAR(beyond, 10.0, 1.0);
  EXPECT_NEAR(x, 50.0, 1.0);
}

TEST(FollowSizes, LandUpToAnElementIsDugWithoutAWord) {
  Domain domain;
  addShore(domain, {{0, 0}, {20, 0}, {20, 20}, {0, 20}});
  addShore(domain, {{21, 0}, {50, 0}, {50, 20}, {21, 20}});
  CleanReport report;
  const ShoreGuides guides{{{{{5, 10}, {45, 10}}, ""}}, {}};
  EXPECT_EQ(parts(followSizes(std::move(domain), ConstantSize(2.0), {}, oneFeature(), report, guides)), 1u);
  EXPECT_EQ(report.warnings, std::vector<std::string>{});
}

// Sizes grow from the shores; deep in the land they are seven times as large as at the shores.
TEST(FollowSizes, APassageThroughLandIsAsWideAsTheSizesAtItsShores) {
  const SizeOf size(1.0, 20.0, [](const Point& p) { return 1.0 + 0.3 * std::max(0.0, 20.0 - std::abs(p.x)); });
  for (const double elements : {1.0, 3.0}) {
    Domain domain;
    addShore(domain, {{-60, -50}, {60, -50}, {60, 50}, {-60, 50}});
    addShore(domain, {{-20, -40}, {-20, 40}, {20, 40}, {20, -40}});
    CleanReport report;
    const ShoreGuides guides{{{{{-30, 0.3}, {30, 0.3}}, "canal", elements}}, {}};
    const Domain coarse = followSizes(std::move(domain), size, {}, oneFeature(), report, guides);
    EXPECT_EQ(boundaryLoops(constrainedDelaunay(coarse.pslg)).size(), 3u);  // the island is cut in two
    for (double x = -19.0; x <= 19.0; x += 0.5) {
      double north = 1e300, south = -1e300;
      for (const Segment& s : coarse.pslg.segments) {
        const Point &a = coarse.pslg.points[s.a], &b = coarse.pslg.points[s.b];
        if ((a.x < x) == (b.x < x)) continue;
        const double y = a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y);
        (y > 0.3 ? north : south) = y > 0.3 ? std::min(north, y) : std::max(south, y);
      }
      EXPECT_GE(north - south, 0.9 * elements) << x;
      EXPECT_LE(north - south, 1.5 * elements) << x;
    }
    const std::string wanted = "passage 'canal' was widened to " + std::string(elements == 1.0 ? "1" : "3");
    EXPECT_TRUE(std::ranges::any_of(report.notes, [&](const std::string& note) { return note.starts_with(wanted); }));
  }
}

// A frame around the southern half of a bay: the line leaves and re-enters it.
TEST(FollowSizes, NothingIsDugBeyondAnOpenBoundary) {
  Domain domain;
  addShore(domain, {{0, 0}, {60, 0}, {60, 30}, {0, 30}});
  domain.pslg.segments[2].tag = kOpenTag;
  CleanReport report;
  const ShoreGuides guides{{{{{10, 20}, {10, 45}, {50, 45}, {50, 20}}, ""}}, {}};
  const Domain coarse = followSizes(std::move(domain), ConstantSize(2.0), {}, oneFeature(), report, guides);
  for (const Point& p : coarse.pslg.points) EXPECT_LE(p.y, 30.0);
  EXPECT_EQ(report.warnings, std::vector<std::string>{});
  EXPECT_EQ(countOf(report, EditKind::WidenedPassage), 0u);
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
  std::vector<std::string> idle;
  const auto notesOf = [&](std::vector<ShoreLine> barriers) {
    CleanReport report;
    followSizes(twoLakes(5.0), ConstantSize(2.0), {}, oneFeature(), report, ShoreGuides{{}, std::move(barriers)});
    std::erase_if(report.notes, [](const std::string& note) { return !note.starts_with("barrier "); });
    idle = report.idle;
    return report.notes;
  };
  // Across the channel to the land beside it; then with an end that touches another barrier.
  EXPECT_TRUE(notesOf({{{{25, 4}, {25, 16}}, ""}}).empty());
  EXPECT_TRUE(notesOf({{{{10, -2}, {10, 10}}, ""}, {{{10.5, 10}, {10.5, 22}}, ""}}).empty());
  // Twice at one place: the first closes the water that the second meets.
  EXPECT_TRUE(notesOf({{{{25, 4}, {25, 16}}, ""}, {{{25, 4}, {25, 16}}, ""}}).empty());
  EXPECT_TRUE(idle.empty());
  const auto short_of = notesOf({{{{10, -2}, {10, 10}}, "mole"}});
  ASSERT_EQ(short_of.size(), 1u);
  EXPECT_EQ(short_of[0].find("barrier 'mole' ends in the water, at (10, 10), an element or more"), 0u) << short_of[0];
  EXPECT_TRUE(idle.empty());
  EXPECT_TRUE(notesOf({{{{25, 4}, {25, 16}}, ""}, {{{25, 30}, {25, 40}}, ""}}).empty());
  ASSERT_EQ(idle.size(), 1u);
  EXPECT_EQ(idle[0].find("barrier 2 meets no water"), 0u) << idle[0];
}

// One search among all lines answers as one line after another does.
TEST(LineZone, FindsTheFirstLineAtATriangleAndOthersNearAPlace) {
  std::vector<ShoreLine> lines;
  for (int i = 0; i < 60; ++i) {
    const Point from{static_cast<double>((37 * i) % 50), static_cast<double>((23 * i) % 50)};
    lines.push_back({{from, from + Point{3.0, static_cast<double>(i % 5)}, from + Point{6.0, 0.0}}, ""});
  }
  const LineZone all(lines);
  std::size_t met = 0, near = 0;
  for (double x = 0.0; x < 50.0; x += 1.0) {
    for (double y = 0.0; y < 50.0; y += 1.0) {
      const Point a{x, y}, b{x + 1.3, y + 0.1}, c{x + 0.2, y + 0.9};
      std::optional<std::size_t> first;
      bool is_near = false;
      for (std::size_t line = 0; line < lines.size(); ++line) {
        if (!first && LineZone({lines[line]}).holds(a, b, c, 0.0)) first = line;
        for (std::size_t i = 0; i + 1 < lines[line].points.size() && line != 7; ++i)
          is_near = is_near || squaredDistanceToSegment(a, lines[line].points[i], lines[line].points[i + 1]) <= 1.0;
      }
      EXPECT_EQ(all.firstAt(a, b, c), first);
      EXPECT_EQ(all.hasAnotherNear(a, 1.0, 7), is_near);
      met += first ? 1 : 0;
      near += is_near ? 1 : 0;
    }
  }
  EXPECT_GT(met, 100u);
  EXPECT_GT(near, 100u);
  EXPECT_LT(met, 2000u);
  EXPECT_LT(near, 2000u);
}

}  // namespace
}  // namespace coastmesh
