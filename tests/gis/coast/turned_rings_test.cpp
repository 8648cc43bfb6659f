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

// Calls `check(ring)` for the ring from every starting point, in both directions.
template <typename Check>
void forAllStarts(Ring ring, const Check& check) {
  for (std::size_t first = 0; first < ring.size(); ++first) {
    std::ranges::rotate(ring, ring.begin() + 1);
    for (int way = 0; way < 2; ++way) {
      std::ranges::reverse(ring);
      check(ring);
    }
  }
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

// Islands whose rings cross the antimeridian only by edges from end to end, as in Natural Earth.
TEST(TurnedRings, EdgesFromEndToEndAloneCrossTheAntimeridianToo) {
  const std::vector<Ring> islands{
      {{-180, -16.5}, {180, -16.5}, {179.9, -16.6}, {179.9, -16.4}, {180, -16.45}},
      {{-180, -16.5}, {180, -16.5}, {179.9, -16.48}, {180, -16.45}, {-180, -16.45}, {-179.9, -16.48}},
      {{-180, -16.5},
       {180, -16.5},
       {180, -16.55},
       {179.9, -16.6},
       {179.9, -16.4},
       {180, -16.45},
       {-180, -16.45},
       {-179.9, -16.4}}};
  for (const Ring& island : islands) {
    forAllStarts(island, [](const Ring& ring) {
      EXPECT_TRUE(longitudesJump(ring));
      EXPECT_EQ(locate(ring, {179.95, -16.48}), Location::Inside);
      EXPECT_EQ(locate(ring, {0, -16.48}), Location::Outside);
      EXPECT_EQ(locate(ring, {-179.8, -16.48}), Location::Outside);
    });
  }
}

// The sea of a map, without land that crosses the antimeridian.
TEST(TurnedRings, BandsRoundTheGlobeStayAsTheyAre) {
  for (const Ring& ring : {Ring{{-180, -60}, {180, -60}, {180, 80}, {-180, 80}}, Ring{{-180, -60},
                                                                                      {180, -60},
                                                                                      {180, 65},
                                                                                      {175, 68},
                                                                                      {180, 70},
                                                                                      {180, 80},
                                                                                      {-180, 80},
                                                                                      {-180, 70},
                                                                                      {-172, 67},
                                                                                      {-180, 65}}}) {
    EXPECT_FALSE(longitudesJump(ring));
    EXPECT_EQ(turnedRings(ring), std::vector<Ring>{ring});
  }
}

// A small island on the antimeridian with an edge from one end of the map to the other, from every starting point, in
// both directions, with the meridian as 180 or -180: it never becomes a band around the Earth.
TEST(TurnedRings, AnEdgeFromEndToEndBesideAJumpHasNoLength) {
  const std::vector<Ring> islands{
      {{-180, -16.49}, {180, -16.54}, {179.985, -16.542}, {179.985, -16.523}},
      {{180, -16.49}, {-180, -16.54}, {-179.985, -16.542}, {-179.985, -16.523}},
      {{180, -16.49}, {-180, -16.54}, {179.985, -16.542}, {179.985, -16.523}},
      {{-179.9, -16.49}, {-180, -16.50}, {180, -16.54}, {179.985, -16.542}, {179.985, -16.45}},
      {{-180, -16.4}, {180, -16.45}, {-180, -16.5}, {180, -16.54}, {179.985, -16.542}, {179.985, -16.39}}};
  for (const Ring& island : islands) {
    forAllStarts(island, [](const Ring& ring) {
      EXPECT_TRUE(longitudesJump(ring));
      EXPECT_EQ(turnsOf(ring, true).round, 0);
      for (const double x : {-179.0, -90.0, 0.0, 100.0, 179.0}) {
        EXPECT_EQ(locate(ring, {x, -16.52}), Location::Outside) << x;
      }
    });
  }
  EXPECT_EQ(locate(islands[0], {179.99, -16.53}), Location::Inside);
  EXPECT_EQ(locate(islands[1], {-179.99, -16.53}), Location::Inside);
}

TEST(TurnedRings, AnEdgeFromEndToEndIsOneOfTheMapWhereNothingElseJumps) {
  const Ring band{{-180, -60}, {180, -60}, {180, -85}, {-180, -85}};
  EXPECT_FALSE(longitudesJump(band));
  EXPECT_EQ(turnedRings(band), std::vector<Ring>{band});
}

// If the jumps alone close the ring, an edge from end to end does not count as a jump.
TEST(TurnedRings, AnEdgeFromEndToEndDoesNotKeepARingFromClosing) {
  const Ring ring{{170, 0}, {-170, 0}, {-170, 5}, {-180, 5}, {180, 9}, {-180, 10}, {170, 10}};
  EXPECT_EQ(turnsOf(ring, true).round, 0);
  const Ring odd{{170, 0}, {-170, 0}, {-170, 10}, {170, 10}, {-180, 5}, {180, 5}};
  EXPECT_EQ(turnsOf(odd, true).round, 0);
}

TEST(TurnedRings, RoundAPoleWithAPointOnTheMeridianTwice) {
  for (const double sign : {-1.0, 1.0}) {
    Ring ring{{180, sign * 80}};
    for (int lon = 160; lon >= -160; lon -= 20) ring.push_back({static_cast<double>(lon), sign * 75});
    ring.push_back({-180, sign * 80});  // an edge from end to end closes the ring
    EXPECT_FALSE(longitudesJump(ring));
    ring.back() = {-179, sign * 79};
    EXPECT_EQ(turnsOf(ring, true).round, -1);
    EXPECT_EQ(poleWithin(ring), sign * 90);
    for (const double x : {-179.5, 0.0, 170.0}) EXPECT_EQ(locate(ring, {x, sign * 85}), Location::Inside) << x;
    for (const double x : {-179.5, 0.0, 170.0}) EXPECT_EQ(locate(ring, {x, sign * 70}), Location::Outside) << x;
  }
}

TEST(TurnedRings, LinesDoNotClose) {
  const std::vector<Point> line{{170, 0}, {-170, 1}, {-160, 2}};
  const Turns turns = turnsOf(line, false);
  EXPECT_TRUE(turns.any);
  EXPECT_EQ(turns.of, (std::vector<int>{0, 1, 1}));
  EXPECT_EQ(turns.round, 0);
  EXPECT_FALSE(turnsOf({{170, 0}, {-10, 0}, {-170, 0}}, false).any);
}

}  // namespace
}  // namespace coastmesh
