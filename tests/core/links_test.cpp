#include "core/links.hpp"

#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

#include "core/triangulate/delaunay.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

// Two triangles on either side of the edge from 0 to 1.
std::vector<Triangle> pair() { return {unlinked({0, 1, 2}), unlinked({1, 0, 3})}; }
constexpr EdgeRef kAbove = edgeRef(0, 2), kBelow = edgeRef(1, 2);

TEST(Links, BothSidesOfAnEdgeAreWritten) {
  std::vector<Triangle> triangles = pair();
  link(triangles, kAbove, kBelow, 7);
  EXPECT_EQ(triangles[0].adj, (std::array<EdgeRef, 3>{kNone, kNone, kBelow}));
  EXPECT_EQ(triangles[1].adj, (std::array<EdgeRef, 3>{kNone, kNone, kAbove}));
  EXPECT_EQ(triangles[0].seg, (std::array<SegmentId, 3>{kNone, kNone, 7}));
  EXPECT_EQ(triangles[1].seg, (std::array<SegmentId, 3>{kNone, kNone, 7}));
  setSegment(triangles, kBelow, 9);
  EXPECT_EQ(triangles[0].seg[2], 9u);
  EXPECT_EQ(triangles[1].seg[2], 9u);
  EXPECT_EQ(findBrokenLink(triangles), kNone);
}

TEST(Links, AnEdgeOnTheBoundaryHasOneSide) {
  std::vector<Triangle> triangles = pair();
  link(triangles, edgeRef(0, 1), kNone, 3);
  EXPECT_EQ(triangles[0].adj[1], kNone);
  EXPECT_EQ(triangles[0].seg[1], 3u);
  EXPECT_EQ(findBrokenLink(triangles), kNone);
}

TEST(Links, RenumberedKeepsWhatIsThere) {
  std::vector<Triangle> triangles = pair();
  link(triangles, kAbove, kBelow, 7);
  link(triangles, edgeRef(0, 0), kNone, 4);
  const auto plusTen = [](VertexId v) { return v + 10; };
  const Triangle moved = renumbered(
      triangles[0], [](TriId t) { return t + 5; }, plusTen, kFrozen);
  EXPECT_EQ(moved.v, (std::array<VertexId, 3>{10, 11, 12}));
  EXPECT_EQ(moved.adj, (std::array<EdgeRef, 3>{kNone, kNone, edgeRef(6, 2)}));
  EXPECT_EQ(moved.seg, (std::array<SegmentId, 3>{4, kNone, 7}));
  const auto gone = [](TriId) { return kNone; };
  EXPECT_EQ(renumbered(triangles[0], gone, plusTen, kFrozen).seg, (std::array<SegmentId, 3>{4, kNone, kFrozen}));
  EXPECT_EQ(renumbered(triangles[0], gone, plusTen).seg, (std::array<SegmentId, 3>{4, kNone, 7}));
  EXPECT_EQ(renumbered(triangles[0], gone, plusTen).adj[2], kNone);
}

TEST(Links, EveryDisagreementIsFound) {
  const TriMesh sound = constrainedDelaunay(twoRegions());
  ASSERT_EQ(findBrokenLink(sound.triangles), kNone);
  for (TriId t = 0; t < sound.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (sound.twin(e) == kNone) continue;
      TriMesh mesh = sound;
      mesh.triangles[t].adj[i] = kNone;
      EXPECT_EQ(findBrokenLink(mesh.triangles), sound.twin(e)) << "one side is on the boundary";
      mesh = sound;
      mesh.triangles[t].seg[i] = 1000;
      EXPECT_NE(findBrokenLink(mesh.triangles), kNone) << "segments differ";
      mesh = sound;
      mesh.triangles[t].adj[i] = edgeRef(triOf(sound.twin(e)), next3(indexOf(sound.twin(e))));
      EXPECT_NE(findBrokenLink(mesh.triangles), kNone) << "another edge";
      mesh = sound;
      mesh.triangles[t].adj[i] = edgeRef(static_cast<TriId>(sound.triangles.size()), 0);
      EXPECT_NE(findBrokenLink(mesh.triangles), kNone) << "no such triangle";
      mesh = sound;
      std::swap(mesh.triangles[t].v[next3(i)], mesh.triangles[t].v[prev3(i)]);
      EXPECT_NE(findBrokenLink(mesh.triangles), kNone) << "other ends";
    }
  }
}

}  // namespace
}  // namespace coastmesh
