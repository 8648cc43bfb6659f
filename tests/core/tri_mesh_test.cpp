#include "core/tri_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "core/bulk_list.hpp"
#include "core/quality.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/item_loops.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Loop = std::vector<VertexId>;
using Corners3 = std::array<VertexId, 3>;

// Two triangles over the unit square.
TriMesh squareMesh() { return meshOf({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {2, 3, 0}}); }

// Eight triangles round a square hole; vertices 0 to 3 outside, 4 to 7 inside, both counter-clockwise.
TriMesh ringMesh() {
  return meshOf({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 1}, {2, 1}, {2, 2}, {1, 2}},
                {{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 6, 5}, {2, 3, 6}, {3, 7, 6}, {3, 0, 7}, {0, 4, 7}});
}

double areaOf(const TriMesh& mesh, const Loop& loop) {
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    area += signedArea(mesh.points[loop[0]], mesh.points[loop[i]], mesh.points[loop[i + 1]]);
  return area;
}

TEST(EdgeRefs, NameTriangleAndIndex) {
  for (const TriId t : {0u, 1u, 12345u, 1u << 29}) {
    for (unsigned i = 0; i < 3; ++i) {
      EXPECT_EQ(triOf(edgeRef(t, i)), t);
      EXPECT_EQ(indexOf(edgeRef(t, i)), i);
      EXPECT_EQ(prev3(next3(i)), i);
      EXPECT_EQ(next3(next3(i)), prev3(i));
    }
  }
}

TEST(TriMeshAccess, EdgesRunAsDrawn) {
  const TriMesh mesh = squareMesh();
  const EdgeRef e = edgeRef(0, 1);  // opposite vertex 1: from 2 to 0
  EXPECT_EQ(mesh.apex(e), 1u);
  EXPECT_EQ(mesh.origin(e), 2u);
  EXPECT_EQ(mesh.target(e), 0u);
  EXPECT_EQ(triOf(mesh.twin(e)), 1u);
  EXPECT_EQ(mesh.apex(mesh.twin(e)), 3u);
  EXPECT_EQ(mesh.segment(e), kNone);
}

TEST(LinkTriangles, LinksBothWays) {
  const TriMesh mesh = ringMesh();
  unsigned boundary = 0;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (mesh.twin(e) == kNone) {
        ++boundary;
        continue;
      }
      EXPECT_EQ(mesh.twin(mesh.twin(e)), e);
      EXPECT_EQ(mesh.origin(mesh.twin(e)), mesh.target(e));
      EXPECT_EQ(mesh.target(mesh.twin(e)), mesh.origin(e));
    }
  }
  EXPECT_EQ(boundary, 8u);
  EXPECT_THAT(mesh.regions, ::testing::Each(0));
  EXPECT_EQ(mesh.regions.size(), 8u);
}

TEST(LinkTriangles, AnyRotationOfCorners) {
  const TriMesh mesh = meshOf({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{2, 0, 1}, {3, 0, 2}});
  EXPECT_THAT(boundaryLoops(mesh), ElementsAre(ElementsAre(0, 1, 2, 3)));
}

TEST(LinkTriangles, EdgeOfThreeTrianglesIsAConflict) {
  std::vector<EdgeConflict> conflicts;
  const TriMesh mesh = linkTriangles({{0, 0}, {1, 0}, {0, 1}, {1, -1}, {1, 1}},
                                     std::vector<Corners3>{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, conflicts);
  ASSERT_THAT(conflicts, ::testing::Not(IsEmpty()));
  for (const EdgeConflict& c : conflicts) EXPECT_EQ(std::minmax(c.a, c.b), std::minmax(0u, 1u));
  // Rejected on all sides: no triangle points to one that does not point back.
  for (TriId t = 0; t < 3; ++t) EXPECT_EQ(mesh.triangles[t].adj, (std::array<EdgeRef, 3>{kNone, kNone, kNone}));
}

TEST(LinkTriangles, TriangleOfOppositeOrientationIsAConflict) {
  std::vector<EdgeConflict> conflicts;
  // The second is clockwise: both claim the edge from 0 to 1.
  const TriMesh mesh =
      linkTriangles({{0, 0}, {1, 0}, {0, 1}, {1, -1}}, std::vector<Corners3>{{0, 1, 2}, {0, 1, 3}}, conflicts);
  ASSERT_THAT(conflicts, ::testing::Not(IsEmpty()));
  for (const EdgeConflict& c : conflicts) EXPECT_EQ(std::minmax(c.a, c.b), std::minmax(0u, 1u));
  EXPECT_EQ(mesh.twin(edgeRef(0, 2)), kNone);
}

TEST(LinkTriangles, EdgeConflictTheOtherWayRoundIsListedToo) {
  std::vector<EdgeConflict> conflicts;
  linkTriangles({{0, 0}, {1, 0}, {0, 1}, {1, -1}}, std::vector<Corners3>{{1, 0, 3}, {2, 1, 0}}, conflicts);
  ASSERT_THAT(conflicts, ::testing::Not(IsEmpty()));
  for (const EdgeConflict& c : conflicts) EXPECT_EQ(std::minmax(c.a, c.b), std::minmax(0u, 1u));
}

// Threads may reach triangles in any order.
TEST(LinkTriangles, InAnyOrderOfWork) {
  const TriMesh whole = constrainedDelaunay(randomPointsInBox(5, 15000));
  std::vector<Corners3> corners;
  for (const Triangle& t : whole.triangles) corners.push_back(t.v);
  corners.push_back(corners[100]);  // claims the edges of another
  std::vector<EdgeConflict> conflicts, others;
  const TriMesh mesh = linkTriangles(whole.points, corners, conflicts);
  const TriMesh other = linkTriangles(whole.points, corners, others, testing::backwards);
  ASSERT_EQ(mesh.triangles.size(), other.triangles.size());
  EXPECT_FALSE(conflicts.empty());
  ASSERT_EQ(conflicts.size(), others.size());
  for (std::size_t i = 0; i < conflicts.size(); ++i)
    EXPECT_EQ(std::pair(conflicts[i].a, conflicts[i].b), std::pair(others[i].a, others[i].b));
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    EXPECT_EQ(mesh.triangles[t].v, corners[t]);
    EXPECT_EQ(mesh.triangles[t].adj, other.triangles[t].adj);
  }
  EXPECT_EQ(mesh.regions, BulkList<RegionId>(corners.size(), 0));
  EXPECT_EQ(boundaryLoops(mesh), boundaryLoops(mesh, testing::backwards));
}

TEST(LinkTriangles, Nothing) {
  std::vector<EdgeConflict> conflicts;
  const TriMesh mesh = linkTriangles({}, {}, conflicts);
  EXPECT_THAT(mesh.triangles, IsEmpty());
  EXPECT_THAT(conflicts, IsEmpty());
  EXPECT_THAT(boundaryLoops(mesh), IsEmpty());
  EXPECT_THAT(outgoingEdges(mesh), IsEmpty());
}

TEST(OutgoingEdges, StartAtTheVertexAndPreferTheBoundary) {
  TriMesh mesh = ringMesh();
  mesh.points.push_back({9, 9});  // used by no triangle
  const std::vector<EdgeRef> out = outgoingEdges(mesh);
  ASSERT_EQ(out.size(), 9u);
  for (VertexId v = 0; v < 8; ++v) {
    ASSERT_NE(out[v], kNone);
    EXPECT_EQ(mesh.origin(out[v]), v);
    EXPECT_EQ(mesh.twin(out[v]), kNone) << "vertex " << v << " is on the boundary";
  }
  EXPECT_EQ(out[8], kNone);
}

TEST(BoundaryLoops, OuterCounterClockwiseHoleClockwise) {
  const TriMesh mesh = ringMesh();
  EXPECT_THAT(boundaryLoops(mesh), ElementsAre(ElementsAre(0, 1, 2, 3), ElementsAre(4, 7, 6, 5)));
}

TEST(BoundaryLoops, StartAtTheLeastVertexAndAreSortedByIt) {
  // Two separate triangles, the right one first.
  const TriMesh mesh = meshOf({{7, 0}, {6, 1}, {5, 0}, {2, 0}, {1, 1}, {0, 0}}, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_THAT(boundaryLoops(mesh), ElementsAre(ElementsAre(5, 3, 4), ElementsAre(2, 0, 1)));
}

TEST(BoundaryLoops, PassAPinchedVertexOnceForEveryFan) {
  // Three triangles that have only the middle in common.
  const TriMesh mesh =
      meshOf({{0, 0}, {2, -1}, {2, 1}, {-1, 2}, {-2, 1}, {-2, -1}, {-1, -2}}, {{0, 1, 2}, {0, 3, 4}, {0, 5, 6}});
  const auto loops = boundaryLoops(mesh);
  std::size_t passes = 0, edges = 0;
  for (const Loop& loop : loops) {
    passes += static_cast<std::size_t>(std::ranges::count(loop, 0u));
    edges += loop.size();
    EXPECT_GT(areaOf(mesh, loop), 0.0);
  }
  EXPECT_EQ(passes, 3u);
  EXPECT_EQ(edges, 9u);
}

TEST(BoundaryLoops, BowTieInsideAHole) {
  // Two holes that touch: the boundary passes their common vertex twice, and is clockwise both times.
  const TriMesh mesh = constrainedDelaunay(touchingHoles());
  const auto loops = boundaryLoops(mesh);
  double area = 0.0;
  for (const Loop& loop : loops) area += areaOf(mesh, loop);
  double covered = 0.0;
  std::multiset<VertexId> on_boundary;
  for (const Triangle& t : mesh.triangles)
    covered += signedArea(mesh.points[t.v[0]], mesh.points[t.v[1]], mesh.points[t.v[2]]);
  for (const Loop& loop : loops) on_boundary.insert(loop.begin(), loop.end());
  EXPECT_NEAR(area, covered, 1e-12);
  EXPECT_EQ(on_boundary.count(4), 2u);  // where the two holes touch
  EXPECT_EQ(on_boundary.count(0), 2u);  // where a hole touches the outer ring
}

// In every mesh, loops are closed and contain each boundary edge once; their signed areas add up to the meshed area.
TEST(BoundaryLoops, CoverTheBoundaryOnce) {
  for (const NamedPslg& named : assortedPslgs()) {
    SCOPED_TRACE(named.name);
    const TriMesh mesh = constrainedDelaunay(named.pslg);
    std::set<std::pair<VertexId, VertexId>> boundary;
    double covered = 0.0, enclosed = 0.0;
    for (TriId t = 0; t < mesh.triangles.size(); ++t) {
      const auto& v = mesh.triangles[t].v;
      covered += signedArea(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
      for (unsigned i = 0; i < 3; ++i)
        if (mesh.triangles[t].adj[i] == kNone)
          boundary.insert({mesh.origin(edgeRef(t, i)), mesh.target(edgeRef(t, i))});
    }
    Point last{-1e300, -1e300};
    for (const Loop& loop : boundaryLoops(mesh)) {
      const Point& first = mesh.points[loop.front()];
      EXPECT_FALSE(lexLess(first, last));
      last = first;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        EXPECT_EQ(boundary.erase({loop[i], loop[(i + 1) % loop.size()]}), 1u);
        EXPECT_FALSE(lexLess(mesh.points[loop[i]], first));
      }
      enclosed += areaOf(mesh, loop);
    }
    EXPECT_THAT(boundary, IsEmpty());
    EXPECT_NEAR(enclosed, covered, 1e-12 * covered);
  }
}

TEST(Digest, TellsMeshesApart) {
  const TriMesh mesh = squareMesh();
  const std::uint64_t digest = digestOf(mesh);
  EXPECT_EQ(digestOf(squareMesh()), digest);
  EXPECT_NE(digestOf(mesh, 1), digest);

  std::set<std::uint64_t> digests{digest};
  const auto add = [&](const TriMesh& changed) { EXPECT_TRUE(digests.insert(digestOf(changed)).second); };
  for (std::size_t v = 0; v < 4; ++v) {
    // One bit of one coordinate.
    TriMesh changed = mesh;
    changed.points[v].x = std::nextafter(changed.points[v].x, 2.0);
    add(changed);
    changed = mesh;
    changed.points[v].y = std::nextafter(changed.points[v].y, 2.0);
    add(changed);
  }
  TriMesh changed = mesh;
  changed.points[0].x = -0.0;
  add(changed);
  changed = mesh;
  std::swap(changed.points[0].x, changed.points[3].y);
  add(changed);
  changed = mesh;
  std::swap(changed.triangles[0], changed.triangles[1]);
  add(changed);
  changed = mesh;
  std::ranges::rotate(changed.triangles[0].v, changed.triangles[0].v.begin() + 1);
  add(changed);
  for (unsigned i = 0; i < 3; ++i) {
    // One corner of one triangle.
    changed = mesh;
    auto& corner = changed.triangles[0].v[i];
    corner = (corner + 1) % 4;
    add(changed);
  }
  changed = mesh;
  changed.points.push_back({0, 0});
  add(changed);
  changed = mesh;
  changed.triangles.pop_back();
  add(changed);
  add(TriMesh{});
}

}  // namespace
}  // namespace coastmesh
