#include "core/quality.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "core/metric.hpp"
#include "core/refine/refine.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

const double kRoot3 = std::sqrt(3.0);

TEST(Quality, TheLeastAngleIsTheLeastOfAllThree) {
  const Point a{0, 0};
  for (const Point b : {Point{1, 0}, Point{3, 1}, Point{0.01, 2}}) {
    for (const Point c : {Point{0, 1}, Point{-2, 5}, Point{-0.5, 1e-3}}) {
      const double least = std::ranges::min(anglesDeg(a, b, c));
      EXPECT_NEAR(leastAngleDeg(a, b, c), least, 1e-12);
      EXPECT_NEAR(leastAngleDeg(b, c, a), least, 1e-12);
      EXPECT_NEAR(leastAngleDeg(c, a, b), least, 1e-12);
    }
  }
}

TEST(AnglesDeg, KnownTriangles) {
  const auto equilateral = anglesDeg({0, 0}, {1, 0}, {0.5, kRoot3 / 2});
  for (const double angle : equilateral) EXPECT_NEAR(angle, 60.0, 1e-12);
  const auto half_square = anglesDeg({0, 0}, {1, 0}, {0, 1});
  EXPECT_NEAR(half_square[0], 90.0, 1e-12);
  EXPECT_NEAR(half_square[1], 45.0, 1e-12);
  EXPECT_NEAR(half_square[2], 45.0, 1e-12);
  const auto half_equilateral = anglesDeg({0, 0}, {kRoot3, 0}, {0, 1});
  EXPECT_NEAR(half_equilateral[1], 30.0, 1e-12);
  EXPECT_NEAR(half_equilateral[2], 60.0, 1e-12);
  const auto flat = anglesDeg({0, 0}, {1, 0}, {0.5, 0});
  EXPECT_EQ(flat[0], 0.0);
  EXPECT_EQ(flat[2], 180.0);
}

TEST(AnglesDeg, SumAndInvariance) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 200; ++i) {
    const auto at = [&] {
      const double x = uniform(random, -1.0, 1.0);
      return Point{x, uniform(random, -1.0, 1.0)};
    };
    const Point a = at(), b = at(), c = at();
    const auto angles = anglesDeg(a, b, c);
    EXPECT_NEAR(angles[0] + angles[1] + angles[2], 180.0, 1e-9);
    const auto rotated = anglesDeg(b, c, a);
    EXPECT_EQ(rotated[2], angles[0]);
    const auto large = anglesDeg(1e150 * a, 1e150 * b, 1e150 * c);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(large[k], angles[k], 1e-9);
    // An independent check by the law of sines.
    EXPECT_NEAR(std::sin(toRadians(angles[0])) * distance(a, b), std::sin(toRadians(angles[2])) * distance(b, c),
                1e-12);
  }
}

TEST(SignedArea, Known) {
  EXPECT_EQ(signedArea({0, 0}, {2, 0}, {0, 1}), 1.0);
  EXPECT_EQ(signedArea({0, 0}, {0, 1}, {2, 0}), -1.0);
  EXPECT_EQ(signedArea({0, 0}, {1, 1}, {2, 2}), 0.0);
  // Computed from differences, so large coordinates cost no digits.
  EXPECT_EQ(signedArea({1e9, 1e9}, {1e9 + 2, 1e9}, {1e9, 1e9 + 1}), 1.0);
}

TEST(MeasureQuality, OneTriangle) {
  const TriMesh mesh = meshOf({{0, 0}, {kRoot3, 0}, {0, 1}, {5, 5}}, {{0, 1, 2}});
  const MeshQuality quality = measureQuality(mesh, 20.0);
  EXPECT_EQ(quality.vertices, 3u) << "a point without triangles is no vertex of the mesh";
  EXPECT_EQ(quality.triangles, 1u);
  EXPECT_NEAR(quality.area, kRoot3 / 2, 1e-15);
  EXPECT_NEAR(quality.min_angle_deg, 30.0, 1e-12);
  EXPECT_NEAR(quality.max_angle_deg, 90.0, 1e-12);
  EXPECT_EQ(quality.shortest_edge, 1.0);
  EXPECT_NEAR(quality.longest_edge, 2.0, 1e-15);
  EXPECT_EQ(quality.bounds.below, 0u);
  EXPECT_EQ(measureQuality(mesh, 31.0).bounds.below, 1u);
  EXPECT_EQ(measureQuality(mesh, 20.0, 89.0).bounds.below, 1u);
}

TEST(MeasureQuality, EmptyMesh) {
  const MeshQuality quality = measureQuality({}, 30.0);
  EXPECT_EQ(quality.triangles, 0u);
  EXPECT_EQ(quality.vertices, 0u);
  EXPECT_EQ(quality.area, 0.0);
}

// A face of an octahedron.
TEST(MeasureQuality, InSpaceTheTrianglesThereCount) {
  const std::vector<SpacePoint> places{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  const TriMesh mesh = meshOf({{0, 0}, {1, 0}, {0.2, 0.1}}, {{0, 1, 2}});
  const MeshQuality quality = measureQuality(mesh, 59.9, 60.1, inOrder, places);
  EXPECT_NEAR(quality.min_angle_deg, 60.0, 1e-12);
  EXPECT_NEAR(quality.max_angle_deg, 60.0, 1e-12);
  EXPECT_NEAR(quality.area, 0.25 * std::sqrt(3.0) * 8.0, 1e-12);
  EXPECT_NEAR(quality.shortest_edge, std::sqrt(8.0), 1e-12);
  EXPECT_NEAR(quality.longest_edge, std::sqrt(8.0), 1e-12);
  EXPECT_EQ(quality.bounds.below, 0u);
  EXPECT_EQ(measureQuality(mesh, 60.1, 180.0, inOrder, places).bounds.below, 1u);
}

// Files may contain triangles with two or three corners at the same place on the Earth.
TEST(SpaceAnglesDeg, OfEqualCornersAddUpTo180) {
  const SpacePoint a{0.3, -0.4, 0.5}, b{0.1, 0.2, -0.9};
  for (const auto& [p, q, r] : {std::array{a, a, a}, {b, a, a}, {a, b, a}, {a, a, b}}) {
    const auto angles = spaceAnglesDeg(p, q, r);
    EXPECT_EQ(angles[0] + angles[1] + angles[2], 180.0);
    EXPECT_EQ(std::ranges::min(angles), 0.0);
    EXPECT_EQ(std::ranges::max(angles), 180.0);
    EXPECT_EQ(leastSpaceAngleDeg(p, q, r), 0.0);
  }
}

// Against chords of the sphere of radius 1, whose points follow from the projection formula.
TEST(SurfaceAnglesDeg, AreThoseOfChords) {
  const Surface sphere = Surface::sphere(1.0);
  const auto onSphere = [](const Point& p) {
    const double r = p.x * p.x + p.y * p.y;
    return SpacePoint{4.0 * p.x / (4.0 + r), 4.0 * p.y / (4.0 + r), (4.0 - r) / (4.0 + r)};
  };
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-3.0, 3.0);
  for (int round = 0; round < 200; ++round) {
    const Point a{place(random), place(random)}, b{place(random), place(random)}, c{place(random), place(random)};
    const auto angles = surfaceAnglesDeg(a, b, c, sphere), flat = spaceAnglesDeg(onSphere(a), onSphere(b), onSphere(c));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(angles[i], flat[i], 1e-9);
    EXPECT_EQ(surfaceAnglesDeg(a, b, c, {}), anglesDeg(a, b, c));
  }
}

// Three points around the origin, and their mirror images around the antipode: equally close together, but the triangle
// contains the rest of the sphere.
TEST(IsBad, WhatIsMoreThanHalfOfTheSphere) {
  TriangleBound bound(33.0, 180.0, std::numeric_limits<double>::infinity());
  bound.surface = Surface::sphere(1.0);
  const auto corner = [](double radius, int i) {
    return Point{radius * std::cos(toRadians(120.0 * i)), radius * std::sin(toRadians(120.0 * i))};
  };
  // The antipode is as far from a point at distance 4 / r as the origin is from a point at distance r.
  for (const double radius : {0.01, 0.1, 1.0, 1.9}) {
    EXPECT_FALSE(isBad(corner(radius, 0), corner(radius, 1), corner(radius, 2), bound)) << radius;
    EXPECT_TRUE(isBad(corner(4.0 / radius, 0), corner(4.0 / radius, 1), corner(4.0 / radius, 2), bound)) << radius;
  }
  // Small triangles far from the origin are not rejected.
  const Point far{400.0, 300.0};
  EXPECT_FALSE(isBad(far, far + Point{10.0, 0.0}, far + Point{5.0, 8.7}, bound));
}

TEST(MeasureQuality, HistogramClassesOfFiveDegrees) {
  // 46.3, 43.7 and 90.0 degrees, the last slightly above its class limit.
  const double at = toRadians(92.6);
  const Point apex{0.5 + 0.4999 * std::cos(at), 0.4999 * std::sin(at)};
  const MeshQuality quality = measureQuality(meshOf({{0, 0}, {1, 0}, apex}, {{0, 1, 2}}), 0.0);
  EXPECT_EQ(std::accumulate(quality.angle_histogram.begin(), quality.angle_histogram.end(), 0u), 3u);
  EXPECT_EQ(quality.angle_histogram[9], 1u);
  EXPECT_EQ(quality.angle_histogram[8], 1u);
  EXPECT_EQ(quality.angle_histogram[18], 1u);
}

TEST(MeasureQuality, AgreesWithANaiveTwin) {
  for (const NamedPslg& named : assortedPslgs()) {
    SCOPED_TRACE(named.name);
    const TriMesh mesh = constrainedDelaunay(named.pslg);
    const MeshQuality quality = measureQuality(mesh, 25.0, 110.0), unasked = measureQuality(mesh, 0.0);
    EXPECT_EQ(unasked.angle_histogram, quality.angle_histogram);
    EXPECT_EQ(unasked.min_angle_deg, quality.min_angle_deg);
    EXPECT_EQ(unasked.max_angle_deg, quality.max_angle_deg);
    EXPECT_EQ(unasked.shortest_edge, quality.shortest_edge);
    EXPECT_EQ(unasked.longest_edge, quality.longest_edge);
    EXPECT_EQ(quality.triangles, mesh.triangles.size());
    EXPECT_EQ(std::accumulate(quality.angle_histogram.begin(), quality.angle_histogram.end(), std::uint64_t{0}),
              3 * mesh.triangles.size());
    std::vector<double> all, lengths;
    std::uint64_t below = 0;
    double area = 0.0;
    for (const Triangle& t : mesh.triangles) {
      const Point &a = mesh.points[t.v[0]], &b = mesh.points[t.v[1]], &c = mesh.points[t.v[2]];
      const auto angles = anglesDeg(a, b, c);
      all.insert(all.end(), angles.begin(), angles.end());
      lengths.insert(lengths.end(), {distance(a, b), distance(b, c), distance(c, a)});
      below += std::ranges::min(angles) < 25.0 || std::ranges::max(angles) > 110.0;
      area += signedArea(a, b, c);
    }
    EXPECT_EQ(quality.min_angle_deg, std::ranges::min(all));
    EXPECT_EQ(quality.max_angle_deg, std::ranges::max(all));
    EXPECT_EQ(quality.shortest_edge, std::ranges::min(lengths));
    EXPECT_EQ(quality.longest_edge, std::ranges::max(lengths));
    EXPECT_EQ(quality.bounds.below, below);
    EXPECT_LE(quality.bounds.excused(), below);
    EXPECT_NEAR(quality.area, area, 1e-12 * area);
    for (std::size_t i = 0; i < quality.angle_histogram.size(); ++i) {
      const auto low = 5.0 * static_cast<double>(i), high = low + 5.0;
      const bool last = i + 1 == quality.angle_histogram.size();
      EXPECT_EQ(quality.angle_histogram[i],
                std::ranges::count_if(all, [&](double x) { return x >= low && (x < high || last); }));
    }
  }
}

TEST(MeasureQuality, AddsUpOverParts) {
  const TriMesh a = constrainedDelaunay(starPolygon(3, 20)), b = constrainedDelaunay(squareWithHole());
  const MeshQuality qa = measureQuality(a, 25.0), qb = measureQuality(b, 25.0);
  MeshQuality sum = qa;
  sum.add(qb);
  EXPECT_EQ(sum.vertices, qa.vertices + qb.vertices);
  EXPECT_EQ(sum.triangles, qa.triangles + qb.triangles);
  EXPECT_EQ(sum.area, qa.area + qb.area);
  EXPECT_EQ(sum.min_angle_deg, std::min(qa.min_angle_deg, qb.min_angle_deg));
  EXPECT_EQ(sum.max_angle_deg, std::max(qa.max_angle_deg, qb.max_angle_deg));
  EXPECT_EQ(sum.shortest_edge, std::min(qa.shortest_edge, qb.shortest_edge));
  EXPECT_EQ(sum.longest_edge, std::max(qa.longest_edge, qb.longest_edge));
  EXPECT_EQ(sum.bounds.below, qa.bounds.below + qb.bounds.below);
  EXPECT_EQ(sum.bounds.excused(), qa.bounds.excused() + qb.bounds.excused());
  for (std::size_t i = 0; i < sum.angle_histogram.size(); ++i)
    EXPECT_EQ(sum.angle_histogram[i], qa.angle_histogram[i] + qb.angle_histogram[i]);
  MeshQuality none;
  none.add(qa);
  EXPECT_EQ(none.min_angle_deg, qa.min_angle_deg);
  EXPECT_EQ(none.shortest_edge, qa.shortest_edge);
}

TEST(MeasureQuality, SmallInputAnglesExplainAndOthersDoNot) {
  // A needle of 10 degrees at the origin.
  const Point tip{std::cos(toRadians(10.0)), std::sin(toRadians(10.0))};
  const MeshQuality needle = measureQuality(meshOf({{0, 0}, {1, 0}, tip}, {{0, 1, 2}}), 30.0);
  EXPECT_EQ(needle.bounds.below, 1u);
  EXPECT_EQ(needle.bounds.corner, 1u);
  // A square cut into thin strips from a corner: 90 degrees can be divided better.
  const TriMesh strips = meshOf({{0, 0}, {1, 0}, {1, 0.2}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  const MeshQuality cut = measureQuality(strips, 30.0);
  EXPECT_EQ(cut.bounds.below, 1u);
  EXPECT_EQ(cut.bounds.excused(), 0u);
}

}  // namespace
}  // namespace coastmesh
