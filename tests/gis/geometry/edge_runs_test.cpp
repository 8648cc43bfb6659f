#include "gis/geometry/edge_runs.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <utility>

namespace coastmesh {
namespace {

using Pairs = std::multiset<std::pair<std::uint32_t, std::uint32_t>>;

// Random walks of edges, some of which jump.
std::vector<Box> walk(std::mt19937_64& random, std::size_t count, double jumps) {
  std::uniform_real_distribution<double> step(-1, 1), chance(0, 1), anywhere(0, 20);
  std::vector<Box> boxes;
  Point at{10, 10};
  for (std::size_t i = 0; i < count; ++i) {
    if (chance(random) < jumps) at.x = anywhere(random), at.y = anywhere(random);
    const double dx = step(random), dy = step(random);
    const Point next{at.x + dx, at.y + dy};
    boxes.push_back(Box::of(at, next));
    at = next;
  }
  return boxes;
}

TEST(EdgeRuns, FindEveryPairOnce) {
  std::mt19937_64 random(11);
  for (const std::size_t count : {0u, 1u, 2u, 9u, 17u, 300u}) {
    for (const double jumps : {0.0, 0.1, 1.0}) {
      for (const double margin : {0.0, 0.7}) {
        const std::vector<Box> boxes = walk(random, count, jumps);
        const auto box_of = [&](std::size_t e) { return boxes[e]; };
        const EdgeRuns runs(count, box_of);
        for (const unsigned every : {1u, 5u}) {
          const auto active = [&](std::uint32_t e) { return e % every == 0; };
          Pairs found, expected;
          const std::size_t half = runs.blockCount() / 2;
          for (const auto& [first, last] : {std::pair(std::size_t{0}, half), std::pair(half, runs.blockCount())}) {
            runs.visitPairs(first, last, margin, box_of, active,
                            [&](std::uint32_t e, std::uint32_t f) { found.emplace(e, f); });
          }
          for (std::uint32_t e = 0; e < count; ++e) {
            for (std::uint32_t f = e + 1; f < count; ++f) {
              if ((active(e) || active(f)) && boxes[e].grownBy(margin).meets(boxes[f])) expected.emplace(e, f);
            }
          }
          EXPECT_EQ(found, expected);
        }
        const Box window{5, 5, 9, 12};
        std::multiset<std::uint32_t> seen, inside;
        runs.visit(window, box_of, [&](std::uint32_t e) { seen.insert(e); });
        for (std::uint32_t e = 0; e < count; ++e) {
          if (boxes[e].meets(window)) inside.insert(e);
        }
        EXPECT_EQ(seen, inside);
      }
    }
  }
}

}  // namespace
}  // namespace coastmesh
