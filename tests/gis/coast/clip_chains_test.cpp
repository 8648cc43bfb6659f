#include "gis/coast/clip_chains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "gis/coast/turned_rings.hpp"
#include "gis/geometry/chain_index.hpp"

namespace coastmesh {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool holds(const std::vector<Ring>& rings, const Point& p) {
  ChainIndex index(ChainIndex::Kind::Rings);
  for (const Ring& ring : rings) {
    for (const Ring& turned : turnedRings(ring)) index.add(turned);
  }
  index.build();
  return index.edgeCount() > 0 && index.locate(p) == Location::Inside;
}

// Wraps longitudes to ±180, so that they jump.
Ring wrapped(Ring ring) {
  for (Point& p : ring) p.x -= 360 * std::floor((p.x + 180) / 360);
  return ring;
}

// A star around a point near the antimeridian.
Ring star(double lon, double lat, double radius, int corners, std::mt19937& random) {
  std::uniform_real_distribution<double> reach(0.3, 1);
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * M_PI * k / corners, r = radius * reach(random);
    ring.push_back({lon + r * std::cos(angle), lat + r * std::sin(angle)});
  }
  return ring;
}

// A point in the box is land after clipping iff it was before, on either side of the antimeridian.
TEST(ClipChains, TurnedRingsHoldTheSamePlaces) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  int inside = 0;
  for (int run = 0; run < 200; ++run) {
    const double lon = 140 + 80 * unit(random), lat = -40 + 80 * unit(random);
    const Ring ring = wrapped(star(lon, lat, 10 + 25 * unit(random), 24, random));
    if (!longitudesJump(ring)) continue;
    ClipBox clip;
    clip.box = {lon - 20 * unit(random), lat - 20 * unit(random), lon + 20 * unit(random), lat + 20 * unit(random)};
    if (run % 3 == 0) clip.box.xmin = -kInfinity, clip.box.xmax = kInfinity;
    if (run % 2 == 0) clip.piece_x = 360.0 / 256, clip.piece_y = 360.0 / 512;
    const std::vector<Ring> parts = clipTurnedRing(ring, clip, -180);
    for (int k = 0; k < 50; ++k) {
      const double west = std::isfinite(clip.box.xmin) ? clip.box.xmin : 100;
      const double east = std::isfinite(clip.box.xmax) ? clip.box.xmax : 260;
      Point p{west + (east - west) * unit(random), clip.box.ymin + (clip.box.ymax - clip.box.ymin) * unit(random)};
      p.x -= 360 * std::floor((p.x + 180) / 360);
      EXPECT_EQ(holds(parts, p), holds({ring}, p)) << run << ": " << p.x << ' ' << p.y;
      inside += holds({ring}, p);
    }
    for (const Ring& part : parts) {
      for (const Point& p : part) {
        EXPECT_TRUE(p.x >= -180 && p.x <= 180);
        EXPECT_TRUE(p.y >= clip.box.ymin && p.y <= clip.box.ymax);
      }
    }
  }
  EXPECT_GT(inside, 1000);
}

TEST(ClipChains, ARingRoundAPoleIsCutOffOrKeptWhole) {
  Ring ring;
  for (int lon = -175; lon <= 175; lon += 10) ring.push_back({static_cast<double>(lon), -70 + 0.01 * lon});
  ClipBox clip;
  clip.box = {100, -95, 200, -60};
  EXPECT_EQ(clipTurnedRing(ring, clip, -180), std::vector<Ring>{ring});
  clip.box = {100, -80, 200, -60};
  const std::vector<Ring> parts = clipTurnedRing(ring, clip, -180);
  for (const double lon : {101.0, 179.5, -179.5, -161.0}) {
    EXPECT_TRUE(holds(parts, {lon, -79})) << lon;
    EXPECT_FALSE(holds(parts, {lon, -61})) << lon;
  }
  clip.box = {100, -60, 200, -50};
  EXPECT_TRUE(clipTurnedRing(ring, clip, -180).empty());
}

TEST(ClipChains, PiecesAlongTheSides) {
  ClipBox clip;
  clip.box = {0, 0, 10, 10};
  clip.piece_x = 4;
  clip.piece_y = 2.5;
  const Ring clipped = clipRing({{1, 1}, {20, 1}, {20, 20}, {1, 20}}, clip);
  const Ring expected{{1, 10}, {1, 1}, {10, 1}, {10, 2.5}, {10, 5}, {10, 7.5}, {10, 10}, {8, 10}, {4, 10}};
  ASSERT_EQ(clipped.size(), expected.size());
  for (const Point& p : expected) EXPECT_NE(std::ranges::find(clipped, p), clipped.end()) << p.x << ' ' << p.y;
}

TEST(ClipChains, ALineAcrossTheAntimeridian) {
  const std::vector<Point> line{{170, 0}, {179, 1}, {-179, 3}, {-170, 4}};
  ClipBox clip;
  clip.box = {175, -10, 185, 10};
  const auto parts = clipTurnedLine(line, clip, -180);
  ASSERT_EQ(parts.size(), 1u);
  ASSERT_EQ(parts[0].size(), 4u);
  EXPECT_EQ(parts[0][0].x, 175);
  EXPECT_EQ(parts[0][1], line[1]);
  EXPECT_EQ(parts[0][2], line[2]);
  EXPECT_EQ(parts[0][3].x, -175);
  EXPECT_NEAR(parts[0][3].y, 3 + 4.0 / 9, 1e-12);
  clip.box = {-20, -10, 20, 10};
  EXPECT_TRUE(clipTurnedLine(line, clip, -180).empty());
}

}  // namespace
}  // namespace coastmesh
