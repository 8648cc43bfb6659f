#include "gis/grid/marked_edges.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::VariantWith;

const auto unknown = VariantWith<std::monostate>(std::monostate{});
auto role(BoundaryRole role) { return VariantWith<BoundaryRole>(role); }
auto line(LineKind kind) { return VariantWith<LineKind>(kind); }

std::vector<MarkerKind> kindsOf(const std::vector<std::int64_t>& markers) { return kindsOfMarkers(markers); }

TEST(KindsOfMarkers, InAnyOrderAndBesideOthers) {
  EXPECT_EQ(boundaryMarker(0, BoundaryRole::Land), 11);
  EXPECT_EQ(boundaryMarker(2, BoundaryRole::Open), 33);
  EXPECT_EQ(lineMarker(3, LineKind::Weir), 46);
  EXPECT_THAT(kindsOf({11, 22, 33, 46}), ElementsAre(role(BoundaryRole::Land), role(BoundaryRole::Island),
                                                     role(BoundaryRole::Open), line(LineKind::Weir)));
  EXPECT_THAT(kindsOf({33, 11, 11, 200}),
              ElementsAre(role(BoundaryRole::Open), role(BoundaryRole::Land), role(BoundaryRole::Land), unknown));
  EXPECT_THAT(kindsOf({44, 33}), ElementsAre(role(BoundaryRole::River), role(BoundaryRole::Open)));
}

TEST(KindsOfMarkers, NumbersOfOtherProgramsAreUnknown) {
  EXPECT_THAT(kindsOf({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}), Each(unknown));
  EXPECT_THAT(kindsOf({11, 12, 13}), Each(unknown)) << "one boundary of three roles";
  EXPECT_THAT(kindsOf({101, 201}), Each(unknown)) << "the tenth and the twentieth of two";
  EXPECT_THAT(kindsOf({10, 20, -11, 0, 18}), Each(unknown));
  EXPECT_THAT(kindsOf({}), IsEmpty());
}

// Triangle lists the pieces of a divided segment elsewhere.
TEST(TakeMarkedEdges, EdgesInAnyOrderMakeTheSameBoundaries) {
  Grid grid;
  const TriMesh mesh = testing::lattice(5, 5, [](int i, int j) { return i != 2 || j != 3; });
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  grid.nodes = mesh.points;
  grid.boundaries = findBoundaries(mesh);
  ASSERT_EQ(grid.boundaries.size(), 2u);
  grid.boundaries[1].role = BoundaryRole::Open;
  std::vector<MarkedEdge> edges = markedEdges(grid);
  Grid again;
  again.nodes = grid.nodes;
  again.triangles = grid.triangles;
  takeMarkedEdges(edges, again);
  ASSERT_EQ(again.boundaries.size(), 2u);
  for (std::size_t b = 0; b < 2; ++b) {
    EXPECT_EQ(again.boundaries[b].role, grid.boundaries[b].role);
    EXPECT_EQ(again.boundaries[b].nodes, grid.boundaries[b].nodes);
  }

  std::rotate(edges.begin(), edges.begin() + 7, edges.end());
  std::swap(edges[2], edges[edges.size() - 2]);
  edges.push_back({{0, 7}, 1});
  again.boundaries.clear();
  takeMarkedEdges(edges, again);
  ASSERT_EQ(again.boundaries.size(), 2u);
  for (std::size_t b = 0; b < 2; ++b) {
    EXPECT_EQ(again.boundaries[b].role, grid.boundaries[b].role);
    EXPECT_TRUE(again.boundaries[b].closed);
    EXPECT_THAT(again.boundaries[b].nodes, ::testing::UnorderedElementsAreArray(grid.boundaries[b].nodes));
  }
}

}  // namespace
}  // namespace coastmesh
