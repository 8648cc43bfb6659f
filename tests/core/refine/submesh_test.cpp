#include "core/refine/submesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "core/flip.hpp"
#include "core/links.hpp"
#include "core/metric.hpp"
#include "core/refine/refine.hpp"
#include "core/triangulate/delaunay.hpp"
#include "core/triangulate/label_regions.hpp"
#include "tests/support/item_loops.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/mesh_figures.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

class SubmeshOf : public ::testing::TestWithParam<NamedPslg> {
 protected:
  SubmeshOf()
      : mesh_([] {
          TriMesh mesh = constrainedDelaunay(GetParam().pslg);
          refine(mesh, GetParam().pslg, {.min_angle_deg = 30.0, .algorithm = Algorithm::Optimal});
          return EditMesh(std::move(mesh));
        }()) {
    // Distinct values that identify the vertices.
    for (VertexId v = 0; v < mesh_.vertexSlots(); ++v) notes_.spacing.push_back(1.0 + v);
    for (VertexId v = 0; v < mesh_.inputVertices(); ++v) {
      notes_.shell_unit.push_back(0.5 + v);
      notes_.small_angle.push_back(v % 3 == 0);
    }
  }

  // Triangles spread over the whole mesh.
  std::vector<TriId> centres() const {
    std::vector<TriId> some;
    const TriId step = 1 + mesh_.triangleSlots() / 12;
    for (TriId t = 0; t < mesh_.triangleSlots(); t += step)
      if (mesh_.isLive(t)) some.push_back(t);
    return some;
  }

  EditMesh mesh_;
  VertexNotes notes_;
  PatchNumbers numbers_;
};

TEST_P(SubmeshOf, IsAMeshOfItsOwn) {
  for (const TriId centre : centres()) {
    std::size_t before = 0;
    for (unsigned rings = 0; rings < 4; ++rings) {
      const Submesh patch = extractAround(mesh_, notes_, {&centre, 1}, rings, numbers_);
      ASSERT_GE(patch.triangles.size(), before);
      before = patch.triangles.size();
      EXPECT_EQ(std::set<TriId>(patch.triangles.begin(), patch.triangles.end()).size(), patch.triangles.size());
      expectValidMesh(patch.mesh);
      ASSERT_EQ(patch.mesh.triangles.size(), patch.triangles.size());
      ASSERT_EQ(patch.mesh.points.size(), patch.parent.size());
      ASSERT_EQ(patch.notes.spacing.size(), patch.parent.size());
      for (VertexId v = 0; v < patch.parent.size(); ++v) {
        const VertexId own = patch.parent[v];
        EXPECT_EQ(patch.mesh.points[v], mesh_.point(own));
        EXPECT_EQ(patch.notes.spacing[v], notes_.spacing[own]);
        if (v >= patch.mesh.input_vertices) continue;
        const bool input = own < mesh_.inputVertices();
        EXPECT_EQ(patch.notes.shell_unit[v], input ? notes_.shell_unit[own] : 0.0);
        EXPECT_EQ(patch.notes.small_angle[v], input && notes_.small_angle[own]);
      }
      for (TriId t = 0; t < patch.triangles.size(); ++t)
        for (unsigned i = 0; i < 3; ++i)
          EXPECT_EQ(patch.parent[patch.mesh.triangles[t].v[i]], mesh_.triangle(patch.triangles[t]).v[i]);
    }
  }
}

TEST_P(SubmeshOf, BoundaryIsFrozenUnlessItIsTheDomains) {
  for (const TriId centre : centres()) {
    const Submesh patch = extractAround(mesh_, notes_, {&centre, 1}, 2, numbers_);
    const std::set<TriId> inside(patch.triangles.begin(), patch.triangles.end());
    std::set<VertexId> fixed;
    std::size_t frozen = 0;
    for (TriId t = 0; t < patch.triangles.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(patch.triangles[t], i);
        const VertexId corner = mesh_.triangle(patch.triangles[t]).v[i];
        if (mesh_.kind(corner) == VertexKind::Input) fixed.insert(corner);
        const bool leaves = mesh_.twin(e) != kNone && !inside.contains(triOf(mesh_.twin(e)));
        frozen += leaves;
        EXPECT_EQ(patch.mesh.triangles[t].seg[i] == kFrozen, leaves);
        EXPECT_EQ(patch.mesh.triangles[t].adj[i] == kNone, leaves || mesh_.twin(e) == kNone);
        if (!leaves) {
          EXPECT_EQ(patch.mesh.triangles[t].seg[i], mesh_.segment(e));
          continue;
        }
        fixed.insert({mesh_.origin(e), mesh_.target(e)});
        EXPECT_EQ(std::ranges::count(patch.frozen, e), 1);
      }
    }
    EXPECT_EQ(patch.frozen.size(), frozen);
    EXPECT_EQ(std::set<VertexId>(patch.parent.begin(), patch.parent.begin() + patch.mesh.input_vertices), fixed);
  }
}

TEST_P(SubmeshOf, PutBackAsItWasChangesNothing) {
  for (const TriId centre : centres()) {
    EditMesh mesh = mesh_;
    const Submesh patch = extractAround(mesh, notes_, {&centre, 1}, 2, numbers_);
    std::vector<VertexId> added;
    std::vector<TriId> touched;
    putBack(mesh, patch, patch.mesh, added, touched);
    EXPECT_EQ(added.size(), patch.parent.size() - patch.mesh.input_vertices);
    for (std::size_t i = 0; i < added.size(); ++i) {
      const VertexId before = patch.parent[patch.mesh.input_vertices + i];
      EXPECT_EQ(mesh.point(added[i]), mesh_.point(before));
      EXPECT_EQ(mesh.kind(added[i]), mesh_.kind(before));
    }
    const TriMesh released = releasedCopy(mesh);
    expectValidMesh(released, GetParam().pslg);
    EXPECT_EQ(trianglesByPlace(released), trianglesByPlace(releasedCopy(mesh_)));
  }
}

TEST_P(SubmeshOf, ChangedPatchFits) {
  std::mt19937_64 random(3);
  for (const TriId centre : centres()) {
    EditMesh mesh = mesh_;
    const Submesh patch = extractAround(mesh, notes_, {&centre, 1}, 2, numbers_);
    // Inserts points into the patch and removes some of its free vertices.
    EditMesh local{TriMesh(patch.mesh)};
    std::vector<TriId> touched;
    Patch cavity;
    for (TriId t = 0; t < patch.triangles.size(); t += 3) {
      if (!local.isLive(t)) continue;
      const double u = uniform(random, 0.2, 0.4), v = uniform(random, 0.2, 0.4);
      const Point x = (1.0 - u - v) * local.corner(t, 0) + u * local.corner(t, 1) + v * local.corner(t, 2);
      if (local.findCavity(x, t, cavity)) local.insertInCavity(x, cavity, touched);
    }
    for (VertexId v = local.inputVertices(); v < patch.parent.size(); ++v) {
      if (!local.isLiveVertex(v) || local.kind(v) != VertexKind::Free || !local.gatherPatch({&v, 1}, cavity)) continue;
      std::vector<VertexId> polygon;
      for (const BoundaryEdge& r : cavity.boundary) polygon.push_back(r.a);
      std::vector<Corners> fresh;
      if (triangulatePolygon(local, polygon, fresh)) local.replace(cavity, fresh, {&v, 1}, touched);
    }
    const TriMesh solved = local.release();
    std::vector<VertexId> added;
    touched.clear();
    putBack(mesh, patch, solved, added, touched);
    EXPECT_EQ(added.size(), solved.points.size() - patch.mesh.input_vertices);
    mesh.restoreDelaunay(touched);
    expectValidMesh(releasedCopy(mesh), GetParam().pslg);
  }
}

// The same for a compact mesh, with as many triangles as before, more, and fewer.
TEST_P(SubmeshOf, FitsIntoACompactMesh) {
  const TriMesh whole = releasedCopy(mesh_);
  for (TriId centre = 0; centre < whole.triangles.size();
       centre += 1 + static_cast<TriId>(whole.triangles.size()) / 6) {
    for (const unsigned edges : {0u, 3u, 8u}) {
      const Submesh patch = extractNear(whole, notes_, {&centre, 1}, edges);
      expectValidMesh(patch.mesh);
      EXPECT_EQ(patch.triangles.front(), centre);
      TriMesh same = whole;
      putBack(same, patch, patch.mesh);
      EXPECT_EQ(digestOf(same), digestOf(whole));

      EditMesh finer{TriMesh(patch.mesh)};
      std::vector<TriId> touched;
      Patch cavity;
      for (TriId t = 0; t < patch.triangles.size(); t += 2) {
        if (!finer.isLive(t)) continue;
        const Point x = centroid(finer.corner(t, 0), finer.corner(t, 1), finer.corner(t, 2));
        if (finer.findCavity(x, t, cavity)) finer.insertInCavity(x, cavity, touched);
      }
      EditMesh coarser{TriMesh(patch.mesh)};
      for (VertexId v = coarser.inputVertices(); v < patch.parent.size(); ++v) {
        if (coarser.kind(v) != VertexKind::Free || !coarser.gatherPatch({&v, 1}, cavity)) continue;
        std::vector<VertexId> polygon;
        for (const BoundaryEdge& r : cavity.boundary) polygon.push_back(r.a);
        std::vector<Corners> fresh;
        if (triangulatePolygon(coarser, polygon, fresh)) coarser.replace(cavity, fresh, {&v, 1}, touched);
      }
      for (EditMesh* changed : {&finer, &coarser}) {
        const TriMesh solved = changed->release();
        TriMesh mesh = whole;
        const BulkList<TriId> numbers = putBack(mesh, patch, solved);
        for (TriId t = 0; t < numbers.size(); ++t)
          for (unsigned i = 0; i < 3; ++i)
            EXPECT_EQ(mesh.point(mesh.triangle(numbers[t]).v[i]), solved.point(solved.triangle(t).v[i]));
        EXPECT_EQ(mesh.points.size(), whole.points.size() + solved.points.size() - patch.mesh.points.size());
        EXPECT_EQ(mesh.triangles.size(),
                  whole.triangles.size() + solved.triangles.size() - patch.mesh.triangles.size());
        // The mesh is complete: no gap, no overlap, consistent links. The patch's boundary need not be Delaunay.
        std::vector<EdgeRef> edges_of_mesh;
        for (TriId t = 0; t < mesh.triangles.size(); ++t)
          for (unsigned i = 0; i < 3; ++i)
            if (mesh.twin(edgeRef(t, i)) != kNone && mesh.segment(edgeRef(t, i)) == kNone)
              edges_of_mesh.push_back(edgeRef(t, i));
        restoreDelaunay(mesh, std::move(edges_of_mesh));
        mesh.regions.assign(mesh.triangles.size(), 0);
        labelRegions(mesh, GetParam().pslg);
        expectValidMesh(mesh, GetParam().pslg);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SubmeshOf, ::testing::ValuesIn(assortedPslgs()),
                         [](const auto& param_info) { return nameOf(param_info.param); });

// If no vertex is pinched, a ring consists of the triangles that share a vertex with the previous ones.
TEST(Submesh, RingsGrowByVertices) {
  const Pslg pslg = fractalCoast(2, 2, 3);
  const EditMesh mesh(constrainedDelaunay(pslg));
  VertexNotes notes;
  notes.spacing.assign(mesh.vertexSlots(), 1.0);
  notes.shell_unit.assign(mesh.inputVertices(), 0.0);
  notes.small_angle.assign(mesh.inputVertices(), false);
  PatchNumbers numbers;
  for (TriId centre = 0; centre < mesh.triangleSlots(); centre += 17) {
    std::set<TriId> naive{centre};
    for (unsigned rings = 0; rings < 4; ++rings) {
      const Submesh patch = extractAround(mesh, notes, {&centre, 1}, rings, numbers);
      EXPECT_EQ(std::set<TriId>(patch.triangles.begin(), patch.triangles.end()), naive) << rings << " rings";
      std::set<VertexId> corners;
      for (const TriId t : naive) corners.insert(mesh.triangle(t).v.begin(), mesh.triangle(t).v.end());
      for (TriId t = 0; t < mesh.triangleSlots(); ++t)
        if (std::ranges::any_of(mesh.triangle(t).v, [&](VertexId v) { return corners.contains(v); })) naive.insert(t);
    }
  }
}

// Large patches are taken out and put back range by range, on several threads: numbers must not depend on the order of
// the ranges.
TEST(Submesh, OrderOfRangesDoesNotMatter) {
  std::mt19937_64 random(20261126);
  std::uniform_real_distribution<double> place(0.0, 100.0);
  Pslg pslg;
  pslg.points = {{0.0, 0.0}, {100.0, 0.0}, {100.0, 100.0}, {0.0, 100.0}};
  for (std::uint32_t i = 0; i < 4; ++i) pslg.segments.push_back({i, (i + 1) % 4});
  for (int i = 0; i < 60'000; ++i) pslg.points.push_back({place(random), place(random)});
  TriMesh whole = constrainedDelaunay(pslg);
  whole.input_vertices = 2'000;
  const VertexNotes notes = noteInput(whole, boundOf({}));
  std::vector<TriId> centres;
  for (TriId t = 0; t < whole.triangles.size(); t += 1 + static_cast<TriId>(random() % 2'000)) centres.push_back(t);
  centres.push_back(centres.front());

  const Submesh patch = extractNear(whole, notes, centres, 16),
                other = extractNear(whole, notes, centres, 16, testing::backwards);
  ASSERT_GT(patch.triangles.size(), 3u * 8192);  // several ranges
  ASSERT_LT(patch.triangles.size(), whole.triangles.size());
  EXPECT_EQ(patch.triangles, other.triangles);
  EXPECT_EQ(patch.parent, other.parent);
  EXPECT_EQ(patch.frozen, other.frozen);
  EXPECT_EQ(patch.notes.spacing, other.notes.spacing);
  EXPECT_EQ(digestOf(patch.mesh), digestOf(other.mesh));
  expectValidMesh(other.mesh);

  // In the order of a search through one triangle after the other.
  std::vector<TriId> naive;
  std::set<TriId> seen;
  const auto see = [&](TriId t) {
    if (seen.insert(t).second) naive.push_back(t);
  };
  for (const TriId t : centres) see(t);
  std::size_t done = 0;
  for (int edge = 0; edge < 16; ++edge)
    for (const std::size_t end = naive.size(); done < end; ++done)
      for (const EdgeRef twin : whole.triangle(naive[done]).adj)
        if (twin != kNone) see(triOf(twin));
  EXPECT_EQ(patch.triangles, naive);
  std::vector<VertexId> fixed, free;
  std::set<VertexId> numbered;
  for (const TriId t : naive) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i), twin = whole.twin(e);
      std::vector<VertexId> ends;
      if (whole.apex(e) < whole.input_vertices) ends.push_back(whole.apex(e));
      if (twin != kNone && !seen.contains(triOf(twin))) ends.insert(ends.end(), {whole.origin(e), whole.target(e)});
      for (const VertexId v : ends)
        if (numbered.insert(v).second) fixed.push_back(v);
    }
  }
  EXPECT_EQ(patch.mesh.input_vertices, fixed.size());
  for (const TriId t : naive)
    for (const VertexId v : whole.triangle(t).v)
      if (numbered.insert(v).second) free.push_back(v);
  fixed.insert(fixed.end(), free.begin(), free.end());
  EXPECT_EQ(patch.parent, fixed);

  TriMesh solved = patch.mesh;
  for (VertexId v = solved.input_vertices; v < solved.points.size(); ++v) solved.points[v].x += 1e-9;
  TriMesh in_order = whole, backwards = whole;
  EXPECT_EQ(putBack(in_order, patch, solved), putBack(backwards, patch, solved, testing::backwards));
  EXPECT_EQ(digestOf(in_order), digestOf(backwards));
  EXPECT_NE(digestOf(in_order), digestOf(whole));
  EXPECT_EQ(findBrokenLink(backwards.triangles), kNone);
}

}  // namespace
}  // namespace coastmesh
