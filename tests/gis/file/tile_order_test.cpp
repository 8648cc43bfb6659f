#include "gis/file/tile_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

constexpr std::size_t kTogether = 51;

std::vector<IndexBox> randomBoxes(std::size_t count, const Point& low, double width, double height) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::vector<IndexBox> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Point at{low.x + width * part(random), low.y + height * part(random)};
    boxes.push_back({at, {at.x + 0.01 * width * part(random), at.y + 0.01 * height * part(random)}});
  }
  return boxes;
}

TileOrder orderOf(const std::vector<IndexBox>& boxes, const ItemLoop& loop = inOrder) {
  return tileOrder(
      static_cast<std::uint32_t>(boxes.size()), kTogether, [&](std::uint32_t row) { return boxes[row]; }, loop);
}

// The mean extent, x plus y, of the box centres of a node's rows.
double reachOfNodes(const std::vector<IndexBox>& boxes, const std::vector<std::uint32_t>& rows) {
  double sum = 0.0;
  std::size_t nodes = 0;
  for (std::size_t first = 0; first < rows.size(); first += kTogether, ++nodes) {
    Point low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
    for (std::size_t i = first; i < std::min(rows.size(), first + kTogether); ++i) {
      const IndexBox& box = boxes[rows[i]];
      const Point middle{(box.low.x + box.high.x) / 2, (box.low.y + box.high.y) / 2};
      low = {std::min(low.x, middle.x), std::min(low.y, middle.y)};
      high = {std::max(high.x, middle.x), std::max(high.y, middle.y)};
    }
    sum += high.x - low.x + high.y - low.y;
  }
  return sum / static_cast<double>(nodes);
}

bool isPermutation(std::vector<std::uint32_t> rows) {
  std::ranges::sort(rows);
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i] != i) return false;
  return true;
}

// Few rows are sorted at once; more are first distributed.
class TileOrderTest : public ::testing::TestWithParam<std::size_t> {};

INSTANTIATE_TEST_SUITE_P(Rows, TileOrderTest, ::testing::Values(1, 51, 200, 1000, 20000, 70000, 200000));

TEST_P(TileOrderTest, HasEveryRowInCompactNodes) {
  const std::vector<IndexBox> boxes = randomBoxes(GetParam(), {-11.5, 49.0}, 1.0, 1.0);
  const TileOrder order = orderOf(boxes);
  ASSERT_EQ(order.rows.size(), boxes.size());
  EXPECT_TRUE(isPermutation(order.rows));
  // The extent of squares that divide the area evenly.
  const double ideal = 2.0 / std::sqrt(static_cast<double>(boxes.size()) / static_cast<double>(kTogether));
  EXPECT_LE(reachOfNodes(boxes, order.rows), 1.25 * ideal);
}

TEST_P(TileOrderTest, KnowsTheBoxOfAll) {
  const std::vector<IndexBox> boxes = randomBoxes(GetParam(), {-1e6, 3e5}, 2e6, 1e4);
  const IndexBox bounds = orderOf(boxes).bounds;
  EXPECT_EQ(bounds.low.x, std::ranges::min(boxes, {}, [](const IndexBox& b) { return b.low.x; }).low.x);
  EXPECT_EQ(bounds.low.y, std::ranges::min(boxes, {}, [](const IndexBox& b) { return b.low.y; }).low.y);
  EXPECT_EQ(bounds.high.x, std::ranges::max(boxes, {}, [](const IndexBox& b) { return b.high.x; }).high.x);
  EXPECT_EQ(bounds.high.y, std::ranges::max(boxes, {}, [](const IndexBox& b) { return b.high.y; }).high.y);
}

TEST_P(TileOrderTest, IsTheSameInAnyOrderOfWork) {
  const std::vector<IndexBox> boxes = randomBoxes(GetParam(), {0.0, 0.0}, 3.0, 0.1);
  const std::vector<std::uint32_t> rows = orderOf(boxes).rows;
  EXPECT_EQ(orderOf(boxes, testing::backwards).rows, rows);
}

// Centres that share one coordinate or both, and centres whose range is not finite.
TEST(TileOrder, OddPlaces) {
  constexpr double kHuge = 1.7e308;
  for (const auto& [width, height] : {std::pair{0.0, 1.0}, {1.0, 0.0}, {0.0, 0.0}, {kHuge, kHuge}}) {
    std::vector<IndexBox> boxes = randomBoxes(70000, {-width / 2, -height / 2}, width, height);
    if (width == kHuge) boxes[5] = {{-kHuge, -kHuge}, {kHuge, kHuge}};
    EXPECT_TRUE(isPermutation(orderOf(boxes).rows)) << width << ' ' << height;
  }
}

}  // namespace
}  // namespace coastmesh
