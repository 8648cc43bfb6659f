#include "gis/size/domain_mask.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/metric.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

// A ring of water, with an island in the middle.
Pslg ringOfWater(int points) {
  Pslg pslg;
  for (const double radius : {1.0, 0.5}) {
    const auto first = static_cast<VertexId>(pslg.points.size());
    const auto count = static_cast<VertexId>(points);
    for (VertexId i = 0; i < count; ++i) {
      const double angle = 6.283185307179586 * i / points;
      pslg.points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
      Segment s{first + i, first + (i + 1) % count, 0, 0, kOutside};
      if (radius < 1.0) std::swap(s.left, s.right);
      pslg.segments.push_back(s);
    }
  }
  return pslg;
}

TEST(DomainMask, NothingOfTheDomainIsMissed) {
  const DomainMask mask(ringOfWater(500), {{0.1, -0.05}, 1.3});
  std::mt19937_64 random(3);
  std::size_t beyond = 0, dropped = 0;
  for (int i = 0; i < 100000; ++i) {
    const SizeBox box{{uniform(random, -1.1, 1.2), uniform(random, -1.2, 1.1)},
                      std::exp(uniform(random, std::log(1e-4), std::log(0.3)))};
    // Compares with the circle around the box and the circle inside it.
    const double r = std::sqrt(squaredLength(box.centre)), reach = std::sqrt(2.0) * box.half;
    if (r - box.half < 0.999 && r + box.half > 0.501) {
      EXPECT_TRUE(mask.meets(box)) << box.centre.x << ", " << box.centre.y << ": " << box.half;
    }
    if (r - reach > 1.05 || r + reach < 0.45) {
      ++beyond;
      dropped += !mask.meets(box);
    }
  }
  ASSERT_GT(beyond, 1000u);
  EXPECT_GT(dropped, 9 * beyond / 10);
}

TEST(DomainMask, ACellOfItsGridMeetsNoNeighbours) {
  // The square's lower left quarter, with a margin to its other quarters.
  Pslg pslg = squarePslg();
  for (Segment& s : pslg.segments) s.left = 0, s.right = kOutside;
  const DomainMask mask(pslg, {{0.5 + 0.7, 0.5 + 0.7}, 1.3});
  EXPECT_TRUE(mask.meets({{0.55, 0.55}, 0.65}));
  EXPECT_FALSE(mask.meets({{1.85, 0.55}, 0.65}));
  EXPECT_FALSE(mask.meets({{0.55, 1.85}, 0.65}));
  EXPECT_FALSE(mask.meets({{1.85, 1.85}, 0.65}));
}

TEST(DomainMask, WithoutLabelsAllIsInside) {
  const DomainMask mask(squarePslg(), {{0.5, 0.5}, 10.0});
  EXPECT_TRUE(mask.meets({{9.0, 9.0}, 0.1}));
}

}  // namespace
}  // namespace coastmesh
