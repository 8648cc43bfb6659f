#include "core/refine/vertex_ops.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "core/refine/refine.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/mesh_figures.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

constexpr double kNoSize = std::numeric_limits<double>::infinity();

std::size_t countBad(const EditMesh& mesh, const TriangleBound& bound) {
  std::size_t bad = 0;
  for (TriId t = 0; t < mesh.triangleSlots(); ++t)
    bad += mesh.isLive(t) && isBad(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2), bound);
  return bad;
}

// A mesh refined for a larger angle than the operations must keep, so that they find room.
EditMesh roomyMesh(const Pslg& pslg) {
  TriMesh mesh = constrainedDelaunay(pslg);
  refine(mesh, pslg, {.min_angle_deg = 33.0, .algorithm = Algorithm::Optimal});
  return EditMesh(std::move(mesh));
}

std::vector<VertexId> neighboursOf(const EditMesh& mesh, VertexId v) {
  std::vector<EdgeRef> star;
  mesh.star(v, star);
  std::vector<VertexId> all;
  for (const EdgeRef e : star) all.push_back(mesh.origin(e));
  if (mesh.target(star.back()) != all.front()) all.push_back(mesh.target(star.back()));
  return all;
}

class VertexOpsOf : public ::testing::TestWithParam<NamedPslg> {
 protected:
  VertexOpsOf()
      : mesh_(roomyMesh(GetParam().pslg)), bound_(25.0, 180.0, kNoSize), ops_(mesh_, GetParam().pslg, bound_) {}

  // Applies an operation to a vertex and checks its contract. Returns whether it changed anything.
  bool attempt(VertexId v, std::size_t vertices_fewer, const std::function<bool(std::vector<TriId>&)>& operation) {
    const std::uint64_t digest = digestOf(releasedCopy(mesh_));
    const std::size_t bad = countBad(mesh_, bound_), vertices = mesh_.vertexCount();
    std::vector<TriId> touched;
    if (!operation(touched)) {
      EXPECT_EQ(digestOf(releasedCopy(mesh_)), digest) << "failed at vertex " << v << ", and changed something";
      return false;
    }
    EXPECT_FALSE(touched.empty());
    EXPECT_EQ(describe(checkMesh(releasedCopy(mesh_), &GetParam().pslg, {})), "") << "vertex " << v;
    EXPECT_LE(countBad(mesh_, bound_), bad) << "vertex " << v;
    EXPECT_EQ(mesh_.vertexCount(), vertices - vertices_fewer);
    for (const TriId t : touched) EXPECT_LT(t, mesh_.triangleSlots());
    return true;
  }

  EditMesh mesh_;
  TriangleBound bound_;
  VertexOps ops_;
};

TEST_P(VertexOpsOf, RemoveLeavesGoodTriangles) {
  for (VertexId v = mesh_.inputVertices(); v < mesh_.vertexSlots(); v += 2) {
    const bool done = attempt(v, 1, [&](auto& touched) { return ops_.remove(v, touched); });
    EXPECT_EQ(mesh_.isLiveVertex(v), !done);
    if (HasFailure()) return;
  }
}

TEST_P(VertexOpsOf, RelocateLeavesGoodTriangles) {
  for (VertexId v = mesh_.inputVertices(); v < mesh_.vertexSlots(); v += 2) {
    const VertexKind kind = mesh_.kind(v);
    attempt(v, 0, [&](auto& touched) { return ops_.relocate(v, touched); });
    EXPECT_TRUE(mesh_.isLiveVertex(v));
    EXPECT_EQ(mesh_.kind(v), kind);
    if (HasFailure()) return;
  }
}

TEST_P(VertexOpsOf, MergeLeavesGoodTriangles) {
  for (VertexId v = mesh_.inputVertices(); v < mesh_.vertexSlots(); v += 2) {
    if (!mesh_.isLiveVertex(v)) continue;
    for (const VertexId w : neighboursOf(mesh_, v)) {
      if (mesh_.kind(w) == VertexKind::Input) continue;
      const bool swap = mesh_.kind(v) == VertexKind::Segment && mesh_.kind(w) == VertexKind::Free;
      const VertexId goes = swap ? w : v, stays = swap ? v : w;
      const VertexKind kind = mesh_.kind(stays);
      if (!attempt(v, 1, [&](auto& touched) { return ops_.merge(goes, stays, touched); })) continue;
      EXPECT_FALSE(mesh_.isLiveVertex(goes));
      EXPECT_TRUE(mesh_.isLiveVertex(stays));
      EXPECT_EQ(mesh_.kind(stays), kind);
      break;
    }
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(All, VertexOpsOf, ::testing::ValuesIn(assortedPslgs()),
                         [](const auto& param_info) { return nameOf(param_info.param); });

// Each operation succeeds for some vertices.
TEST(VertexOps, FindRoom) {
  const Pslg pslg = collinearRuns();
  const TriangleBound bound(20.0, 180.0, kNoSize);
  int removed = 0, moved = 0, merged = 0, slid = 0;
  std::vector<TriId> touched;
  {
    EditMesh mesh = roomyMesh(pslg);
    VertexOps ops(mesh, pslg, bound);
    for (VertexId v = mesh.inputVertices(); v < mesh.vertexSlots(); ++v) removed += ops.remove(v, touched);
  }
  {
    EditMesh mesh = roomyMesh(pslg);
    VertexOps ops(mesh, pslg, bound);
    for (VertexId v = mesh.inputVertices(); v < mesh.vertexSlots(); ++v) {
      (mesh.kind(v) == VertexKind::Segment ? slid : moved) += ops.relocate(v, touched);
    }
  }
  {
    EditMesh mesh = roomyMesh(pslg);
    VertexOps ops(mesh, pslg, bound);
    for (VertexId v = mesh.inputVertices(); v < mesh.vertexSlots(); ++v) {
      if (!mesh.isLiveVertex(v) || mesh.kind(v) != VertexKind::Free) continue;
      for (const VertexId w : neighboursOf(mesh, v))
        if (mesh.kind(w) != VertexKind::Input && ops.merge(v, w, touched)) {
          ++merged;
          break;
        }
    }
  }
  EXPECT_GT(removed, 10);
  EXPECT_GT(moved, 10);
  EXPECT_GT(merged, 10);
  EXPECT_GT(slid, 0);
}

// Before all of two stars is visited, quick tests rule out most merges with vertices on segments: none that succeeds.
TEST(VertexOps, MergesOntoSegmentsAreFound) {
  const TriangleBound bound(20.0, 180.0, kNoSize);
  int onto = 0, along = 0, none = 0;
  for (const Pslg& pslg : {collinearRuns(), narrowChannel(0.1), fractalCoast(3, 3, 1)}) {
    const EditMesh mesh = roomyMesh(pslg);
    for (VertexId v = mesh.inputVertices(); v < mesh.vertexSlots(); ++v) {
      if (!mesh.isLiveVertex(v)) continue;
      const auto merges = [&](VertexId w) {
        EditMesh copy = mesh;
        std::vector<TriId> touched;
        return mesh.kind(w) == VertexKind::Segment && VertexOps(copy, pslg, bound).merge(v, w, touched);
      };
      const bool possible = std::ranges::any_of(neighboursOf(mesh, v), merges);
      EditMesh copy = mesh;
      std::vector<TriId> touched;
      const bool merged = VertexOps(copy, pslg, bound).mergeWithNeighbour(v, false, touched);
      if (possible) {
        EXPECT_TRUE(merged) << "vertex " << v;
      }
      (mesh.kind(v) == VertexKind::Free ? onto : along) += possible;
      none += !merged;
    }
  }
  EXPECT_GT(onto, 10);
  EXPECT_GT(along, 10);
  EXPECT_GT(none, 10);
}

// A square with one vertex in its middle, and one in the middle of a side.
TEST(VertexOps, NeedlessVerticesOfASquareGo) {
  const Pslg pslg = squarePslg();
  EditMesh mesh(constrainedDelaunay(pslg));
  std::vector<TriId> touched;
  Patch cavity;
  const Point middle{0.5, 0.45};
  ASSERT_TRUE(mesh.findCavity(middle, mesh.locate(middle, 0).triangle, cavity));
  const VertexId inner = mesh.insertInCavity(middle, cavity, touched);
  EdgeRef side = kNone;
  for (TriId t = 0; t < mesh.triangleSlots(); ++t)
    for (unsigned i = 0; i < 3; ++i)
      if (mesh.segment(edgeRef(t, i)) == 0) side = edgeRef(t, i);
  ASSERT_NE(side, kNone);
  const VertexId on_side = mesh.splitSegment(side, {0.5, 0.0}, touched);
  ASSERT_NE(on_side, kNone);
  // At 26 degrees, the inner vertex can be removed while the one on the side remains; then that one, too.
  const TriangleBound bound(26.0, 180.0, kNoSize);
  VertexOps ops(mesh, pslg, bound);
  EXPECT_TRUE(ops.remove(inner, touched));
  EXPECT_TRUE(ops.remove(on_side, touched));
  EXPECT_EQ(mesh.vertexCount(), 4u);
  expectValidMesh(releasedCopy(mesh), pslg, {.min_angle_deg = 30.0});
}

}  // namespace
}  // namespace coastmesh
