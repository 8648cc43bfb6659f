#include "core/refine/divide_segments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/lattice/lattice_core.hpp"
#include "core/refine/split_segments.hpp"
#include "core/triangulate/delaunay.hpp"
#include "core/triangulate/label_regions.hpp"
#include "tests/support/item_loops.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/pslgs.hpp"
#include "tests/support/size_cases.hpp"

namespace coastmesh {
namespace {

using Place = std::pair<std::int64_t, std::int64_t>;

Place placeOf(const Point& p) {
  constexpr double kGrid = 1e8;
  return {std::llround(p.x * kGrid), std::llround(p.y * kGrid)};
}

std::map<Place, double> spacingByPlace(const TriMesh& mesh, const VertexNotes& notes) {
  std::map<Place, double> all;
  for (VertexId v = 0; v < mesh.points.size(); ++v) all[placeOf(mesh.points[v])] = notes.spacing[v];
  return all;
}

// The edges of segments, by the places of their ends and the segment.
std::set<std::tuple<Place, Place, SegmentId>> constrainedEdges(const TriMesh& mesh) {
  std::set<std::tuple<Place, Place, SegmentId>> all;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (mesh.segment(e) == kNone) continue;
      const auto [a, b] = std::minmax({placeOf(mesh.point(mesh.origin(e))), placeOf(mesh.point(mesh.target(e)))});
      all.insert({a, b, mesh.segment(e)});
    }
  }
  return all;
}

class DivideSegments : public ::testing::TestWithParam<NamedPslg> {};

// Triangulated together with the lattice's points, divisions make the mesh that `splitSegments` makes one by one.
TEST_P(DivideSegments, MakesTheMeshOfSplitSegments) {
  const Pslg& pslg = GetParam().pslg;
  const RefineOptions options{.size_max = 0.02};
  const TriMesh plain = constrainedDelaunay(pslg);
  const std::vector<LatticePlaces> places = layLattices(plain, {.size_max = 0.02, .most_places = 1000000});
  VertexNotes notes = noteInput(plain, boundOf(options));
  VertexNotes same = notes;
  const DividedSegments divided = divideSegments(plain, pslg, notes, options, kMostVertices);
  EXPECT_EQ(divided.pieces.empty(), pslg.segments.empty());
  if (divided.pieces.empty()) return;
  TriMesh at_once = triangulateWith(pslg, places, true, divided).mesh;
  noteFurther(at_once, notes, divided.spacing);
  VertexNotes further = notes;
  TriMesh again = at_once;
  EXPECT_EQ(splitSegments(again, pslg, further, options), 0u);
  // One by one, those at a pinched vertex are found in one of its fans only.
  if (GetParam().name == "TouchingHoles") return;
  TriMesh one_by_one = triangulateWith(pslg, places, true).mesh;
  noteFurther(one_by_one, same);
  EXPECT_EQ(splitSegments(one_by_one, pslg, same, options), divided.points.size());
  EXPECT_EQ(at_once.input_vertices, one_by_one.input_vertices);
  EXPECT_EQ(at_once.triangles.size(), one_by_one.triangles.size());
  EXPECT_EQ(constrainedEdges(at_once), constrainedEdges(one_by_one));
  const std::map<Place, double> spacing = spacingByPlace(at_once, notes), expected = spacingByPlace(one_by_one, same);
  ASSERT_EQ(spacing.size(), expected.size());
  for (auto it = spacing.begin(), other = expected.begin(); it != spacing.end(); ++it, ++other) {
    ASSERT_EQ(it->first, other->first);
    ASSERT_NEAR(it->second, other->second, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(All, DivideSegments, ::testing::ValuesIn(assortedPslgs()),
                         [](const auto& param_info) { return nameOf(param_info.param); });

// A square of two regions, whose common border is given from top to bottom.
Pslg twoHalves() {
  Pslg pslg;
  pslg.points = {{0.0, 0.0}, {0.5, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.5, 1.0}, {0.0, 1.0}};
  pslg.segments = {{0, 1, 0, 4, kOutside}, {1, 2, 0, 7, kOutside}, {2, 3, 0, 7, kOutside}, {3, 4, 0, 7, kOutside},
                   {4, 5, 0, 4, kOutside}, {5, 0, 0, 4, kOutside}, {4, 1, 0, 7, 4}};
  return pslg;
}

TEST(DivideSegments, PiecesKeepTheLabelsOfTheirSegments) {
  const Pslg pslg = twoHalves();
  const RefineOptions options{.size_max = 0.03};
  const TriMesh plain = constrainedDelaunay(pslg);
  const DividedSegments divided =
      divideSegments(plain, pslg, noteInput(plain, boundOf(options)), options, kMostVertices);
  ASSERT_EQ(divided.pieces.size(), pslg.segments.size() + divided.points.size());
  const TriMesh mesh = triangulateWith(pslg, {}, false, divided).mesh;
  expectValidMesh(mesh, pslg);
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangle(t).v;
    const double x = (mesh.point(v[0]).x + mesh.point(v[1]).x + mesh.point(v[2]).x) / 3.0;
    EXPECT_EQ(mesh.regions[t], x < 0.5 ? 4 : 7);
  }
}

TEST(DivideSegments, OrderOfWorkDoesNotMatter) {
  const Pslg pslg = sawBand(5'000);
  const SizeOf size(0.001, 1.0, [](const Point& x) { return std::min(0.001 + x.x, 0.4 + 0.3 * std::sin(0.01 * x.x)); });
  const RefineOptions options{.size = &size};
  const TriMesh mesh = constrainedDelaunay(pslg);
  const VertexNotes notes = noteInput(mesh, boundOf(options));
  const DividedSegments first = divideSegments(mesh, pslg, notes, options, kMostVertices);
  const DividedSegments second = divideSegments(mesh, pslg, notes, options, kMostVertices, testing::backwards);
  EXPECT_GT(first.points.size(), 10'000u);
  EXPECT_EQ(first.points, second.points);
  EXPECT_EQ(first.spacing, second.spacing);
  EXPECT_EQ(first.of, second.of);
}

TEST(DivideSegments, DoesNothingWithoutRoomForAll) {
  const Pslg pslg = sawBand(100);
  const RefineOptions options{.size_max = 0.1};
  const TriMesh mesh = constrainedDelaunay(pslg);
  const VertexNotes notes = noteInput(mesh, boundOf(options));
  const std::size_t all = divideSegments(mesh, pslg, notes, options, kMostVertices).points.size();
  ASSERT_GT(all, 0u);
  EXPECT_EQ(divideSegments(mesh, pslg, notes, options, all).points.size(), all);
  EXPECT_TRUE(divideSegments(mesh, pslg, notes, options, all - 1).pieces.empty());
  // Dividing all would take weeks here.
  EXPECT_TRUE(divideSegments(mesh, pslg, notes, {.size_max = 1e-12}, 30'000).pieces.empty());
}

// A vertex that rounding alone keeps off a side: pieces of that side might pass it on the wrong side.
TEST(DivideSegments, DoesNothingWhereRoundingDecides) {
  Pslg pslg;
  pslg.points = {{0.0, 0.0}, {1.0, 1.0 / 3.0}, {0.5, 1.0}, {0.5, 1.0 / 6.0 + 1e-16}};
  pslg.segments = {{0, 1}, {1, 2}, {2, 0}};
  const RefineOptions options{.size_max = 0.3};
  const auto divided = [&] {
    const TriMesh mesh = constrainedDelaunay(pslg);
    return divideSegments(mesh, pslg, noteInput(mesh, boundOf(options)), options, kMostVertices);
  };
  EXPECT_TRUE(divided().pieces.empty());
  pslg.points[3].y += 1e-3;
  EXPECT_FALSE(divided().pieces.empty());
}

}  // namespace
}  // namespace coastmesh
