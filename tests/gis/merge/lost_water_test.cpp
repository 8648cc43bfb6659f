#include "gis/merge/lost_water.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/gis/merge/merged.hpp"

namespace coastmesh {
namespace {

using namespace coastmesh::testing;

LostWater lostBetween(const Grid& before, const Grid& now) {
  std::vector<std::uint32_t> all(now.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return lostWater(before, now, all);
}

TEST(LostWater, IsWhatNoTriangleCovers) {
  const Grid before = gridOf({10, 10, 1.0});
  EXPECT_NEAR(lostBetween(before, before).area_m2, 0.0, 1e-9);
  // Turned squares have other triangles, and reach beyond.
  EXPECT_NEAR(lostBetween(before, gridOf({40, 40, 1.0, {5.0, -20.0}, 0.7})).area_m2, 0.0, 1e-9);
  const LostWater half = lostBetween(before, gridOf({7, 20, 0.5, {-0.25, 0.0}}));
  EXPECT_NEAR(half.area_m2, 10.0 * (10.0 - 3.25), 1e-9);
  EXPECT_NEAR(half.largest_m2, 0.5, 1e-9);
  EXPECT_GT(half.place.x, 3.25);
  EXPECT_NEAR(lostBetween(before, Grid{}).area_m2, 100.0, 1e-9);
  EXPECT_EQ(lostBetween(Grid{}, before).area_m2, 0.0);
}

}  // namespace
}  // namespace coastmesh
