#include "gis/follow/coast_follow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/coast/segment_tags.hpp"
#include "tests/gis/follow/shore_distance.hpp"
#include "tests/support/followed_coasts.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/size_figures.hpp"

namespace coastmesh {
namespace {

using testing::farthestFrom;

TEST(FollowSizes, CoarseWhereElementsAreLarge) {
  Domain domain;
  addRing(domain, {0.0, 0.0}, 10.0, 2000, false, 0.003);
  const SizeOf size(0.02, 5.0, [](const Point& p) { return p.x < 0.0 ? 2.0 : 0.02; });
  CleanReport report;
  const std::vector<Point> before = domain.pslg.points;
  const Domain coarse = followSizes(std::move(domain), size, {}, oneFeature(), report);
  std::size_t fine = 0, rough = 0;
  for (const Point& p : coarse.pslg.points) ++(p.x < 0.0 ? rough : fine);
  EXPECT_GT(fine, 800u);
  EXPECT_LT(rough, 40u);
  EXPECT_GT(countOf(report, EditKind::SimplifiedPoint), 900u);
  EXPECT_LE(farthestFrom(before, coarse), 0.45 * 2.0 + 1e-9);
  EXPECT_NO_THROW(constrainedDelaunay(coarse.pslg));
}

TEST(FollowSizes, ARoughShoreGetsNoSegmentsMuchShorterThanTheSizeAndKeepsApart) {
  Domain domain;
  std::vector<Point> ring;
  for (int i = 0; i < 3000; ++i) {
    const double angle = 6.283185307179586 * i / 3000.0;
    const double r =
        100.0 + 6.0 * std::sin(22.0 * angle) + 3.0 * std::sin(74.0 * angle + 1.0) + std::sin(280.0 * angle);
    ring.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  addShore(domain, ring);
  const double area = areaOf(domain);
  const std::size_t points = domain.pslg.points.size();
  constexpr double kSize = 4.0;
  CleanReport report;
  const Domain coarse = followSizes(std::move(domain), ConstantSize(kSize), {}, oneFeature(), report);
  for (const Segment& s : coarse.pslg.segments) {
    const double length = distance(coarse.pslg.points[s.a], coarse.pslg.points[s.b]);
    EXPECT_GE(length, 0.45 * kSize);
  }
  EXPECT_LT(coarse.pslg.points.size(), points / 8);
  EXPECT_GE(leastApart(coarse), 0.4 * kSize);
  EXPECT_NEAR(areaOf(coarse), area, 0.01 * area);
}

// A frame of side 40 with a short outlet through land, or with a bit of land at its side: neither leaves short edges.
TEST(FollowSizes, ShortPiecesOfAnOpenBoundaryAndOfShoreAtItGo) {
  for (const bool way_out : {true, false}) {
    Domain domain;
    addShore(domain, {{0, 0}, {40, 0}, {40, 19.8}, {way_out ? 39.0 : 39.5, 20}, {40, 20.2}, {40, 40}, {0, 40}});
    if (way_out) {
      domain = {};
      addShore(domain, {{0, 0}, {36, 0}, {36, 12}, {40, 19.8}, {40, 20.2}, {36, 28}, {36, 40}, {0, 40}});
      domain.pslg.segments[3].tag = kOpenTag;
    } else {
      for (const SegmentId s : {0u, 1u, 4u, 5u, 6u}) domain.pslg.segments[s].tag = kOpenTag;
    }
    CleanReport report;
    const Domain coarse = followSizes(std::move(domain), ConstantSize(2.0), {}, oneFeature(), report);
    for (const Segment& s : coarse.pslg.segments) {
      EXPECT_GE(distance(coarse.pslg.points[s.a], coarse.pslg.points[s.b]), 0.9);
      EXPECT_EQ(s.tag, way_out ? 0 : kOpenTag);
    }
    for (const Point& p : coarse.pslg.points) EXPECT_LE(p.x, 40.0);
  }
}

TEST(FollowSizes, LinesInTheWaterStay) {
  Domain domain = twoLakes(1.0);
  const auto first = static_cast<VertexId>(domain.pslg.points.size());
  for (int i = 0; i <= 12; ++i) domain.pslg.points.push_back({19.0 + i, 10.0});
  for (VertexId i = 0; i < 12; ++i) domain.pslg.segments.push_back({first + i, first + i + 1, kFirstLineTag, 0, 0});
  domain.lines.emplace_back();
  domain.input_points = domain.pslg.points;
  CleanReport report;
  const Domain coarse = followSizes(std::move(domain), ConstantSize(2.0), {}, oneFeature(), report);
  EXPECT_EQ(std::ranges::count(coarse.pslg.segments, kFirstLineTag, &Segment::tag), 12);
  EXPECT_EQ(parts(coarse), 1u);
}

// A border between two waters joins the ends of a shore. The shore's last vertex stays: without it, the shore would
// coincide with the border.
TEST(FollowSizes, AShoreIsNotCoarsenedOntoTheBorderBesideIt) {
  Domain domain;
  domain.pslg.points = {{0, 0}, {40, 0}, {40, 40}, {0, 40}, {10, 41}, {20, 42}, {30, 41}};
  domain.pslg.segments = {{0, 1, 0, 0, kOutside}, {1, 2, 0, 0, kOutside}, {2, 3, 0, 0, 1},
                          {3, 0, 0, 0, kOutside}, {2, 6, 0, 1, kOutside}, {6, 5, 0, 1, kOutside},
                          {5, 4, 0, 1, kOutside}, {4, 3, 0, 1, kOutside}};
  domain.input_points = domain.pslg.points;
  Coastline two = oneFeature();
  two.features.emplace_back();
  CleanReport report;
  const Domain followed = followSizes(std::move(domain), ConstantSize(40.0), {}, two, report);
  EXPECT_GT(countOf(report, EditKind::SimplifiedPoint), 0u);
  std::set<std::pair<VertexId, VertexId>> ends;
  for (const Segment& s : followed.pslg.segments)
    EXPECT_TRUE(ends.insert(std::minmax(s.a, s.b)).second) << s.a << " " << s.b;
  const TriMesh mesh = constrainedDelaunay(followed.pslg);
  EXPECT_EQ(std::set<RegionId>(mesh.regions.begin(), mesh.regions.end()), (std::set<RegionId>{0, 1}));
}

TEST(FollowSizes, OpenBoundaryKeepsItsCorners) {
  Domain domain;
  constexpr VertexId kOnASide = 50;
  const Point corners[] = {{0.0, 0.0}, {100.0, 0.0}, {100.0, 100.0}, {0.0, 100.0}};
  for (unsigned side = 0; side < 4; ++side) {
    const Point &from = corners[side], &to = corners[(side + 1) % 4];
    const Point out{(to - from).y / 100.0, (from - to).x / 100.0};
    for (VertexId i = 0; i < kOnASide; ++i) {
      const double t = static_cast<double>(i) / kOnASide;
      domain.pslg.points.push_back(from + t * (to - from) + 0.8 * t * (1.0 - t) * out);
    }
  }
  const auto count = static_cast<VertexId>(domain.pslg.points.size());
  for (VertexId v = 0; v < count; ++v) domain.pslg.segments.push_back({v, (v + 1) % count, kOpenTag, 0, kOutside});
  domain.input_points = domain.pslg.points;
  for (const double length : {10.0, 500.0}) {
    const SizeOf size(length, length, [length](const Point&) { return length; });
    CleanReport report;
    const Domain coarse = followSizes(Domain(domain), size, {}, oneFeature(), report);
    EXPECT_LT(coarse.pslg.points.size(), 20u);
    for (const Point& corner : corners)
      EXPECT_EQ(std::ranges::count(coarse.pslg.points, corner), 1) << corner.x << ", " << corner.y;
    for (const Segment& s : coarse.pslg.segments) EXPECT_EQ(s.tag, kOpenTag);
  }
}

TEST(FollowSizes, SmallIslandsGoAndAreCounted) {
  Domain domain;
  addRing(domain, {0.0, 0.0}, 10.0, 400, false);
  addRing(domain, {-5.0, 0.0}, 0.2, 20, true);
  addRing(domain, {5.0, 0.0}, 0.2, 20, true);
  addRing(domain, {0.0, 5.0}, 2.0, 60, true);
  const SizeOf size(0.1, 1.0, [](const Point& p) { return p.x < 0.0 ? 1.0 : 0.1; });
  CleanReport report;
  const Domain coarse = followSizes(std::move(domain), size, {}, oneFeature(), report);
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::SmallIsland)], 1u);
  const TriMesh mesh = constrainedDelaunay(coarse.pslg);
  std::size_t loops = boundaryLoops(mesh).size();
  EXPECT_EQ(loops, 3u);
}

// A .poly file marks holes by points; a cleaned domain marks them by labels.
TEST(FollowSizes, AGraphWithoutLabelsIsFollowedAsWell) {
  Domain labelled;
  addRing(labelled, {0.0, 0.0}, 10.0, 400, false, 0.003);
  addRing(labelled, {-5.0, 0.0}, 0.2, 20, true);
  addRing(labelled, {0.0, 5.0}, 2.0, 60, true);
  Domain bare = labelled;
  for (Segment& s : bare.pslg.segments) s.left = s.right = kUnlabelled;
  bare.pslg.holes = {{-5.0, 0.0}, {0.0, 5.0}};
  const SizeOf size(1.0, 1.0, [](const Point&) { return 1.0; });
  CleanReport report, bare_report;
  const Domain coarse = followSizes(std::move(labelled), size, {}, oneFeature(), report);
  const Domain bare_coarse = followSizes(std::move(bare), size, {}, oneFeature(), bare_report);
  EXPECT_EQ(bare_coarse.pslg.points, coarse.pslg.points);
  EXPECT_EQ(bare_report.counts, report.counts);
  EXPECT_GT(report.counts[static_cast<std::size_t>(EditKind::SimplifiedPoint)], 300u);
  EXPECT_EQ(boundaryLoops(constrainedDelaunay(bare_coarse.pslg)).size(), 2u);
}

}  // namespace
}  // namespace coastmesh
