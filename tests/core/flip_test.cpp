#include "core/flip.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/predicates.hpp"
#include "tests/support/mesh_checks.hpp"

namespace coastmesh {
namespace {

// Two flat triangles on a long edge.
TriMesh kite() { return meshOf({{0, 0}, {4, 0}, {2, 1}, {2, -1}}, {{0, 1, 2}, {0, 3, 1}}); }

TEST(FlipToDelaunay, TakesTheOtherDiagonal) {
  TriMesh mesh = kite();
  const EdgeRef e = edgeRef(0, 2);
  ASSERT_TRUE(flipToDelaunay(mesh.points, mesh.triangles, e));
  expectValidMesh(mesh);
  for (const Triangle& t : mesh.triangles) {
    EXPECT_NE(std::ranges::find(t.v, 2u), t.v.end());
    EXPECT_NE(std::ranges::find(t.v, 3u), t.v.end());
  }
  for (unsigned i = 0; i < 3; ++i)
    if (mesh.triangles[0].adj[i] != kNone) {
      EXPECT_FALSE(flipToDelaunay(mesh.points, mesh.triangles, edgeRef(0, i)));
    }
}

TEST(FlipToDelaunay, ConstraintsStayOnTheirEdges) {
  TriMesh mesh = kite();
  // The boundary's four sides are segments 0 to 3.
  SegmentId next = 0;
  for (Triangle& t : mesh.triangles)
    for (unsigned i = 0; i < 3; ++i)
      if (t.adj[i] == kNone) t.seg[i] = next++;
  const TriMesh before = mesh;
  ASSERT_TRUE(flipToDelaunay(mesh.points, mesh.triangles, edgeRef(0, 2)));
  for (TriId t = 0; t < 2; ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (mesh.twin(e) != kNone) {
        EXPECT_EQ(mesh.segment(e), kNone);
        continue;
      }
      SegmentId was = kNone;
      for (TriId s = 0; s < 2; ++s)
        for (unsigned j = 0; j < 3; ++j)
          if (before.origin(edgeRef(s, j)) == mesh.origin(e) && before.target(edgeRef(s, j)) == mesh.target(e))
            was = before.segment(edgeRef(s, j));
      EXPECT_EQ(mesh.segment(e), was);
    }
  }
}

TEST(RestoreDelaunay, StopsAtConstraints) {
  TriMesh mesh = kite();
  mesh.triangles[0].seg[2] = 7;
  mesh.triangles[1].seg[1] = 7;
  EXPECT_TRUE(restoreDelaunay(mesh, {edgeRef(0, 2)}).empty());
  mesh.triangles[0].seg[2] = mesh.triangles[1].seg[1] = kNone;
  EXPECT_EQ(restoreDelaunay(mesh, {edgeRef(0, 2)}).size(), 2u);
}

}  // namespace
}  // namespace coastmesh
