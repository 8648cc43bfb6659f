#include "gis/elements/quads.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "gis/elements/elements.hpp"
#include "gis/grid/grid_edit.hpp"
#include "tests/gis/quad_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::ElementsAre;
using testing::elementsOf;
using ::testing::IsEmpty;
using testing::mixedGrid;

using Nodes = std::vector<std::uint32_t>;

Grid gridOf(std::vector<Point> places, const Nodes& element) {
  Grid grid;
  grid.nodes.assign(places.begin(), places.end());
  addElement(grid, element);
  return grid;
}

bool allDiagonal(const Grid& grid, std::uint32_t a, std::uint32_t b) {
  return diagonalEdges(grid) == std::vector<NodePair>{edgeKey(a, b)};
}

TEST(Quads, AreGivenBackAsTheyWereAdded) {
  const std::vector<Point> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const Nodes& nodes : {Nodes{0, 1, 2, 3}, Nodes{2, 3, 0, 1}, Nodes{3, 2, 1, 0}, Nodes{1, 0, 3, 2}}) {
    const Grid grid = gridOf(square, nodes);
    EXPECT_EQ(grid.triangles.size(), 2u);
    EXPECT_THAT(elementsOf(grid), ElementsAre(nodes));
    EXPECT_TRUE(allDiagonal(grid, nodes[0], nodes[2]));
  }
}

TEST(Quads, HaveTheDiagonalWithTheLargerAngles) {
  const std::vector<Point> kite{{0, 0}, {1, -4}, {2, 0}, {1, 4}};
  for (const Nodes& nodes : {Nodes{0, 1, 2, 3}, Nodes{1, 2, 3, 0}, Nodes{3, 2, 1, 0}}) {
    const Grid grid = gridOf(kite, nodes);
    EXPECT_TRUE(allDiagonal(grid, 0, 2));
    EXPECT_THAT(elementsOf(grid), ElementsAre(nodes));
  }
}

TEST(Quads, AreSplitAtAReflexNode) {
  const std::vector<Point> dart{{0, 0}, {4, -3}, {1, 0}, {4, 3}};
  for (const Nodes& nodes : {Nodes{0, 1, 2, 3}, Nodes{1, 2, 3, 0}, Nodes{3, 2, 1, 0}}) {
    const Grid grid = gridOf(dart, nodes);
    EXPECT_TRUE(allDiagonal(grid, 0, 2));
    EXPECT_THAT(elementsOf(grid), ElementsAre(nodes));
    const auto angles = anglesOf(grid, quadsOf(grid).front());
    EXPECT_GT(std::ranges::max(angles), 180.0);
    EXPECT_NEAR(std::accumulate(angles.begin(), angles.end(), 0.0), 360.0, 1e-9);
  }
}

TEST(Quads, WithARepeatedNodeAreTriangles) {
  const std::vector<Point> places{{0, 0}, {1, 0}, {1, 1}};
  for (const Nodes& nodes : {Nodes{0, 1, 2, 2}, Nodes{0, 1, 2, 0}}) {
    const Grid grid = gridOf(places, nodes);
    EXPECT_THAT(elementsOf(grid), ElementsAre(Nodes{0, 1, 2}));
    EXPECT_THAT(quadsOf(grid), IsEmpty());
  }
}

TEST(Quads, AnglesAreThoseOnTheGround) {
  const Grid plane = mixedGrid(1, 1, [](int, int) { return true; });
  EXPECT_THAT(anglesOf(plane, quadsOf(plane).front()), Each(DoubleNear(90.0, 1e-9)));
  Grid far = mixedGrid(
      1, 1, [](int, int) { return true; }, wgs84(), 0.01);
  for (Point& p : far.nodes) p = {p.x + 179.99, p.y + 60.0};
  for (Point& p : far.nodes)
    if (p.x > 180.0) p.x -= 360.0;  // across the antimeridian
  EXPECT_THAT(anglesOf(far, quadsOf(far).front()), Each(DoubleNear(90.0, 0.05)));
}

TEST(Quads, SurviveEditsOfOthers) {
  Grid grid = mixedGrid(6, 3, [](int i, int) { return i < 3; });
  const std::size_t quads = quadsOf(grid).size();
  ASSERT_EQ(quads, 9u);
  // One half goes: the other is a triangle.
  std::vector<bool> gone(grid.triangles.size(), false);
  gone[quadsOf(grid)[4].halves[1]] = true;
  removeTriangles(grid, gone);
  EXPECT_EQ(quadsOf(grid).size(), quads - 1);
  // Another order, and more of them.
  std::vector<std::uint32_t> order(grid.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::reverse(order);
  orderTriangles(grid, order);
  EXPECT_EQ(quadsOf(grid).size(), quads - 1);
  Grid part = mixedGrid(2, 1, [](int, int) { return true; }), plain = mixedGrid(2, 1, [](int, int) { return false; });
  appendGrid(plain, std::move(grid));
  appendGrid(plain, std::move(part));
  EXPECT_EQ(quadsOf(plain).size(), quads + 1);
  // A copy of a half is no third half.
  copyTriangle(plain, quadsOf(plain).front().halves[0], plain.triangles[0]);
  EXPECT_EQ(quadsOf(plain).size(), quads + 1);
  requireConsistent(plain);
}

TEST(Quads, ThreeTrianglesOfOneNumberAreNone) {
  Grid grid = mixedGrid(3, 1, [](int, int) { return false; });
  grid.quad_of.assign(grid.triangles.size(), 0);
  EXPECT_THAT(quadsOf(grid), IsEmpty());
}

TEST(Quads, EdgesAndDiagonals) {
  const Grid grid = mixedGrid(4, 2, [](int i, int j) { return (i + j) % 2 == 0; });
  EXPECT_EQ(diagonalEdges(grid).size(), 4u);
  EXPECT_EQ(edgesOfQuads(grid).size(), 4u * 5u);  // they have no side in common
  const std::vector<std::uint8_t> sides = diagonalsOf(grid);
  for (std::uint32_t t = 0; t < sides.size(); ++t) {
    if (sides[t] == kNoDiagonal) continue;
    const NodePair edge = edgeKey(grid.triangles[t][(sides[t] + 1) % 3], grid.triangles[t][(sides[t] + 2) % 3]);
    EXPECT_TRUE(std::ranges::binary_search(diagonalEdges(grid), edge));
  }
  EXPECT_EQ(std::ranges::count_if(sides, [](std::uint8_t side) { return side != kNoDiagonal; }), 8);
  EXPECT_THAT(diagonalsOf(mixedGrid(2, 2, [](int, int) { return false; })), IsEmpty());
}

TEST(Quads, FlagsOfOneHalfAreOfBoth) {
  const Grid grid = mixedGrid(3, 3, [](int i, int) { return i == 1; });
  for (const Quad& quad : quadsOf(grid))
    for (const std::uint32_t t : quad.halves) {
      std::vector<std::uint8_t> chosen(grid.triangles.size(), 0);
      chosen[t] = 1;
      includeOtherHalves(grid, chosen);
      EXPECT_EQ(std::ranges::count(chosen, 1), 2);
      EXPECT_EQ(chosen[quad.halves[0]] + chosen[quad.halves[1]], 2);
    }
}

TEST(Elements, AreNumberedAsInFiles) {
  const Grid grid = mixedGrid(5, 4, [](int i, int j) { return (i * j) % 3 == 1; });
  const Elements elements(grid);
  const auto all = elementsOf(grid);
  ASSERT_EQ(elements.size(), all.size());
  EXPECT_EQ(elements.quads(), quadsOf(grid).size());
  for (std::size_t e = 0; e < all.size(); ++e) {
    const Elements::Nodes nodes = elements.nodesOf(e);
    EXPECT_EQ(Nodes(nodes.begin(), nodes.end()), all[e]);
    EXPECT_EQ(elements.elementOf(elements.triangleOf(e)), e);
    EXPECT_EQ(elements.isQuad(e), all[e].size() == 4);
    if (elements.isQuad(e)) {
      EXPECT_EQ(elements.elementOf(elements.secondHalfOf(e)), e);
    }
  }
  const std::vector<double> ones(grid.triangles.size(), 1.0);
  for (std::size_t e = 0; e < all.size(); ++e) EXPECT_EQ(elements.sumOver(e, ones), elements.isQuad(e) ? 2.0 : 1.0);
}

TEST(Elements, OfTrianglesAloneAreTheTriangles) {
  const Grid grid = mixedGrid(3, 2, [](int, int) { return false; });
  const Elements elements(grid);
  EXPECT_EQ(elements.size(), grid.triangles.size());
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) EXPECT_EQ(elements.elementOf(t), t);
  EXPECT_EQ(elementCount(grid), "12 triangles");
  EXPECT_EQ(elementCount(mixedGrid(3, 2, [](int i, int j) { return i + j == 0; })), "10 triangles, 1 quadrilateral");
}

}  // namespace
}  // namespace coastmesh
