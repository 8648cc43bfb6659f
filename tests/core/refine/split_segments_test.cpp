#include "core/refine/split_segments.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/delaunay.hpp"
#include "core/label_regions.hpp"
#include "core/refine/refine.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/size_cases.hpp"

namespace coastmesh {
namespace {

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
