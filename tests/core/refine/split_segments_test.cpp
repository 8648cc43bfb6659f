#include "core/refine/split_segments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/refine/refine.hpp"
#include "core/triangulate/delaunay.hpp"
#include "core/triangulate/label_regions.hpp"
#include "tests/support/item_loops.hpp"
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

// As few pieces as possible, none longer than `size_max`.
TEST(SplitSegments, PiecesHoldALongestEdge) {
  Pslg square;
  square.points = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  for (std::uint32_t i = 0; i < 4; ++i) square.segments.push_back({i, (i + 1) % 4});
  const std::pair<double, std::size_t> cases[] = {{0.3, 4}, {0.25, 4}, {0.24, 5}, {1.0, 1}, {3.0, 1}, {0.0004, 2500}};
  for (const auto& [longest, pieces] : cases) {
    SCOPED_TRACE(longest);
    const RefineOptions options{.size_max = longest};
    TriMesh mesh = constrainedDelaunay(square);
    VertexNotes notes = noteInput(mesh, boundOf(options));
    EXPECT_EQ(splitSegments(mesh, square, notes, options), 4 * (pieces - 1));
    for (TriId t = 0; t < mesh.triangles.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        if (mesh.segment(edgeRef(t, i)) == kNone) continue;
        const Point &a = mesh.points[mesh.origin(edgeRef(t, i))], &b = mesh.points[mesh.target(edgeRef(t, i))];
        EXPECT_NEAR(std::hypot(b.x - a.x, b.y - a.y), 1.0 / static_cast<double>(pieces), 1e-9);
      }
    }
  }
}

TEST(SplitSegments, AreWantedForLengthsAndBesideALattice) {
  TriMesh mesh = constrainedDelaunay(wideLake());
  const ConstantSize size(0.1);
  EXPECT_TRUE(wantsSplitSegments(mesh, {.size = &size}));
  EXPECT_FALSE(wantsSplitSegments(mesh, {.size_max = 0.1}));
  EXPECT_FALSE(wantsSplitSegments(mesh, {}));
  mesh.points.push_back({0.5, 0.5});  // a lattice point
  EXPECT_TRUE(wantsSplitSegments(mesh, {.size_max = 0.1}));
  EXPECT_FALSE(wantsSplitSegments(mesh, {}));
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

TEST(SplitSegments, OrderOfWorkDoesNotMatter) {
  const Pslg pslg = sawBand(10'000);
  // The left side has more divisions than are made at once.
  const SizeOf size(0.001, 1.0, [](const Point& x) { return std::min(0.001 + x.x, 0.4 + 0.3 * std::sin(0.01 * x.x)); });
  for (const std::uint64_t most : {kMostVertices, std::uint64_t{40'000}}) {
    const RefineOptions options{.max_vertices = most, .size = &size};
    TriMesh first = constrainedDelaunay(pslg), second = first;
    VertexNotes notes = noteInput(first, boundOf(options)), same = notes;
    const std::uint64_t added = splitSegments(first, pslg, notes, options);
    EXPECT_EQ(splitSegments(second, pslg, same, options, testing::backwards), added);
    EXPECT_GT(added, 15'000u);
    EXPECT_LE(first.points.size(), most);
    EXPECT_EQ(digestOf(first), digestOf(second));
    EXPECT_EQ(notes.spacing, same.spacing);
  }
}

// Where there is room for hardly any, not all are divided: that would take weeks here.
TEST(SplitSegments, FarTooManyAreNotDividedInVain) {
  const Pslg pslg = sawBand(10'000);
  const ConstantSize size(1e-9);
  const RefineOptions options{.max_vertices = 30'000, .size = &size};
  TriMesh mesh = constrainedDelaunay(pslg);
  VertexNotes notes = noteInput(mesh, boundOf(options));
  splitSegments(mesh, pslg, notes, options);
  EXPECT_EQ(mesh.points.size(), options.max_vertices);
}

}  // namespace
}  // namespace coastmesh
