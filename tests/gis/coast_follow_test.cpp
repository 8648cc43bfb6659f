#include "gis/coast_follow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/delaunay.hpp"
#include "core/metric.hpp"
#include "core/refine.hpp"
#include "gis/node_sizes.hpp"
#include "gis/segment_tags.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/pslgs.hpp"
#include "tests/support/size_figures.hpp"

namespace coastmesh {
namespace {

Coastline oneFeature() {
  Coastline coast;
  coast.features.emplace_back();
  return coast;
}

void addRing(Domain& domain, const Point& centre, double radius, int points, bool is_island, double wiggle = 0.0) {
  const auto first = static_cast<VertexId>(domain.pslg.points.size());
  const auto count = static_cast<VertexId>(points);
  for (VertexId i = 0; i < count; ++i) {
    const double angle = 6.283185307179586 * i / points, r = radius * (1.0 + (i % 2 ? wiggle : 0.0));
    domain.pslg.points.push_back(centre + Point{r * std::cos(angle), r * std::sin(angle)});
    Segment s{first + i, first + (i + 1) % count, 0, 0, kOutside};
    if (is_island) std::swap(s.left, s.right);
    domain.pslg.segments.push_back(s);
  }
  domain.input_points = domain.pslg.points;
}

TEST(FollowSizes, CoarseWhereElementsAreLarge) {
  Domain domain;
  addRing(domain, {0.0, 0.0}, 10.0, 2000, false, 0.003);
  const SizeOf size(0.05, 5.0, [](const Point& p) { return p.x < 0.0 ? 2.0 : 0.05; });
  CleanReport report;
  const std::vector<Point> before = domain.pslg.points;
  const Domain coarse = followSizes(std::move(domain), size, oneFeature(), report);
  std::size_t fine = 0, rough = 0;
  for (const Point& p : coarse.pslg.points) ++(p.x < 0.0 ? rough : fine);
  EXPECT_GT(fine, 800u);
  EXPECT_LT(rough, 30u);
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::SimplifiedPoint)] + coarse.pslg.points.size(),
            before.size());
  // No point of the old shore lies further from the new one than allowed.
  for (const Point& p : before) {
    double least = 1e9;
    for (const Segment& s : coarse.pslg.segments) {
      const Point &a = coarse.pslg.points[s.a], &b = coarse.pslg.points[s.b];
      const double share = std::clamp(dot(p - a, b - a) / squaredDistance(a, b), 0.0, 1.0);
      least = std::min(least, distance(p, a + share * (b - a)));
    }
    EXPECT_LE(least, 0.25 * 2.0 + 1e-9);
  }
  EXPECT_NO_THROW(constrainedDelaunay(coarse.pslg));
}

TEST(FollowSizes, OpenRimKeepsItsCorners) {
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
    const Domain coarse = followSizes(Domain(domain), size, oneFeature(), report);
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
  const Domain coarse = followSizes(std::move(domain), size, oneFeature(), report);
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::SmallIsland)], 1u);
  const TriMesh mesh = constrainedDelaunay(coarse.pslg);
  std::size_t loops = rimLoops(mesh).size();
  EXPECT_EQ(loops, 3u);
}

TEST(FollowSizes, AnIslandWithALakeOnItStays) {
  Domain domain;
  addRing(domain, {0.0, 0.0}, 10.0, 400, false);
  addRing(domain, {-5.0, 0.0}, 0.4, 30, true);
  addRing(domain, {-5.0, 0.0}, 0.2, 20, false);
  const SizeOf size(2.0, 2.0, [](const Point&) { return 2.0; });
  CleanReport report;
  const Domain coarse = followSizes(std::move(domain), size, oneFeature(), report);
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::SmallIsland)], 0u);
  EXPECT_EQ(rimLoops(constrainedDelaunay(coarse.pslg)).size(), 3u);
}

// A .poly says with a point in each hole what the labels of a cleaned domain say.
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
  const Domain coarse = followSizes(std::move(labelled), size, oneFeature(), report);
  const Domain bare_coarse = followSizes(std::move(bare), size, oneFeature(), bare_report);
  EXPECT_EQ(bare_coarse.pslg.points, coarse.pslg.points);
  EXPECT_EQ(bare_report.counts, report.counts);
  EXPECT_GT(report.counts[static_cast<std::size_t>(EditKind::SimplifiedPoint)], 300u);
  EXPECT_EQ(rimLoops(constrainedDelaunay(bare_coarse.pslg)).size(), 2u);
}

TEST(NodeSizes, NoTwoNeighboursDifferMore) {
  const Pslg pslg = squarePslg();
  const SizeOf size(0.01, 1.0, [](const Point& p) { return 0.02 + 0.4 * std::hypot(p.x - 0.3, p.y - 0.3); });
  TriMesh mesh = constrainedDelaunay(pslg);
  refine(mesh, pslg, {.min_angle_deg = 30.0, .size = &size});
  constexpr double kGrade = 0.2, kScale = 2.0;
  const std::vector<double> sizes = nodeSizes(mesh, size, kGrade, [](const Point&) { return kScale; });
  ASSERT_EQ(sizes.size(), mesh.points.size());
  bool lowered = false;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const VertexId a = mesh.origin(edgeRef(t, i)), b = mesh.target(edgeRef(t, i));
      EXPECT_LE(std::abs(sizes[a] - sizes[b]), kGrade * distance(mesh.points[a], mesh.points[b]) / kScale);
      EXPECT_LE(sizes[a], size.at(mesh.points[a]) / kScale + 1e-12);
      lowered |= sizes[a] < 0.9 * size.at(mesh.points[a]) / kScale;
    }
  }
  EXPECT_TRUE(lowered);
}

}  // namespace
}  // namespace coastmesh
