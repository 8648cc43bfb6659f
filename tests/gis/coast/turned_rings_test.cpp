#include "gis/coast/turned_rings.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "gis/geometry/chain_index.hpp"

namespace coastmesh {
namespace {

Location locate(const Ring& ring, const Point& p) {
  ChainIndex index(ChainIndex::Kind::Rings);
  for (const Ring& turned : turnedRings(ring)) index.add(turned);
  index.build();
  return index.locate(p);
}

TEST(TurnedRings, AsTheyAreWhereNothingJumps) {
  const Ring ring{{-180, -90}, {180, -90}, {180, -70}, {0, -60}, {-180, -70}};
  EXPECT_FALSE(longitudesJump(ring));
  EXPECT_EQ(turnedRings(ring), std::vector<Ring>{ring});
}

TEST(TurnedRings, AcrossTheAntimeridian) {
  const Ring ring{{179, -18}, {-179, -18}, {-179, -16}, {179, -16}};
  EXPECT_TRUE(longitudesJump(ring));
  for (const double x : {-179.5, 179.5, 180.5}) EXPECT_EQ(locate(ring, {x, -17}), Location::Inside) << x;
  for (const double x : {-178.0, -90.0, 0.0, 178.0, 182.0}) EXPECT_EQ(locate(ring, {x, -17}), Location::Outside) << x;
}

TEST(TurnedRings, RoundAPole) {
  for (const double pole : {-90.0, 90.0}) {
    Ring ring;
    for (int lon = -170; lon <= 170; lon += 20) ring.push_back({static_cast<double>(lon), pole * 0.8});
    for (const bool reversed : {false, true}) {
      if (reversed) std::ranges::reverse(ring);
      for (const double x : {-179.0, -33.0, 0.0, 171.0, 179.0}) {
        EXPECT_EQ(locate(ring, {x, pole * 0.9}), Location::Inside) << x;
        EXPECT_EQ(locate(ring, {x, pole * 0.7}), Location::Outside) << x;
        EXPECT_EQ(locate(ring, {x, -pole * 0.9}), Location::Outside) << x;
      }
    }
  }
}

}  // namespace
}  // namespace coastmesh
