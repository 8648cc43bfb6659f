#include "core/refine/fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/delaunay.hpp"
#include "core/label_regions.hpp"
#include "core/quality.hpp"
#include "core/refine/split_segments.hpp"
#include "tests/support/excused_twin.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/pslgs.hpp"
#include "tests/support/size_figures.hpp"

namespace coastmesh {
namespace {

// A polygon of a few long sides, so that the input does not force edges shorter than wanted.
Pslg wideLake() {
  Pslg pslg;
  pslg.points = {{0.0, 0.0}, {2.03, 0.1}, {2.4, 1.3}, {1.1, 2.01}, {-0.2, 1.2}};
  for (VertexId i = 0; i < 5; ++i) pslg.segments.push_back({i, (i + 1) % 5});
  return pslg;
}

struct Wanted {
  std::string name;
  SizeOf size;
};

std::vector<Wanted> smoothSizes() {
  return {
      {"Constant", SizeOf(0.03, 0.03, [](const Point&) { return 0.03; })},
      {"Linear", SizeOf(0.01, 0.2, [](const Point& p) { return 0.02 + 0.05 * (p.x + 0.2); })},
      {"Steep", SizeOf(0.005, 0.5, [](const Point& p) { return 0.006 + 0.12 * (p.x + 0.2); })},
      {"RoundAPlace", SizeOf(0.008, 0.5, [](const Point& p) { return 0.01 + 0.1 * std::hypot(p.x - 1.0, p.y - 1.0); })},
      {"Wavy",
       SizeOf(0.01, 0.1, [](const Point& p) { return 0.03 + 0.015 * std::sin(4.0 * p.x) * std::cos(3.0 * p.y); })},
  };
}

TEST(Fit, EdgesComeOutAsWanted) {
  for (const Wanted& wanted : smoothSizes()) {
    for (const double angle : {25.0, 33.0, 38.0}) {
      for (const int sweeps : {kFitSweeps, kSmoothSweeps}) {
        SCOPED_TRACE(wanted.name + " " + std::to_string(angle) + " " + std::to_string(sweeps));
        const Pslg pslg = wideLake();
        const RefineOptions options{.min_angle_deg = angle, .size = &wanted.size};
        TriMesh mesh = constrainedDelaunay(pslg);
        refine(mesh, pslg, options);
        shrink(mesh, pslg, options);
        const RefineStats stats = fit(mesh, pslg, options, sweeps);
        EXPECT_TRUE(stats.unresolved.empty());
        EXPECT_EQ(wrongShortfalls(mesh, pslg, options, stats.unresolved), "");
        expectValidMesh(mesh, pslg, {.min_angle_deg = angle});
        const SizeFigures figures = sizeFigures(mesh, wanted.size);
        EXPECT_GE(figures.share_within, 0.97);
        EXPECT_NEAR(figures.median, 1.0, 0.05);
        EXPECT_LE(figures.vertices_share, 1.2);
      }
    }
  }
}

TEST(Fit, KeepsAFineCoastAndItsAngles) {
  const Pslg pslg = fractalCoast(3, 3, 2);
  const SizeOf size(0.2, 0.2, [](const Point&) { return 0.2; });
  const RefineOptions options{.min_angle_deg = 33.0, .size = &size};
  TriMesh mesh = constrainedDelaunay(pslg);
  const RefineStats refined = refine(mesh, pslg, options);
  const std::size_t before = mesh.points.size();
  shrink(mesh, pslg, options);
  EXPECT_LT(mesh.points.size(), before);
  const RefineStats stats = fit(mesh, pslg, options, kSmoothSweeps);
  EXPECT_LE(stats.unresolved.size(), refined.unresolved.size());
  EXPECT_EQ(wrongShortfalls(mesh, pslg, options, stats.unresolved), "");
  expectValidMesh(mesh, pslg);
}

TEST(Fit, WithoutSizesEvensAnglesOut) {
  const Pslg pslg = fractalCoast(1, 3, 2);
  const RefineOptions options{.min_angle_deg = 30.0};
  TriMesh mesh = constrainedDelaunay(pslg);
  refine(mesh, pslg, options);
  const auto sharp = [](const TriMesh& m) {
    std::size_t count = 0;
    for (const Triangle& t : m.triangles)
      for (const double angle : anglesDeg(m.points[t.v[0]], m.points[t.v[1]], m.points[t.v[2]])) count += angle < 40.0;
    return count;
  };
  const std::size_t before = sharp(mesh), vertices = mesh.points.size();
  const RefineStats stats = fit(mesh, pslg, options, kSmoothSweeps);
  EXPECT_TRUE(stats.unresolved.empty());
  EXPECT_EQ(mesh.points.size(), vertices);
  EXPECT_LT(sharp(mesh), before);
  EXPECT_EQ(wrongShortfalls(mesh, pslg, options, stats.unresolved), "");
  expectValidMesh(mesh, pslg, {.min_angle_deg = 30.0});
}

TEST(SplitSegments, PiecesAreEven) {
  const Pslg pslg = wideLake();
  for (const Wanted& wanted : smoothSizes()) {
    SCOPED_TRACE(wanted.name);
    const RefineOptions options{.size = &wanted.size};
    TriMesh mesh = constrainedDelaunay(pslg);
    VertexNotes notes = noteInput(mesh, boundOf(options));
    const std::uint64_t added = splitSegments(mesh, pslg, notes, options);
    EXPECT_EQ(mesh.points.size(), pslg.points.size() + added);
    EXPECT_EQ(notes.spacing.size(), mesh.points.size());
    labelRegions(mesh, pslg);
    expectValidMesh(mesh, pslg);
    for (TriId t = 0; t < mesh.triangles.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        if (mesh.segment(edgeRef(t, i)) == kNone) continue;
        const Point &a = mesh.points[mesh.origin(edgeRef(t, i))], &b = mesh.points[mesh.target(edgeRef(t, i))];
        EXPECT_NEAR(std::hypot(b.x - a.x, b.y - a.y) / wanted.size.at({0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}), 1.0,
                    0.1);
      }
    }
  }
}

TEST(SplitSegments, KeepsToTheBudget) {
  const Pslg pslg = wideLake();
  const SizeOf size(0.001, 0.001, [](const Point&) { return 0.001; });
  RefineOptions options{.max_vertices = 100, .size = &size};
  TriMesh mesh = constrainedDelaunay(pslg);
  const RefineStats stats = refine(mesh, pslg, options);
  EXPECT_TRUE(stats.budget_reached);
  EXPECT_LE(mesh.points.size(), 100u);
  expectValidMesh(mesh, pslg);
}

}  // namespace
}  // namespace coastmesh
