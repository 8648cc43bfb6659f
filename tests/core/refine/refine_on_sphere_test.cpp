#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/links.hpp"
#include "core/optimise/optimise.hpp"
#include "core/quality.hpp"
#include "core/refine/mend_triangles.hpp"
#include "core/refine/refine.hpp"
#include "core/space_point.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/mesh_checks.hpp"

namespace coastmesh {
namespace {

constexpr double kRadius = 6371.0;

SpacePoint inSpace(const Point& x) {
  const double q = (x.x * x.x + x.y * x.y) / (4.0 * kRadius * kRadius);
  return {x.x / (1.0 + q), x.y / (1.0 + q), kRadius * (1.0 - q) / (1.0 + q)};
}

double angleAtDeg(const SpacePoint& at, const SpacePoint& p, const SpacePoint& q) {
  return toDegrees(std::atan2(lengthOf(cross(p - at, q - at)), dot(p - at, q - at)));
}

// A cap of the sphere up to `reach` (radians) from the origin, with a boundary of `corners` points.
Pslg cap(double reach, unsigned corners) {
  Pslg pslg;
  const double far = 2.0 * kRadius * std::tan(0.5 * reach);
  for (unsigned i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    pslg.points.push_back({far * std::cos(angle), far * std::sin(angle)});
    pslg.segments.push_back({i, (i + 1) % corners});
  }
  return pslg;
}

struct InSpace {
  double least_angle = 180.0, greatest_angle = 0.0;
  double area = 0.0, area_near_size = 0.0;  // of all triangles; of those whose edges are all 0.6 to 1.6 of the size
  double longest = 0.0;
};

InSpace measure(const TriMesh& mesh, double size) {
  InSpace result;
  for (const Triangle& t : mesh.triangles) {
    const std::array<SpacePoint, 3> p{inSpace(mesh.point(t.v[0])), inSpace(mesh.point(t.v[1])),
                                      inSpace(mesh.point(t.v[2]))};
    const double area = 0.5 * lengthOf(cross(p[1] - p[0], p[2] - p[0]));
    bool near = true;
    for (unsigned i = 0; i < 3; ++i) {
      const double angle = angleAtDeg(p[i], p[(i + 1) % 3], p[(i + 2) % 3]), length = distance(p[i], p[(i + 1) % 3]);
      result.least_angle = std::min(result.least_angle, angle);
      result.greatest_angle = std::max(result.greatest_angle, angle);
      result.longest = std::max(result.longest, length);
      near = near && length > 0.6 * size && length < 1.6 * size;
    }
    result.area += area;
    result.area_near_size += near ? area : 0.0;
  }
  return result;
}

// Nearly the whole sphere: at the boundary, the plane is enlarged 50 times.
TEST(RefineOnSphere, AnglesHoldInSpaceFarFromTheCentre) {
  for (const double min_angle : {30.0, 33.0, 38.0}) {
    const Pslg pslg = cap(toRadians(164.0), 12);
    RefineOptions options;
    options.min_angle_deg = min_angle;
    options.surface = Surface::sphere(kRadius);
    TriMesh mesh = constrainedDelaunay(pslg);
    const RefineStats stats = refine(mesh, pslg, options);
    expectValidMesh(mesh, pslg);
    EXPECT_TRUE(stats.unresolved.empty());
    EXPECT_GE(measure(mesh, 1.0).least_angle, min_angle);
    EXPECT_LT(mesh.triangles.size(), 2000u);
  }
}

TEST(RefineOnSphere, LongestEdgeIsMeasuredInSpace) {
  const Pslg pslg = cap(toRadians(150.0), 24);
  RefineOptions options;
  options.size_max = 900.0;
  options.surface = Surface::sphere(kRadius);
  TriMesh mesh = constrainedDelaunay(pslg);
  EXPECT_TRUE(refine(mesh, pslg, options).unresolved.empty());
  const InSpace figures = measure(mesh, 900.0);
  EXPECT_LE(figures.longest, 900.0 * (1.0 + 1e-12));
  EXPECT_GE(figures.least_angle, options.min_angle_deg);
}

TEST(RefineOnSphere, WantedLengthsAreThoseInSpace) {
  const Pslg pslg = cap(toRadians(150.0), 48);
  const ConstantSize size(500.0);
  RefineOptions options;
  options.size = &size;
  options.surface = Surface::sphere(kRadius);
  TriMesh mesh = constrainedDelaunay(pslg);
  EXPECT_TRUE(refine(mesh, pslg, options).unresolved.empty());
  EXPECT_TRUE(optimise(mesh, pslg, options, 12).unresolved.empty());
  const InSpace figures = measure(mesh, 500.0);
  EXPECT_GE(figures.least_angle, options.min_angle_deg);
  EXPECT_GT(figures.area_near_size, 0.95 * figures.area);
  const double expected = figures.area / (0.433 * 500.0 * 500.0);
  EXPECT_GT(static_cast<double>(mesh.triangles.size()), 0.85 * expected);
  EXPECT_LT(static_cast<double>(mesh.triangles.size()), 1.25 * expected);
}

TEST(RefineOnSphere, NoObtuseTriangleInSpace) {
  const Pslg pslg = cap(toRadians(120.0), 24);
  const ConstantSize size(800.0);
  RefineOptions options;
  options.max_angle_deg = 89.0;
  options.size = &size;
  options.surface = Surface::sphere(kRadius);
  TriMesh mesh = constrainedDelaunay(pslg);
  EXPECT_TRUE(refine(mesh, pslg, options).unresolved.empty());
  EXPECT_LE(measure(mesh, 800.0).greatest_angle, 89.0);
}

// Far from the origin an edge of the plane and its chord differ, by 0.025 of the length here. A vertex of the input is
// between them, so that its triangle at the edge, which is frozen, is turned over in space.
TEST(RefineOnSphere, NothingIsPutBetweenAFrozenEdgeAndItsChord) {
  constexpr double kFar = 20.0 * kRadius, kHalf = 0.05 * kFar;
  const Point a{-kHalf, kFar}, b{kHalf, kFar};
  Pslg pslg;
  pslg.points = {a, b, {kHalf, kFar + 2.0 * kHalf}, {-kHalf, kFar + 2.0 * kHalf}, {0.3 * kHalf, kFar + 0.01 * kHalf}};
  pslg.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  RefineOptions options;
  options.surface = Surface::sphere(kRadius);
  TriMesh mesh = constrainedDelaunay(pslg);
  for (TriId t = 0; t < mesh.triangles.size(); ++t)
    for (unsigned i = 0; i < 3; ++i)
      if (mesh.segment(edgeRef(t, i)) == 0) setSegment(mesh.triangles, edgeRef(t, i), kFrozen);
  VertexNotes notes = noteInput(mesh, boundOf(options));
  RefineRun run(std::move(mesh), pslg, options, std::move(notes), RefineVariant{});
  refineAll(run, {});
  mesh = releaseMesh(run);
  ASSERT_GT(mesh.points.size(), pslg.points.size());
  for (VertexId v = 4; v < mesh.points.size(); ++v) {
    const bool is_behind = dot(inSpace(a), cross(inSpace(b), inSpace(mesh.point(v)))) < 0.0;
    EXPECT_EQ(is_behind, v == 4) << mesh.point(v).x << ", " << mesh.point(v).y;
  }
}

}  // namespace
}  // namespace coastmesh
