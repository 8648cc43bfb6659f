#include "gis/follow/water_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/follow/coast_follow.hpp"
#include "tests/support/followed_coasts.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

constexpr double kSize = 10.0;

// Water within a ring, with a line through these points, some of which may be vertices of the ring.
ShoreGraph graphOf(const std::vector<Point>& ring, const std::vector<Point>& line) {
  Domain domain;
  addShore(domain, ring);
  ShoreGraph graph{domain.pslg, {}};
  std::vector<VertexId> ends;
  for (const Point& p : line) {
    const auto known = std::ranges::find(graph.pslg.points, p);
    ends.push_back(static_cast<VertexId>(known - graph.pslg.points.begin()));
    if (known == graph.pslg.points.end()) graph.pslg.points.push_back(p);
  }
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) graph.pslg.segments.push_back({ends[i], ends[i + 1], 7, 0, 0});
  graph.source.resize(graph.pslg.points.size());
  std::iota(graph.source.begin(), graph.source.end(), VertexId{0});
  return graph;
}

// The remains of lines, drawn for one shore, in the water of another.
struct Returned {
  ShoreGraph graph;
  LostLines lost;

  Returned(const std::vector<Point>& before, const std::vector<Point>& line, const std::vector<Point>& after,
           double channel_min = 1.0)
      : graph(graphOf(after, {})) {
    ShoreGraph drawn = graphOf(before, line);
    Box box;
    for (const Point& p : drawn.pslg.points) box.add(p);
    const ScaleTable scales(Projection::plane(), box);
    returnLines(graph, takeLines(drawn), {ConstantSize(kSize), scales}, channel_min, lost);
    EXPECT_NO_THROW(constrainedDelaunay(graph.pslg));
  }

  // The ends of each, in the order of the graph.
  std::vector<std::pair<Point, Point>> lines() const {
    std::vector<std::pair<Point, Point>> all;
    for (const Segment& s : graph.pslg.segments)
      if (!isBoundary(s)) all.emplace_back(graph.pslg.points[s.a], graph.pslg.points[s.b]);
    return all;
  }
  double length() const {
    double sum = 0.0;
    for (const auto& [a, b] : lines()) sum += distance(a, b);
    return sum;
  }
  double lostLength() const {
    const auto found = lost.lines.find(7);
    return found == lost.lines.end() ? 0.0 : found->second.length_m;
  }
};

const std::vector<Point> kBasin{{0, 0}, {100, 0}, {100, 100}, {0, 100}};

TEST(WaterLines, WhatIsTakenIsNotInTheGraphAnyMore) {
  ShoreGraph graph = graphOf(kBasin, {{0, 0}, {50, 40}, {100, 100}});
  graph.pslg.points.push_back({20, 70});
  graph.source.push_back(5);
  const WaterLines lines = takeLines(graph);
  EXPECT_EQ(graph.pslg.segments.size(), 4u);
  EXPECT_EQ(graph.pslg.points, kBasin);
  EXPECT_EQ(lines.segments.size(), 2u);
  EXPECT_EQ(lines.at.size(), 4u);
  EXPECT_EQ(lines.shore, (std::vector<VertexId>{0, 2, kNone, kNone}));
  ASSERT_EQ(lines.loose.size(), 1u);
  EXPECT_EQ(lines.at[lines.loose[0]], (Point{20, 70}));
  EXPECT_EQ(lines.source[lines.loose[0]], 5u);
}

TEST(WaterLines, OnTheSameShoreALineStaysAsItIs) {
  const Returned same(kBasin, {{0, 0}, {50, 40}, {100, 100}}, kBasin);
  EXPECT_THAT(same.lines(),
              UnorderedElementsAre(std::pair(Point{0, 0}, Point{50, 40}), std::pair(Point{50, 40}, Point{100, 100})));
  EXPECT_EQ(same.graph.pslg.segments.size(), 6u);
  EXPECT_EQ(same.graph.pslg.points.size(), 5u);
  EXPECT_TRUE(same.lost.lines.empty());
}

TEST(WaterLines, ALineEndsWhereTheShoreIsNow) {
  const std::vector<Point> half{{0, 0}, {60, 0}, {60, 100}, {0, 100}};
  const Returned cut(kBasin, {{10, 50}, {90, 50}}, half);
  EXPECT_EQ(cut.lines(), (std::vector<std::pair<Point, Point>>{{{10, 50}, {60, 50}}}));
  EXPECT_EQ(cut.graph.pslg.segments.size(), 6u);  // the shore has a vertex there
  EXPECT_DOUBLE_EQ(cut.lostLength(), 30.0);
}

TEST(WaterLines, AVertexOfTheShoreNearbyIsItsEnd) {
  const std::vector<Point> half{{0, 0}, {60, 0}, {60, 50.5}, {60, 100}, {0, 100}};
  const Returned cut(kBasin, {{10, 50}, {90, 50}}, half);
  EXPECT_EQ(cut.lines(), (std::vector<std::pair<Point, Point>>{{{10, 50}, {60, 50.5}}}));
  EXPECT_EQ(cut.graph.pslg.segments.size(), 6u);
}

TEST(WaterLines, WhatCrossesLandIsInTwoPieces) {
  // A tongue of land from the south.
  const std::vector<Point> tongue{{0, 0}, {45, 0}, {45, 80}, {55, 80}, {55, 0}, {100, 0}, {100, 100}, {0, 100}};
  const Returned cut(kBasin, {{10, 50}, {90, 50}}, tongue);
  EXPECT_EQ(cut.lines().size(), 2u);
  EXPECT_DOUBLE_EQ(cut.length(), 70.0);
  EXPECT_DOUBLE_EQ(cut.lostLength(), 10.0);
}

TEST(WaterLines, WhatNeverGetsOffTheShoreGoes) {
  std::vector<Point> wavy{{100, 0}, {100, 100}, {0, 100}, {0, 0}};
  for (double x = 5.0; x < 100.0; x += 5.0) wavy.push_back({x, std::fmod(x, 10.0) == 0.0 ? 2.0 : -2.0});
  const Returned along(kBasin, {{20, 50}, {20, 0.5}, {80, 0.5}, {80, 50}}, wavy);
  for (const auto& [a, b] : along.lines()) EXPECT_EQ(a.x == b.x, true);  // the two vertical parts
  EXPECT_EQ(along.lines().size(), 2u);
  EXPECT_GT(along.lostLength(), 40.0);
}

TEST(WaterLines, AStubAtTheShoreGoesButForNarrowChannels) {
  const std::vector<Point> line{{50, 0}, {50, 3.5}};
  const std::vector<Point> shore{{0, 0}, {50, 0}, {100, 0}, {100, 100}, {0, 100}};
  EXPECT_TRUE(Returned(shore, line, shore).lines().empty());
  EXPECT_EQ(Returned(shore, line, shore, 0.2).lines().size(), 1u);
  EXPECT_EQ(Returned(shore, {{50, 0}, {50, 5}}, shore).lines().size(), 1u);
  EXPECT_EQ(Returned(shore, {{50, 1}, {50, 3}}, shore).lines().size(), 1u);  // not at the shore
}

TEST(WaterLines, ALineThatNearsTheShoreSlowlyTurnsToIt) {
  const std::vector<Point> shore{{0, 0}, {90, 0}, {100, 0}, {100, 100}, {0, 100}};
  const Returned turned(shore, {{10, 50}, {30, 5}, {90, 0}}, shore);
  ASSERT_EQ(turned.lines().size(), 3u);
  for (const auto& [a, b] : turned.lines()) {
    EXPECT_LT(std::max(a.x, b.x), 43.0);
    if (std::min(a.y, b.y) == 0.0) {
      EXPECT_NEAR(distance(a, b), 4.0, 0.2);
      EXPECT_NEAR(a.x, b.x, 0.2);
    }
  }
  const Returned steep(shore, {{10, 50}, {80, 5}, {90, 0}}, shore);
  EXPECT_EQ(steep.lines().size(), 2u);
}

TEST(WaterLines, PiecesMuchShorterThanTheSizeBecomeOne) {
  std::vector<Point> line;
  for (double x = 10.0; x <= 90.0; x += 1.0) line.push_back({x, 50.0 + 0.2 * std::sin(x)});
  line.insert(line.end(), {{90, 58}, {90, 66}});
  const Returned coarse(kBasin, line, kBasin);
  for (const auto& [a, b] : coarse.lines()) EXPECT_GE(distance(a, b), 0.5 * kSize);
  EXPECT_NEAR(coarse.length(), 96.0, 1.0);
  EXPECT_TRUE(coarse.lost.lines.empty());
  bool keeps_corner = false;
  for (const auto& [a, b] : coarse.lines()) keeps_corner = keeps_corner || a == Point{90, 50.0 + 0.2 * std::sin(90.0)};
  EXPECT_TRUE(keeps_corner);
}

TEST(WaterLines, ShortPiecesBecomeOneWhicheverWayTheyRun) {
  // As cleaning leaves a line that crosses something: points of crossings have higher numbers than those of the line.
  const ShoreGraph drawn = graphOf(kBasin, {{10, 50}, {49, 50}, {50, 50}, {52, 50}, {90, 50}});
  const ScaleTable scales(Projection::plane(), Box{0, 0, 100, 100});
  for (unsigned backwards = 0; backwards < 16; ++backwards) {
    ShoreGraph graph = drawn;
    for (unsigned i = 0; i < 4; ++i)
      if (Segment& s = graph.pslg.segments[kBasin.size() + i]; (backwards >> i & 1u) != 0) std::swap(s.a, s.b);
    LostLines lost;
    returnLines(graph, takeLines(graph), {ConstantSize(kSize), scales}, 1.0, lost);
    double length = 0.0;
    for (const Segment& s : graph.pslg.segments) {
      const double piece = distance(graph.pslg.points[s.a], graph.pslg.points[s.b]);
      EXPECT_GE(piece, 0.5 * kSize) << backwards;
      if (!isBoundary(s)) length += piece;
    }
    EXPECT_DOUBLE_EQ(length, 80.0) << backwards;
  }
}

TEST(WaterLines, PointsAskedForStayInLines) {
  ShoreGraph drawn = graphOf(kBasin, {{10, 50}, {49, 50}, {50, 50}, {90, 50}});
  const ScaleTable scales(Projection::plane(), Box{0, 0, 100, 100});
  for (const bool is_asked : {false, true}) {
    ShoreGraph graph = drawn;
    LostLines lost;
    returnLines(graph, takeLines(graph, is_asked ? std::vector<VertexId>{5} : std::vector<VertexId>{}),
                {ConstantSize(kSize), scales}, 1.0, lost);
    EXPECT_EQ(std::ranges::count(graph.pslg.points, Point{49, 50}), is_asked ? 1 : 0);
  }
}

TEST(WaterLines, APointOnWhatIsLandNowIsLost) {
  ShoreGraph drawn = graphOf(kBasin, {}), now = graphOf({{0, 0}, {60, 0}, {60, 100}, {0, 100}}, {});
  for (const Point& p : {Point{50, 50}, Point{70, 50}}) {
    drawn.pslg.points.push_back(p);
    drawn.source.push_back(9);
  }
  const ScaleTable scales(Projection::plane(), Box{0, 0, 100, 100});
  LostLines lost;
  returnLines(now, takeLines(drawn), {ConstantSize(kSize), scales}, 1.0, lost);
  EXPECT_EQ(now.pslg.points.back(), (Point{50, 50}));
  EXPECT_EQ(now.source.back(), 9u);
  EXPECT_EQ(lost.points, (std::vector<Point>{{70, 50}}));
}

// A sea with an inlet in the west that is too narrow, and a line from deep in the inlet into the sea.
Domain seaWithInlet(const std::vector<Point>& line) {
  Domain domain;
  addShore(domain, {{0, 0}, {300, 0}, {300, 200}, {0, 200}, {0, 103}, {-80, 103}, {-80, 97}, {0, 97}});
  const auto first = static_cast<VertexId>(domain.pslg.points.size());
  for (const Point& p : line) domain.pslg.points.push_back(p);
  domain.lines.push_back({.feature = 0, .use = FeatureUse::Weir, .name = "Bar"});
  for (VertexId v = first; v + 1 < domain.pslg.points.size(); ++v)
    domain.pslg.segments.push_back({v, v + 1, lineTag(0), 0, 0});
  domain.input_points = domain.pslg.points;
  return domain;
}

TEST(FollowSizes, ALineThroughANarrowInletEndsWhereItIsClosed) {
  CleanReport report;
  const Domain followed = followSizes(seaWithInlet({{-70, 100}, {-40, 101}, {-10, 99}, {150, 100}}), ConstantSize(20.0),
                                      {}, oneFeature(), report);
  EXPECT_NO_THROW(constrainedDelaunay(followed.pslg));
  double length = 0.0;
  for (const Segment& s : followed.pslg.segments) {
    const Point &a = followed.pslg.points[s.a], &b = followed.pslg.points[s.b];
    EXPECT_GE(distance(a, b), 0.45 * 20.0) << a.x << ' ' << a.y;
    EXPECT_GE(std::min(a.x, b.x), -10.0);
    if (!isBoundary(s)) length += distance(a, b);
  }
  EXPECT_NEAR(length, 150.0, 12.0);
  EXPECT_GE(countOf(report, EditKind::ClosedWater), 1u);
  EXPECT_THAT(report.warnings, Contains(HasSubstr("weir 'Bar'")));
}

TEST(FollowSizes, ALineGoesOnWhereNarrowLandHasGone) {
  // A spit from the south that is too narrow; a line crosses it half way.
  Domain domain;
  addShore(domain,
           {{0, 0}, {147, 0}, {147, 50}, {147, 90}, {153, 90}, {153, 50}, {153, 0}, {300, 0}, {300, 200}, {0, 200}});
  domain.pslg.points.push_back({50, 50});
  domain.pslg.points.push_back({250, 50});
  domain.pslg.segments.push_back({10, 2, lineTag(0), 0, 0});
  domain.pslg.segments.push_back({5, 11, lineTag(0), 0, 0});
  domain.lines.push_back({.feature = 0, .use = FeatureUse::Weir, .name = "Bar"});
  domain.input_points = domain.pslg.points;
  CleanReport report;
  const Domain followed = followSizes(std::move(domain), ConstantSize(20.0), {}, oneFeature(), report);
  EXPECT_NO_THROW(constrainedDelaunay(followed.pslg));
  EXPECT_GE(countOf(report, EditKind::DroppedSpit), 1u);
  double length = 0.0;
  for (const Segment& s : followed.pslg.segments) {
    const double piece = distance(followed.pslg.points[s.a], followed.pslg.points[s.b]);
    EXPECT_GE(piece, 0.45 * 20.0);
    if (!isBoundary(s)) length += piece;
  }
  EXPECT_DOUBLE_EQ(length, 200.0);
  EXPECT_TRUE(report.warnings.empty());
}

TEST(FollowSizes, LandWhereALineEndsStays) {
  // A breakwater that is too narrow, and a weir from its head to the other shore.
  Domain domain;
  addShore(domain,
           {{0, 0}, {147, 0}, {147, 90}, {150, 92}, {153, 90}, {153, 0}, {300, 0}, {300, 200}, {150, 200}, {0, 200}});
  domain.pslg.segments.push_back({3, 8, lineTag(0), 0, 0});
  domain.lines.emplace_back();
  domain.input_points = domain.pslg.points;
  CleanReport report;
  const Domain followed = followSizes(std::move(domain), ConstantSize(20.0), {}, oneFeature(), report);
  EXPECT_NO_THROW(constrainedDelaunay(followed.pslg));
  const auto line = std::ranges::find_if(followed.pslg.segments, [](const Segment& s) { return !isBoundary(s); });
  ASSERT_NE(line, followed.pslg.segments.end());
  for (const VertexId end : {line->a, line->b})
    EXPECT_EQ(std::ranges::count_if(followed.pslg.segments,
                                    [&](const Segment& s) { return isBoundary(s) && (s.a == end || s.b == end); }),
              2);
}

TEST(FollowSizes, APointAskedForOnALineStays) {
  for (const bool is_asked : {false, true}) {
    std::vector<Feature> features{polygonFeature(1, square(0.0, 0.0, 100.0)),
                                  lineFeature(2, {{10, 50}, {49, 50}, {50, 50}, {90, 50}})};
    features[1].use = FeatureUse::Constraint;
    if (is_asked) features[1].points = {{49, 50}};
    const Coastline coast = coastlineOf(std::move(features));
    CleanReport report;
    Domain domain = cleanFeatures(coast, allMembers(coast), Projection::plane(), {}, report);
    ASSERT_EQ(domain.asked.size(), is_asked ? 1u : 0u);
    const Domain followed = followSizes(std::move(domain), ConstantSize(kSize), {}, coast, report);
    EXPECT_EQ(std::ranges::count(followed.pslg.points, Point{49, 50}), is_asked ? 1 : 0);
    ASSERT_EQ(followed.asked.size(), is_asked ? 1u : 0u);
    if (is_asked) {
      EXPECT_EQ(followed.pslg.points[followed.asked[0]], (Point{49, 50}));
    }
  }
}

TEST(FollowSizes, APointInANarrowInletIsLeftOutAndNamed) {
  CleanReport report;
  Domain sea = seaWithInlet({{-40, 100}});
  const Domain followed = followSizes(std::move(sea), ConstantSize(20.0), {}, oneFeature(), report);
  for (const Point& p : followed.pslg.points) EXPECT_GE(p.x, -10.0);
  EXPECT_THAT(report.warnings, Contains(HasSubstr("1 point lies in water that is closed")));
}

// Random lines across uneven shores and islands.
TEST(FollowSizes, LinesThatCrossShoresAnywhereLeaveAPlanarGraph) {
  std::mt19937_64 random(20);
  std::uniform_real_distribution<double> place(-1.1, 1.1), off(-0.02, 0.02);
  for (int run = 0; run < 60; ++run) {
    std::vector<Feature> features{
        polygonFeature(1, starRing(random, {0, 0}, 1.0, 120), {starRing(random, {0.1, 0.1}, 0.2, 40)})};
    for (int line = 0; line < 4; ++line) {
      std::vector<Point> points{{place(random), place(random)}};
      // Every other line stays near the shore.
      const Ring& ring = features[0].polygons[0].outer;
      for (std::size_t i = 0; i < 8; ++i) {
        points.push_back(line % 2 == 0 ? Point{place(random), place(random)}
                                       : ring[(static_cast<std::size_t>(11 * line) + 3 * i) % ring.size()] +
                                             Point{off(random), off(random)});
      }
      features.push_back(lineFeature(line + 2, points));
      features.back().use = FeatureUse::Constraint;
    }
    const Coastline coast = coastlineOf(std::move(features));
    CleanReport report;
    Domain domain = cleanFeatures(coast, allMembers(coast), Projection::plane(), {}, report);
    for (const double size : {0.02, 0.08, 0.25}) {
      const Domain followed = followSizes(Domain(domain), ConstantSize(size), {}, coast, report);
      EXPECT_NO_THROW(constrainedDelaunay(followed.pslg)) << run << ' ' << size;
    }
  }
}

}  // namespace
}  // namespace coastmesh
