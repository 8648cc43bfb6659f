#include "gis/shore/shore_meets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/metric.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/follow/coast_follow.hpp"
#include "tests/support/followed_coasts.hpp"

namespace coastmesh {
namespace {

constexpr double kSize = 100.0;

Point turned(const Point& p) {
  const double angle = toRadians(17.0);
  return {p.x * std::cos(angle) - p.y * std::sin(angle), p.x * std::sin(angle) + p.y * std::cos(angle)};
}

// A basin of 4 by 2 km with straight quays, and points or a line in it.
Domain basin(const std::vector<Point>& given, bool as_line) {
  Domain domain;
  addShore(domain, {turned({0, 0}), turned({4000, 0}), turned({4000, 2000}), turned({0, 2000})});
  const auto first = static_cast<VertexId>(domain.pslg.points.size());
  for (const Point& p : given) domain.pslg.points.push_back(turned(p));
  for (VertexId v = first; as_line && v + 1 < domain.pslg.points.size(); ++v)
    domain.pslg.segments.push_back({v, v + 1, 0, 0, 0});
  domain.input_points = domain.pslg.points;
  return domain;
}

double toShore(const Domain& domain, const Point& p) {
  double least = 1e300;
  for (const Segment& s : domain.pslg.segments)
    if (isBoundary(s))
      least = std::min(least, squaredDistanceToSegment(p, domain.pslg.points[s.a], domain.pslg.points[s.b]));
  return std::sqrt(least);
}

// The largest distance by which the southern quay has moved, between 0 and `from` and between `to` and 4000.
double moved(const Domain& domain, double from, double to) {
  double most = 0.0;
  for (double x = 0.0; x <= 4000.0; x += 10.0)
    if (x <= from || x >= to) most = std::max(most, toShore(domain, turned({x, 0.0})));
  return most;
}

struct Follow {
  CleanReport report;
  Domain domain;

  explicit Follow(const std::vector<Point>& given, bool as_line = false)
      : domain(followSizes(basin(given, as_line), ConstantSize(kSize), {}, oneFeature(), report)) {
    EXPECT_NO_THROW(constrainedDelaunay(domain.pslg));
    addWaterNotes(report, {});
  }
};

TEST(MeetPoints, AQuayGoesThroughAPointAlmostOnIt) {
  for (const double off : {0.1, 2.0, 20.0}) {
    const Point gauge{2030, off};
    const Follow follow({gauge});
    EXPECT_LT(toShore(follow.domain, turned(gauge)), 1e-9);
    EXPECT_LE(moved(follow.domain, 4000, 0), off + 1e-9);
    EXPECT_LT(moved(follow.domain, gauge.x - 1.1 * kSize, gauge.x + 1.1 * kSize), 1e-6);
    ASSERT_EQ(follow.report.notes.size(), 1U);
    EXPECT_NE(follow.report.notes[0].find("the shore passes through 1 point or end of a line"), std::string::npos)
        << follow.report.notes[0];
    EXPECT_EQ(countOf(follow.report, EditKind::MovedPoint), 1U);
  }
}

TEST(MeetPoints, AQuayGoesThroughTheEndOfALineThatStopsBeforeIt) {
  const std::vector<Point> weir{{2030, 3}, {2200, 400}, {2300, 900}};
  const Follow follow(weir, true);
  EXPECT_LT(toShore(follow.domain, turned(weir[0])), 1e-9);
  EXPECT_LE(moved(follow.domain, 4000, 0), 3.0 + 1e-9);
  EXPECT_LT(moved(follow.domain, 1900, 2160), 1e-6);
}

TEST(MeetPoints, APointAtACornerMovesTheCornerAlone) {
  const Follow follow({{4, 3}});
  EXPECT_LT(toShore(follow.domain, turned({4, 3})), 1e-9);
  EXPECT_LE(moved(follow.domain, 4000, 0), 5.0 + 1e-9);
  EXPECT_LT(moved(follow.domain, -1, 110), 1e-6);
}

TEST(MeetPoints, ManyPointsAlongAQuay) {
  std::vector<Point> gauges;
  for (int i = 0; i < 40; ++i) gauges.push_back({50.0 + 97.0 * i, 1.0 + i % 7});
  const Follow follow(gauges);
  for (const Point& gauge : gauges) EXPECT_LT(toShore(follow.domain, turned(gauge)), 1e-9);
  EXPECT_LE(moved(follow.domain, 4000, 0), 7.0 + 1e-9);
}

TEST(MeetPoints, AQuayRecedesFromWhatIsFartherOffOnlyBesideIt) {
  const Point gauge{2030, 40};
  const Follow follow({gauge});
  EXPECT_GT(toShore(follow.domain, turned(gauge)), 0.45 * kSize);
  EXPECT_LE(moved(follow.domain, 4000, 0), 0.25 * kSize);
  EXPECT_LT(moved(follow.domain, gauge.x - 2.0 * kSize, gauge.x + 2.0 * kSize), 1e-6);
}

// If it met the quay, it would leave it at an angle of 8 degrees.
TEST(MeetPoints, ALineAlmostAlongAQuayStaysInTheWaterAndChangesNothingElsewhere) {
  const Follow follow({{2030, 5}, {2400, 60}}, true);
  EXPECT_GT(toShore(follow.domain, turned({2030, 5})), 0.3 * kSize);
  EXPECT_LT(moved(follow.domain, 1800, 2700), 0.1 * kSize);
}

TEST(MeetPoints, NothingElseMayLieBetween) {
  ShoreGraph graph;
  graph.pslg.points = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {5, 0.2}, {5, 0.1}, {4.9, 0.15}, {8, 0.1}};
  graph.source.assign(graph.pslg.points.size(), kNone);
  for (VertexId v = 0; v < 4; ++v) graph.pslg.segments.push_back({v, (v + 1) % 4, 0, 0, kOutside});
  graph.pslg.segments.push_back({6, 5, 0, 0, 0});
  ShoreChains chains = chainsOf(std::move(graph), ConstantSize(1.0));
  std::vector<VertexId> met;
  meetPoints(chains, [&](VertexId, VertexId w) { met.push_back(w); });
  EXPECT_EQ(std::ranges::count(met, VertexId{4}), 0);  // behind the end of the line
  EXPECT_EQ(std::ranges::count(met, VertexId{7}), 1);
  for (const VertexId w : met) EXPECT_EQ(chains.next[chains.prev[w]], w);
}

}  // namespace
}  // namespace coastmesh
