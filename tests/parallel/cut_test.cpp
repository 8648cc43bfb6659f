#include "parallel/cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <tuple>
#include <vector>

#include "core/metric.hpp"
#include "core/refine/refine.hpp"
#include "core/refine/submesh_runs.hpp"
#include "core/triangulate/delaunay.hpp"
#include "core/triangulate/label_regions.hpp"
#include "parallel/near_due.hpp"
#include "parallel/stitch.hpp"
#include "parallel/workers.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

TriMesh refined(const Pslg& pslg) {
  TriMesh mesh = constrainedDelaunay(pslg);
  refine(mesh, pslg, {.min_angle_deg = 30.0, .size_max = 0.05});
  return mesh;
}

double one(TriId) { return 1.0; }

// Triangles identified by corner coordinates, with the segments, spacings and due flag attached to them.
using Known =
    std::tuple<std::array<std::pair<double, double>, 3>, std::array<SegmentId, 3>, std::array<double, 3>, int>;

std::set<Known> known(const MeshState& s) {
  std::set<Known> all;
  for (TriId t = 0; t < s.mesh.triangles.size(); ++t) {
    const Triangle& tri = s.mesh.triangles[t];
    Known k;
    for (unsigned i = 0; i < 3; ++i) {
      std::get<0>(k)[i] = {s.mesh.point(tri.v[i]).x, s.mesh.point(tri.v[i]).y};
      std::get<1>(k)[i] = tri.seg[i];
      std::get<2>(k)[i] = s.notes.spacing[tri.v[i]];
    }
    std::get<3>(k) = s.due_triangles[t];
    all.insert(k);
  }
  return all;
}

// A refined mesh with due triangles near one corner.
MeshState dueInACorner(const Pslg& pslg) {
  MeshState whole;
  whole.mesh = refined(pslg);
  whole.notes = noteInput(whole.mesh, TriangleBound(30.0, 180.0, 0.05));
  whole.due_triangles.resize(whole.mesh.triangles.size());
  const Point corner = pslg.points.front();
  for (TriId t = 0; t < whole.mesh.triangles.size(); ++t)
    whole.due_triangles[t] = squaredDistance(whole.mesh.point(whole.mesh.triangle(t).v[0]), corner) < 0.01;
  return whole;
}

std::vector<CutSubmesh> cutAll(const MeshState& whole, const Partition& parts) {
  std::vector<CutSubmesh> pieces;
  VertexNumbers numbers;
  for (PieceId p = 0; p < parts.pieces; ++p) pieces.push_back(cutOut(whole, parts, p, numbers));
  return pieces;
}

class CutInto : public ::testing::TestWithParam<PieceId> {};

TEST_P(CutInto, PartitionTakesEveryTriangleOnce) {
  const TriMesh mesh = refined(fractalCoast(2, 3, 3));
  for (const double angle : {0.0, 0.7, 1.3}) {
    Recorder recorder;
    Partition parts;
    partition(mesh, {}, GetParam(), angle, one, recorder, parts);
    ASSERT_EQ(parts.pieces, GetParam());
    std::vector<int> seen(mesh.triangles.size(), 0);
    for (PieceId p = 0; p < parts.pieces; ++p) {
      const auto triangles = parts.of(p);
      EXPECT_TRUE(std::ranges::is_sorted(triangles));
      for (std::size_t slot = 0; slot < triangles.size(); ++slot) {
        ++seen[triangles[slot]];
        EXPECT_EQ(parts.piece_of[triangles[slot]], p);
        EXPECT_EQ(parts.slot_of[triangles[slot]], slot);
      }
    }
    EXPECT_TRUE(std::ranges::all_of(seen, [](int times) { return times == 1; }));
  }
}

// Cuts a range of samples as `partition` promises: sorted anew for each cut.
void cutSorted(std::vector<std::array<double, 3>> samples, PieceId first, PieceId pieces, std::uint32_t node,
               std::vector<CutTree::Node>& nodes) {
  nodes[node].piece = first;
  if (pieces == 1 || samples.size() < 2) return;
  std::array<double, 2> low{1e9, 1e9}, high{-1e9, -1e9};
  double whole = 0.0;
  for (const auto& sample : samples) {
    whole += sample[2];
    for (unsigned axis = 0; axis < 2; ++axis) {
      low[axis] = std::min(low[axis], sample[axis]);
      high[axis] = std::max(high[axis], sample[axis]);
    }
  }
  const unsigned axis = high[0] - low[0] >= high[1] - low[1] ? 0 : 1;
  std::ranges::sort(samples, {}, [axis](const auto& s) { return std::tuple(s[axis], s[1 - axis], s[2]); });
  const PieceId lower = pieces / 2;
  const double share = whole * lower / pieces;
  std::size_t middle = 0;
  for (double sum = 0.0; middle + 1 < samples.size() && sum < share; ++middle) sum += samples[middle][2];
  nodes[node] = {axis, samples[middle][axis], {node + 1, node + 2 * lower}, first, false};
  const auto at = samples.begin() + static_cast<std::ptrdiff_t>(middle);
  cutSorted({samples.begin(), at}, first, lower, node + 1, nodes);
  cutSorted({at, samples.end()}, first + lower, pieces - lower, node + 2 * lower, nodes);
}

// Also where many samples are equal, and in meshes so large that threads share the work.
TEST_P(CutInto, CutsHalveTheWeightAlongTheLongerSide) {
  std::vector<Point> points;
  std::vector<std::array<VertexId, 3>> corners;
  for (const int columns : {20, 150}) {
    points.clear();
    corners.clear();
    for (int i = 0; i < columns; ++i) {
      for (int j = 0; j < columns; ++j) {
        const auto first = static_cast<VertexId>(points.size());
        points.insert(points.end(),
                      {{i / 2 * 1.0, j / 3 * 1.0}, {i / 2 + 1.0, j / 3 * 1.0}, {i / 2 * 1.0, j / 3 + 1.0}});
        corners.push_back({first, first + 1, first + 2});
      }
    }
    std::vector<EdgeConflict> conflicts;
    const TriMesh mesh = linkTriangles({points.begin(), points.end()}, corners, conflicts);
    const auto weight = [](TriId t) { return 1.0 + 0.1 * (t % 7); };
    Recorder recorder;
    Partition parts;
    partition(mesh, {}, GetParam(), 0.0, weight, recorder, parts);
    const std::size_t count = corners.size(), stride = std::max<std::size_t>(1, count / (128 * GetParam()));
    std::vector<std::array<double, 3>> samples;
    for (std::size_t t = 0; t < count; t += stride) {
      const Point middle = centroid(points[3 * t], points[3 * t + 1], points[3 * t + 2]);
      samples.push_back({middle.x, middle.y, weight(static_cast<TriId>(t))});
    }
    std::vector<CutTree::Node> expected(2 * GetParam() - 1);
    cutSorted(samples, 0, GetParam(), 0, expected);
    for (std::size_t n = 0; n < expected.size(); ++n) {
      EXPECT_EQ(parts.tree.nodes[n].leaf, expected[n].leaf);
      EXPECT_EQ(parts.tree.nodes[n].axis, expected[n].axis);
      EXPECT_EQ(parts.tree.nodes[n].cut, expected[n].cut);
      EXPECT_EQ(parts.tree.nodes[n].piece, expected[n].piece);
    }
  }
}

TEST_P(CutInto, PiecesAreOfLikeWeight) {
  const TriMesh mesh = refined(squarePslg());
  // The left half of the square weighs four times the right.
  const auto weight = [&](TriId t) { return mesh.point(mesh.triangle(t).v[0]).x < 0.5 ? 4.0 : 1.0; };
  Recorder recorder;
  Partition parts;
  partition(mesh, {}, GetParam(), 0.3, weight, recorder, parts);
  double whole = 0.0;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) whole += weight(t);
  const double fair = whole / GetParam();
  for (PieceId p = 0; p < parts.pieces; ++p) {
    double sum = 0.0;
    for (const TriId t : parts.of(p)) sum += weight(t);
    EXPECT_LT(sum, 1.3 * fair + 8.0);
  }
}

TEST_P(CutInto, StitchedAgainIsTheSameMesh) {
  for (const Pslg& pslg : {fractalCoast(2, 3, 3), touchingHoles(), openLines(), twoRegions()}) {
    MeshState whole;
    whole.mesh = refined(pslg);
    whole.notes = noteInput(whole.mesh, TriangleBound(30.0, 180.0, 0.05));
    whole.due_triangles.resize(whole.mesh.triangles.size());
    for (TriId t = 0; t < whole.mesh.triangles.size(); t += 3) whole.due_triangles[t] = 1;
    Recorder recorder;
    Partition parts;
    partition(whole.mesh, {}, GetParam(), 0.4, one, recorder, parts);
    std::vector<CutSubmesh> pieces;
    VertexNumbers numbers;
    for (PieceId p = 0; p < parts.pieces; ++p) pieces.push_back(cutOut(whole, parts, p, numbers));
    MeshState again = whole;
    stitch(std::move(pieces), recorder, again);

    TriMesh labelled = again.mesh;
    labelRegions(labelled, pslg);
    expectValidMesh(labelled, pslg);
    ASSERT_EQ(again.mesh.points.size(), whole.mesh.points.size());
    for (VertexId v = 0; v < whole.mesh.input_vertices; ++v) EXPECT_EQ(again.mesh.point(v), whole.mesh.point(v));
    EXPECT_EQ(known(again), known(whole));
  }
}

TEST(NearDue, GrowsByOneEdgeAtATime) {
  const MeshState whole = dueInACorner(squarePslg());
  BulkList<TriId> before = trianglesNearDue(whole, 0, inOrder);
  ASSERT_FALSE(before.empty());
  for (const TriId t : before) EXPECT_TRUE(whole.due_triangles[t]);
  EXPECT_EQ(before.size(), static_cast<std::size_t>(std::ranges::count(whole.due_triangles, 1)));
  for (unsigned edges = 1; edges < 4; ++edges) {
    std::set<TriId> next(before.begin(), before.end());
    for (const TriId t : before)
      for (const EdgeRef twin : whole.mesh.triangle(t).adj)
        if (twin != kNone) next.insert(triOf(twin));
    before.assign(next.begin(), next.end());
    EXPECT_EQ(trianglesNearDue(whole, edges, inOrder), before);
  }
}

TEST_P(CutInto, StitchedInPlaceIsTheSameMesh) {
  for (const Pslg& pslg : {fractalCoast(2, 3, 3), touchingHoles(), openLines(), twoRegions()}) {
    const MeshState before = dueInACorner(pslg);
    const BulkList<TriId> some = trianglesNearDue(before, 3, inOrder);
    ASSERT_FALSE(some.empty());
    ASSERT_LT(some.size(), before.mesh.triangles.size());
    MeshState whole = before;
    Recorder recorder;
    Partition parts;
    partition(whole.mesh, some, GetParam(), 0.4, one, recorder, parts);
    stitchInPlace(cutAll(whole, parts), parts, recorder, whole);
    EXPECT_EQ(whole.mesh.points, before.mesh.points);
    EXPECT_EQ(known(whole), known(before));
  }
}

// Items added by growing pieces are appended; holes left by shrinking pieces are filled with the last items.
TEST_P(CutInto, PiecesOfSomeMayGrowAndShrink) {
  std::size_t grown = 0, shrunk = 0;
  for (const Pslg& pslg : {fractalCoast(2, 3, 3), touchingHoles(), openLines(), twoRegions()}) {
    MeshState whole = dueInACorner(pslg);
    const BulkList<TriId> some = trianglesNearDue(whole, 6, inOrder);
    const std::size_t triangles = whole.mesh.triangles.size();
    const RefineOptions finer{.min_angle_deg = 30.0, .size_max = 0.02}, coarser{.min_angle_deg = 20.0};
    Recorder recorder;
    Partition parts;
    partition(whole.mesh, some, GetParam(), 0.4, one, recorder, parts);
    std::vector<CutSubmesh> pieces = cutAll(whole, parts);
    for (CutSubmesh& cut : pieces) refineSubmesh(cut.state, pslg, finer, false, {});
    stitchInPlace(std::move(pieces), parts, recorder, whole);
    const std::size_t most = whole.mesh.triangles.size();
    ASSERT_GE(most, triangles);
    grown += most - triangles;
    TriMesh labelled = whole.mesh;
    labelRegions(labelled, pslg);
    expectValidMesh(labelled, pslg);

    whole.notes = {};
    whole.due_triangles = {};
    whole.due_vertices.assign(whole.mesh.points.size(), 0);
    for (VertexId v = whole.mesh.input_vertices; v < whole.mesh.points.size(); ++v)
      whole.due_vertices[v] = squaredDistance(whole.mesh.point(v), pslg.points.front()) < 0.01;
    partition(whole.mesh, trianglesNearDue(whole, 3, inOrder), GetParam(), 0.4, one, recorder, parts);
    pieces = cutAll(whole, parts);
    for (CutSubmesh& cut : pieces) coarsenSubmesh(cut.state, pslg, coarser, {});
    stitchInPlace(std::move(pieces), parts, recorder, whole);
    shrunk += most - whole.mesh.triangles.size();
    EXPECT_EQ(whole.due_vertices.size(), whole.mesh.points.size());
    labelRegions(whole.mesh, pslg);
    expectValidMesh(whole.mesh, pslg);
  }
  if (GetParam() > 1) return;  // in small pieces, every edge may lie at a cut
  EXPECT_GT(grown, 0u);
  EXPECT_GT(shrunk, 0u);
}

TEST_P(CutInto, PiecesShareFrozenEdgesOnly) {
  MeshState whole;
  whole.mesh = refined(twoRegions());
  whole.notes = noteInput(whole.mesh, TriangleBound(30.0, 180.0, 0.05));
  Recorder recorder;
  Partition parts;
  partition(whole.mesh, {}, GetParam(), 0.0, one, recorder, parts);
  VertexNumbers numbers;
  std::size_t frozen = 0;
  for (PieceId p = 0; p < parts.pieces; ++p) {
    const CutSubmesh cut = cutOut(whole, parts, p, numbers);
    for (const Triangle& t : cut.state.mesh.triangles) {
      for (unsigned i = 0; i < 3; ++i) {
        if (t.seg[i] != kFrozen) continue;
        ++frozen;
        EXPECT_EQ(t.adj[i], kNone);
        EXPECT_LT(t.v[next3(i)], cut.state.mesh.input_vertices);
        EXPECT_LT(t.v[prev3(i)], cut.state.mesh.input_vertices);
      }
    }
    for (VertexId v = 0; v < whole.mesh.points.size(); ++v) ASSERT_EQ(numbers[v], kNone);
  }
  EXPECT_EQ(frozen > 0, GetParam() > 1);
  EXPECT_EQ(frozen % 2, 0u);
}

// Coarsening needs no notes; stitching leaves absent notes absent.
TEST_P(CutInto, NothingNotedStaysNothing) {
  const Pslg pslg = fractalCoast(2, 3, 3);
  MeshState whole;
  whole.mesh = refined(pslg);
  whole.due_vertices.assign(whole.mesh.points.size(), 1);
  Recorder recorder;
  Partition parts;
  partition(whole.mesh, {}, GetParam(), 0.4, one, recorder, parts);
  std::vector<CutSubmesh> pieces;
  VertexNumbers numbers;
  for (PieceId p = 0; p < parts.pieces; ++p) pieces.push_back(cutOut(whole, parts, p, numbers));
  MeshState again = whole;
  stitch(std::move(pieces), recorder, again);
  EXPECT_TRUE(again.notes.spacing.empty());
  EXPECT_TRUE(again.notes.small_angle.empty());
  EXPECT_TRUE(again.notes.shell_unit.empty());
  EXPECT_TRUE(again.due_triangles.empty());
  EXPECT_EQ(again.due_vertices, whole.due_vertices);
  labelRegions(again.mesh, pslg);
  expectValidMesh(again.mesh, pslg);
}

INSTANTIATE_TEST_SUITE_P(Pieces, CutInto, ::testing::Values(1, 2, 3, 7, 16));

}  // namespace
}  // namespace coastmesh
