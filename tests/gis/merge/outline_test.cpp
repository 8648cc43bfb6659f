#include "gis/merge/outline.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/gis/merge/merged.hpp"

namespace coastmesh {
namespace {

using namespace coastmesh::testing;

TEST(Outline, HoldsIslandsButNotOpenHoles) {
  const auto inHole = [](int x, int y) { return x >= 3 && x < 5 && y >= 3 && y < 5; };
  Grid grid = gridOf({8, 8, 1.0, {}, 0.0, [&](int x, int y) { return !inHole(x, y); }}, BoundaryRole::Open);
  ASSERT_EQ(grid.boundaries.size(), 2u);
  const TriMesh mesh = linkGrid(grid).mesh;
  const Outline around(grid, mesh);
  EXPECT_EQ(around.edges().size(), 32u);
  EXPECT_TRUE(around.hasOpen());
  EXPECT_TRUE(around.surrounds({4.1, 4.2}));
  grid.boundaries[1].role = BoundaryRole::Open;
  const Outline ring(grid, mesh);
  EXPECT_EQ(ring.edges().size(), 40u);
  EXPECT_FALSE(ring.surrounds({4.1, 4.2}));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1.0, 9.0);
  for (int i = 0; i < 500; ++i) {
    const Point p{place(random), place(random)};
    const bool inside = p.x > 0.0 && p.x < 8.0 && p.y > 0.0 && p.y < 8.0;
    EXPECT_EQ(around.surrounds(p), inside);
    EXPECT_EQ(ring.surrounds(p), inside && !(p.x > 3.0 && p.x < 5.0 && p.y > 3.0 && p.y < 5.0));
  }
}

TEST(Outline, JoinsAlongOpenEdges) {
  Grid grid = gridOf({4, 4});
  openWhere(grid, [](const Point& p) { return p.y > 3.9; });
  const Outline some(grid, linkGrid(grid).mesh);
  EXPECT_TRUE(some.hasOpen());
  EXPECT_EQ(std::ranges::count(some.edges(), true, &Outline::Edge::joins), 4);
  for (const Outline::Edge& edge : some.edges())
    EXPECT_EQ(edge.joins, some.place(edge.a).y == 4.0 && some.place(edge.b).y == 4.0);
  const Grid closed = gridOf({4, 4});
  const Outline all(closed, linkGrid(closed).mesh);
  EXPECT_FALSE(all.hasOpen());
  EXPECT_EQ(std::ranges::count(all.edges(), true, &Outline::Edge::joins), 16);
}

}  // namespace
}  // namespace coastmesh
