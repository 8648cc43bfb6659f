#include "gis/coast/join_gaps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gis/crs/crs.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using Lines = std::vector<std::vector<Point>>;

constexpr SnapDistance kTenth{0.1, true};

TEST(JoinAcrossGaps, ClosesARingInPieces) {
  const Lines lines{{{0, 0}, {4, 0}}, {{4.05, 0}, {4, 4}, {0, 4}}, {{0.02, 0.02}, {0, 4.03}}};
  std::vector<ClosedGap> gaps;
  const JoinedLines joined = joinAcrossGaps(lines, kTenth, {}, gaps);
  ASSERT_THAT(joined.rings, SizeIs(1));
  EXPECT_THAT(joined.open, IsEmpty());
  EXPECT_THAT(joined.rings[0].points,
              ::testing::UnorderedElementsAre(Point{0, 0}, Point{4, 0}, Point{4, 4}, Point{0, 4}));
  EXPECT_EQ(joined.rings[0].origin, 0u);
  EXPECT_THAT(gaps, SizeIs(3));
}

TEST(JoinAcrossGaps, ClosesASingleLine) {
  std::vector<ClosedGap> gaps;
  const JoinedLines joined = joinAcrossGaps({{{0, 0}, {4, 0}, {4, 4}, {0.05, 0}}}, kTenth, {}, gaps);
  ASSERT_THAT(joined.rings, SizeIs(1));
  EXPECT_THAT(joined.rings[0].points, SizeIs(3));
  EXPECT_EQ(gaps[0].to, (Point{0, 0}));
}

TEST(JoinAcrossGaps, NearestEndsFirstAndEachOnce) {
  const Lines lines{{{0, 0}, {1, 0}}, {{1.08, 0}, {2, 0}}, {{1.02, 0}, {1, 5}}};
  std::vector<ClosedGap> gaps;
  const JoinedLines joined = joinAcrossGaps(lines, kTenth, {}, gaps);
  EXPECT_THAT(joined.rings, IsEmpty());
  ASSERT_THAT(joined.open, SizeIs(2));
  EXPECT_THAT(joined.open[0].points, ElementsAre(Point{0, 0}, Point{1, 0}, Point{1, 5}));
  EXPECT_THAT(gaps, SizeIs(1));
}

TEST(JoinAcrossGaps, LeavesWiderGapsMetEndsAndShortLinesAlone) {
  std::vector<ClosedGap> gaps;
  // A wharf at a ring, whose free end is near nothing but the ring's side; a gap of 0.2; a line shorter than the reach.
  const Lines lines{{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}},
                    {{0, 0}, {2, 0.05}},
                    {{9, 9}, {9.05, 9}},
                    {{6, 0}, {7, 0}},
                    {{7.2, 0}, {8, 0}}};
  const JoinedLines joined = joinAcrossGaps(lines, kTenth, {}, gaps);
  EXPECT_THAT(joined.rings, SizeIs(1));
  EXPECT_THAT(joined.open, SizeIs(4));
  EXPECT_THAT(gaps, IsEmpty());
}

TEST(JoinAcrossGaps, MeasuresOnTheGround) {
  const Lines lines{{{10, 60}, {11, 60}, {11, 61}}, {{11.0003, 61}, {10, 61}, {10, 60}}};  // 16 m
  std::vector<ClosedGap> gaps;
  EXPECT_THAT(joinAcrossGaps(lines, {10.0, false}, parseCrs("EPSG:4326"), gaps).rings, IsEmpty());
  EXPECT_THAT(joinAcrossGaps(lines, {20.0, false}, parseCrs("EPSG:4326"), gaps).rings, SizeIs(1));
}

}  // namespace
}  // namespace coastmesh
