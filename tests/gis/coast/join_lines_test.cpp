#include "gis/coast/join_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "gis/coast/nest_rings.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

using Lines = std::vector<std::vector<Point>>;

// Rings as sorted point sets: their start and direction do not matter.
std::vector<std::vector<Point>> pointSets(const std::vector<JoinedLines::Part>& parts) {
  std::vector<std::vector<Point>> sets;
  for (const auto& part : parts) {
    sets.push_back(part.points);
    std::sort(sets.back().begin(), sets.back().end(), lexLess);
  }
  return sets;
}

TEST(JoinLines, AClosedLineIsARing) {
  const JoinedLines joined = joinLines({{{0, 0}, {1, 0}, {1, 1}, {0, 0}}});
  ASSERT_EQ(joined.rings.size(), 1u);
  EXPECT_TRUE(joined.open.empty());
  EXPECT_EQ(joined.rings[0].points.size(), 3u);
}

TEST(JoinLines, JoinsAnyWayRoundAndTellsTheFirstLine) {
  const JoinedLines joined =
      joinLines({{{9, 9}, {8, 8}}, {{0, 1}, {1, 1}}, {{0, 0}, {1, 0}}, {{1, 1}, {1, 0}}, {{0, 0}, {0, 1}}});
  ASSERT_EQ(joined.rings.size(), 1u);
  EXPECT_EQ(joined.rings[0].points.size(), 4u);
  EXPECT_EQ(joined.rings[0].origin, 1u);
  ASSERT_EQ(joined.open.size(), 1u);
  EXPECT_EQ(joined.open[0].origin, 0u);
}

TEST(JoinLines, WhatDoesNotCloseStaysOneOpenLine) {
  const JoinedLines joined = joinLines({{{1, 0}, {2, 0}}, {{0, 0}, {1, 0}}, {{3, 0}, {2, 0}}});
  EXPECT_TRUE(joined.rings.empty());
  ASSERT_EQ(joined.open.size(), 1u);
  EXPECT_EQ(joined.open[0].points.size(), 4u);
}

TEST(JoinLines, EndsThatAreNearlyEqualDoNotJoin) {
  const JoinedLines joined = joinLines({{{0, 0}, {1, 0}}, {{1 + 1e-15, 0}, {2, 0}}});
  EXPECT_EQ(joined.open.size(), 2u);
}

TEST(JoinLines, AWharfStaysOpen) {
  const JoinedLines joined = joinLines({{{0, 0}, {4, 0}}, {{4, 0}, {4, 4}, {0, 4}, {0, 0}}, {{4, 0}, {3, 1}}});
  ASSERT_EQ(joined.rings.size(), 1u);
  EXPECT_EQ(joined.rings[0].points.size(), 4u);
  ASSERT_EQ(joined.open.size(), 1u);
  EXPECT_EQ(joined.open[0].origin, 2u);
}

TEST(JoinLines, ADamFromShoreToShoreStaysOpen) {
  const JoinedLines joined =
      joinLines({{{2, 0}, {2, 1}, {2, 4}}, {{2, 0}, {4, 0}, {4, 4}, {2, 4}}, {{2, 4}, {0, 4}, {0, 0}, {2, 0}}});
  ASSERT_EQ(joined.rings.size(), 1u);
  EXPECT_EQ(joined.rings[0].points.size(), 6u);
  ASSERT_EQ(joined.open.size(), 1u);
  EXPECT_EQ(joined.open[0].points.size(), 3u);
}

TEST(JoinLines, AnIslandThatTouchesTheShoreIsARingOfItsOwn) {
  const std::vector<Point> shore{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}}, island{{0, 0}, {2, 1}, {1, 2}, {0, 0}};
  for (const Lines& lines : {Lines{shore, island}, Lines{island, shore}}) {
    const JoinedLines joined = joinLines(lines);
    ASSERT_EQ(joined.rings.size(), 2u);
    EXPECT_EQ(joined.rings[0].points.size() + joined.rings[1].points.size(), 7u);
    EXPECT_TRUE(joined.open.empty());
  }
}

TEST(JoinLines, ABridgeBetweenTwoRingsStaysOpen) {
  const JoinedLines joined = joinLines(
      {{{1, 1}, {0, 0}, {1, -1}, {1, 1}}, {{1, 1}, {3, 1}}, {{3, 1}, {5, 0}, {5, 2}, {3, 1}}, {{1, 1}, {1, 5}}});
  EXPECT_EQ(joined.rings.size(), 2u);
  EXPECT_EQ(joined.open.size(), 2u);
}

TEST(JoinLines, LinesWithoutLengthAreLeftOut) {
  const JoinedLines joined = joinLines({{}, {{1, 1}}, {{2, 2}, {2, 2}}, {{0, 0}, {1, 0}}});
  EXPECT_TRUE(joined.rings.empty());
  EXPECT_EQ(joined.open.size(), 1u);
}

TEST(JoinLines, PiecesOfManyRingsInAnyOrder) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937_64 random(seed);
    std::vector<Ring> rings;
    Lines pieces;
    for (int r = 0; r < 12; ++r) {
      rings.push_back(starRing(random, {10.0 * r, 0}, 4, 30));
      Ring closed = rings.back();
      closed.push_back(closed.front());
      for (std::size_t i = 0; i + 1 < closed.size();) {
        const std::size_t length = std::min<std::size_t>(closed.size() - 1 - i, 1 + random() % 9);
        std::vector<Point> piece(closed.begin() + static_cast<std::ptrdiff_t>(i),
                                 closed.begin() + static_cast<std::ptrdiff_t>(i + length + 1));
        if (random() % 2) std::reverse(piece.begin(), piece.end());
        pieces.push_back(std::move(piece));
        i += length;
      }
    }
    std::shuffle(pieces.begin(), pieces.end(), random);
    const JoinedLines joined = joinLines(pieces);
    EXPECT_TRUE(joined.open.empty());
    auto sets = pointSets(joined.rings);
    for (Ring& ring : rings) std::sort(ring.begin(), ring.end(), lexLess);
    const auto byFirst = [](const Ring& a, const Ring& b) { return lexLess(a.front(), b.front()); };
    std::sort(sets.begin(), sets.end(), byFirst);
    std::sort(rings.begin(), rings.end(), byFirst);
    EXPECT_EQ(sets, rings) << "seed " << seed;
  }
}

TEST(JoinLines, ANetOfStreetsComesApartWhole) {
  // Every edge of a grid is a line of its own: each must appear exactly once, in a ring or an open line.
  Lines lines;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const Point p{static_cast<double>(i), static_cast<double>(j)};
      if (i < 5) lines.push_back({p, {p.x + 1, p.y}});
      if (j < 5) lines.push_back({p, {p.x, p.y + 1}});
    }
  }
  const JoinedLines joined = joinLines(lines);
  std::size_t edges = 0;
  for (const auto& ring : joined.rings) edges += ring.points.size();
  for (const auto& line : joined.open) edges += line.points.size() - 1;
  EXPECT_EQ(edges, lines.size());
  EXPECT_EQ(joined.rings[0].points.size(), 20u);
}

TEST(NestRings, HolesIslandsAndLakesOnIslands) {
  const std::vector<NestedRing> nested = nestRings(
      {square(2, 2, 4), square(0, 0, 10), square(3, 3, 1), square(20, 0, 5), square(21, 1, 1), square(6.5, 6.5, 2)},
      false);
  ASSERT_EQ(nested.size(), 3u);
  EXPECT_EQ(nested[0].outer, 1u);
  EXPECT_EQ(nested[0].holes, (std::vector<std::size_t>{0, 5}));
  EXPECT_EQ(nested[1].outer, 2u);
  EXPECT_TRUE(nested[1].holes.empty());
  EXPECT_EQ(nested[2].outer, 3u);
  EXPECT_EQ(nested[2].holes, (std::vector<std::size_t>{4}));
}

TEST(NestRings, RingsThatTouchOrCoincide) {
  const std::vector<NestedRing> touching = nestRings({square(0, 0, 10), square(0, 0, 3), square(7, 7, 3)}, false);
  ASSERT_EQ(touching.size(), 1u);
  EXPECT_EQ(touching[0].holes.size(), 2u);
  EXPECT_EQ(nestRings({square(0, 0, 1), square(0, 0, 1)}, false).size(), 2u);
  EXPECT_TRUE(nestRings({}, false).empty());
}

// A ring across the antimeridian holds what lies there on either side, and nothing else of the same latitudes.
TEST(NestRings, AcrossTheAntimeridian) {
  const Ring sea{{179, -18}, {-179, -18}, {-179, -16}, {179, -16}};
  const Ring island{{179.8, -17.5}, {-179.8, -17.5}, {-179.8, -16.5}, {179.8, -16.5}};
  const Ring lake{{179.9, -17.2}, {-179.9, -17.2}, {-179.9, -16.8}, {179.9, -16.8}};
  const std::vector<Ring> rings{
      square(10, -17.5, 0.3), square(-179.5, -17, 0.2), lake, square(179.2, -17, 0.2), sea, island};
  for (const bool framed : {false, true}) {  // within a ring of the whole map
    std::vector<Ring> all = rings;
    if (framed) all.push_back({{-180, -90}, {180, -90}, {180, 90}, {-180, 90}});
    const std::vector<NestedRing> nested = nestRings(all, true);
    ASSERT_EQ(nested.size(), framed ? 4u : 3u);
    if (framed) {
      EXPECT_EQ(nested[0].outer, 1u);
      EXPECT_EQ(nested[3].outer, 6u);
      EXPECT_EQ(nested[3].holes, (std::vector<std::size_t>{0, 4}));
      continue;
    }
    EXPECT_EQ(nested[0].outer, 0u);
    EXPECT_TRUE(nested[0].holes.empty());
    EXPECT_EQ(nested[1].outer, 2u);
    EXPECT_EQ(nested[2].outer, 4u);
    EXPECT_EQ(nested[2].holes, (std::vector<std::size_t>{1, 3, 5}));
  }
}

TEST(NestRings, EveryRingComesOutOnceWhateverCrosses) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937_64 random(seed);
    std::vector<Ring> rings;
    for (int r = 0; r < 30; ++r) rings.push_back(tangledRing(random, 5));
    std::vector<int> seen(rings.size(), 0);
    for (const NestedRing& nested : nestRings(rings, false)) {
      ++seen[nested.outer];
      for (const std::size_t hole : nested.holes) ++seen[hole];
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 30);
  }
}

// Files concatenated twice: the same closed line, and the same halves of one.
TEST(JoinLines, LinesGivenTwice) {
  const std::vector<Point> ring{{0, 0}, {2, 0}, {1, 2}, {0, 0}};
  EXPECT_EQ(joinLines({ring, ring}).rings.size(), 2u);
  const std::vector<Point> there{{0, 0}, {2, 0}, {2, 2}}, back{{2, 2}, {0, 2}, {0, 0}};
  const JoinedLines joined = joinLines({there, back, there, back});
  EXPECT_GE(joined.rings.size(), 1u);
  for (const auto& part : joined.rings) EXPECT_GE(part.points.size(), 4u);
}

}  // namespace
}  // namespace coastmesh
