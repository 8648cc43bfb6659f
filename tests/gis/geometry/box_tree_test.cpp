#include "gis/geometry/box_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <string>

#include "core/hilbert.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

std::vector<Box> randomBoxes(std::mt19937_64& random, std::size_t n, double extent, double size) {
  std::uniform_real_distribution<double> place(-extent, extent), side(0, size);
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = place(random), y = place(random);
    boxes.push_back({x, y, x + side(random), y + side(random)});
  }
  return boxes;
}

std::string nameOf(const ::testing::TestParamInfo<BoxTree::Order>& order) {
  return order.param == BoxTree::Order::Hilbert ? "hilbert" : "given";
}

class BoxTreeTest : public ::testing::TestWithParam<BoxTree::Order> {};

TEST_P(BoxTreeTest, FindsWhatAScanFinds) {
  std::mt19937_64 random(1);
  for (const std::size_t n : {1, 2, 7, 8, 9, 64, 65, 513, 3000}) {
    const std::vector<Box> boxes = randomBoxes(random, n, 10, 1);
    const BoxTree tree(boxes, GetParam());
    EXPECT_EQ(tree.size(), n);
    for (const Box& query : randomBoxes(random, 50, 12, 4)) {
      std::vector<std::uint32_t> found, expected;
      tree.visit(query, [&](std::uint32_t item) { found.push_back(item); });
      for (std::uint32_t i = 0; i < n; ++i) {
        if (boxes[i].meets(query)) expected.push_back(i);
      }
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected);
    }
  }
}

// So many that threads share the work. One in ten boxes is empty.
TEST(BoxTreeOrder, IsTheSameHoweverWorkIsShared) {
  std::mt19937_64 random(3);
  std::vector<Box> boxes = randomBoxes(random, 70000, 10, 1);
  for (std::size_t i = 0; i < boxes.size(); i += 10) boxes[i] = Box();
  for (std::size_t i = 0; i < 20000; ++i) boxes[i] = Box();
  std::vector<Point> centres;
  for (const Box& box : boxes)
    if (!box.empty()) centres.push_back({box.xmin / 2 + box.xmax / 2, box.ymin / 2 + box.ymax / 2});
  std::vector<std::uint32_t> full, expected;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (!boxes[i].empty()) full.push_back(i);
  for (const std::uint32_t i : hilbertOrder(centres)) expected.push_back(full[i]);
  for (const ItemLoop& loop : {ItemLoop(inOrder), ItemLoop(testing::backwards)}) {
    const BoxTree tree(boxes, BoxTree::Order::Hilbert, loop);
    std::vector<std::uint32_t> order;
    for (std::size_t block = 0; block < tree.blockCount(); ++block)
      std::ranges::copy_if(tree.block(block), std::back_inserter(order),
                           [&](std::uint32_t item) { return !boxes[item].empty(); });
    EXPECT_EQ(order, expected);
    const Box query{-1, -1, 0, 0};
    std::size_t found = 0;
    tree.visit(query, [&](std::uint32_t) { ++found; });
    EXPECT_EQ(found,
              static_cast<std::size_t>(std::ranges::count_if(boxes, [&](const Box& box) { return box.meets(query); })));
  }
}

TEST_P(BoxTreeTest, FindsTheNewBoxesAfterARefit) {
  std::mt19937_64 random(3);
  const std::size_t n = 20000;  // enough for several stretches
  BoxTree tree(randomBoxes(random, n, 10, 1), GetParam(), testing::backwards);
  std::vector<Box> boxes = randomBoxes(random, n, 10, 1);
  for (std::size_t i = 0; i < n; i += 3) boxes[i] = Box();
  tree.refit(testing::backwards, [&](std::uint32_t item) { return boxes[item]; });
  for (const Box& query : randomBoxes(random, 20, 12, 4)) {
    std::vector<std::uint32_t> found, expected;
    tree.visit(query, [&](std::uint32_t item) { found.push_back(item); });
    for (std::uint32_t i = 0; i < n; ++i)
      if (boxes[i].meets(query)) expected.push_back(i);
    std::ranges::sort(found);
    EXPECT_EQ(found, expected);
  }
}

TEST_P(BoxTreeTest, HoldsPointsAndEqualBoxes) {
  const std::vector<Box> boxes(100, Box{1, 1, 1, 1});
  const BoxTree tree(boxes, GetParam());
  std::size_t found = 0;
  tree.visit({1, 1, 1, 1}, [&](std::uint32_t) { ++found; });
  EXPECT_EQ(found, 100u);
  tree.visit({1.5, 1, 2, 1}, [&](std::uint32_t) { FAIL(); });
}

// Empty boxes have no centre: they must not disturb the order of the others.
TEST(BoxTreeOrder, EmptyBoxesLeaveTheOthersInOrder) {
  std::mt19937_64 random(2);
  const std::vector<Box> boxes = randomBoxes(random, 3000, 10, 1);
  std::vector<Box> with_empty{Box()};
  for (const Box& box : boxes) {
    with_empty.push_back(box);
    with_empty.push_back(Box());
  }
  const BoxTree tree(boxes, BoxTree::Order::Hilbert), gappy(with_empty, BoxTree::Order::Hilbert);
  for (const Box& query : randomBoxes(random, 50, 12, 4)) {
    std::vector<std::uint32_t> found, expected;
    tree.visit(query, [&](std::uint32_t item) { expected.push_back(item); });
    gappy.visit(query, [&](std::uint32_t item) { found.push_back((item - 1) / 2); });
    EXPECT_EQ(found, expected);
  }
}

TEST_P(BoxTreeTest, AnEmptyTreeFindsNothing) {
  const BoxTree tree({}, GetParam());
  EXPECT_EQ(tree.size(), 0u);
  EXPECT_TRUE(tree.bounds().empty());
  tree.visit({-1, -1, 1, 1}, [&](std::uint32_t) { FAIL(); });
}

TEST(BoxTreeOrder, NodesOfTheOrderGivenTellTheirItems) {
  std::mt19937_64 random(2);
  const std::vector<Box> boxes = randomBoxes(random, 100, 10, 1);
  const BoxTree tree(boxes, BoxTree::Order::Given);
  tree.descend(
      [&](const Box& box, std::size_t first, std::size_t last) {
        EXPECT_LT(first, last);
        for (std::size_t i = first; i < last; ++i) EXPECT_TRUE(box.contains(boxes[i]));
        return true;
      },
      [](std::uint32_t) {});
}

INSTANTIATE_TEST_SUITE_P(Orders, BoxTreeTest, ::testing::Values(BoxTree::Order::Given, BoxTree::Order::Hilbert),
                         nameOf);

}  // namespace
}  // namespace coastmesh
