#include "core/hilbert.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "core/metric.hpp"
#include "tests/support/bulk_lists.hpp"
#include "tests/support/item_loops.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

TEST(HilbertIndex, NeighboursOnTheCurveAreNeighboursOnTheGrid) {
  // A corner block of the grid contains a contiguous stretch of the curve.
  constexpr std::uint32_t kSide = 64;
  struct Cell {
    std::uint32_t index, x, y;
  };
  std::vector<Cell> cells;
  for (std::uint32_t x = 0; x < kSide; ++x)
    for (std::uint32_t y = 0; y < kSide; ++y) cells.push_back({hilbertIndex(x, y), x, y});
  std::ranges::sort(cells, {}, &Cell::index);
  for (std::size_t i = 1; i < cells.size(); ++i) {
    ASSERT_EQ(cells[i].index, cells[i - 1].index + 1);
    const int dx = static_cast<int>(cells[i].x) - static_cast<int>(cells[i - 1].x);
    const int dy = static_cast<int>(cells[i].y) - static_cast<int>(cells[i - 1].y);
    ASSERT_EQ(std::abs(dx) + std::abs(dy), 1) << "step " << i;
  }
}

TEST(HilbertIndex, QuartersOfTheGridAreQuartersOfTheCurve) {
  std::set<std::uint32_t> quarters;
  for (const std::uint32_t x : {0u, 0xFFFFu})
    for (const std::uint32_t y : {0u, 0xFFFFu}) quarters.insert(hilbertIndex(x, y) >> 30);
  EXPECT_EQ(quarters, (std::set<std::uint32_t>{0, 1, 2, 3}));
}

TEST(HilbertIndices, OfNothingAndOfOnePlace) {
  EXPECT_TRUE(hilbertIndices({}).empty());
  const std::vector<Point> same(3, Point{7.0, -2.0});
  const std::vector<std::uint32_t> indices = hilbertIndices(same);
  EXPECT_EQ(indices, (std::vector<std::uint32_t>(3, indices.front())));
}

TEST(HilbertIndices, OfExtentsThatDoublesCannotScale) {
  for (const double far : {5e-324, 1e-310, 1.7e308}) {
    const std::vector<Point> points{{-far, far}, {far, far}, {0.0, 0.0}};
    EXPECT_EQ(hilbertIndices(points).size(), points.size());
  }
}

TEST(HilbertIndices, KeepNeighboursNear) {
  for (const double size : {1e-9, 1.0, 1e12}) {
    std::mt19937_64 random(1);
    std::vector<Point> points;
    for (int i = 0; i < 1000; ++i) {
      const double x = uniform(random, -size, size);
      points.push_back({x, uniform(random, -size, size)});
    }
    const std::vector<std::uint32_t> indices = hilbertIndices(points);
    std::vector<std::size_t> order(points.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    double as_drawn = 0.0, along = 0.0;
    for (std::size_t i = 1; i < order.size(); ++i) as_drawn += distance(points[order[i]], points[order[i - 1]]);
    std::ranges::sort(order, {}, [&](std::size_t i) { return indices[i]; });
    for (std::size_t i = 1; i < order.size(); ++i) along += distance(points[order[i]], points[order[i - 1]]);
    EXPECT_LT(along, 0.1 * as_drawn);
  }
}

TEST(HilbertOrder, IsTheOrderOfTheIndicesAndKeepsThatOfEqualOnes) {
  for (const int count :
       {1, 2, 20, 440, 448, 450, 3000, 40000}) {  // every seventh twice: below, at and above 512, and in parts
    std::mt19937_64 random(2);
    std::vector<Point> points;
    for (int i = 0; i < count; ++i) {
      const double x = uniform(random, 0.0, 1.0);
      points.push_back({x, uniform(random, 0.0, 1.0)});
      if (i % 7 == 0) points.push_back(points.back());
    }
    const std::vector<std::uint32_t> indices = hilbertIndices(points);
    std::vector<std::uint32_t> expected(points.size());
    std::iota(expected.begin(), expected.end(), 0u);
    std::ranges::stable_sort(expected, {}, [&](std::uint32_t i) { return indices[i]; });
    EXPECT_EQ(hilbertOrder(points), expected) << count;
    EXPECT_EQ(hilbertOrder(points, testing::backwards), expected) << count;
  }
  EXPECT_TRUE(hilbertOrder({}).empty());
}

}  // namespace
}  // namespace coastmesh
