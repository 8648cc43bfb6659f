#include "gis/merge/tidy_gap.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace coastmesh {
namespace {

using ::testing::ElementsAre;

using Corners = std::vector<std::array<VertexId, 3>>;

struct Whole {
  TriMesh mesh;
  Gap gap;
};

Whole wholeOf(const BulkList<Point>& points, const Corners& other, const Corners& inserted, const Corners& gap) {
  Corners all = other;
  all.insert(all.end(), inserted.begin(), inserted.end());
  Whole whole;
  whole.gap.first_inserted = static_cast<TriId>(other.size());
  whole.gap.first_gap = static_cast<TriId>(all.size());
  all.insert(all.end(), gap.begin(), gap.end());
  std::vector<EdgeConflict> conflicts;
  whole.mesh = linkTriangles(points, all, conflicts);
  EXPECT_TRUE(conflicts.empty());
  return whole;
}

std::vector<std::uint8_t> tidied(const Whole& whole, std::size_t& left_out) {
  std::vector<std::uint8_t> taken(whole.mesh.triangles.size(), 1);
  left_out = tidyGap(whole.mesh, whole.gap, taken);
  return taken;
}

// Below, the inserted mesh from 0 to 1; above, the other one from 2 to 3; the gap between.
const BulkList<Point> kColumn{{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}, {2.0, 1.0},
                              {0.0, 2.0}, {1.0, 2.0}, {2.0, 2.0}, {0.0, 3.0}, {1.0, 3.0}, {2.0, 3.0}};
Corners row(VertexId below, VertexId above) {
  return {{below, below + 1, above + 1},
          {below, above + 1, above},
          {below + 1, below + 2, above + 2},
          {below + 1, above + 2, above + 1}};
}

TEST(TidyGap, LeavesAGoodGapAsItIs) {
  const Whole whole = wholeOf(kColumn, row(6, 9), row(0, 3), row(3, 6));
  std::size_t left_out = 0;
  EXPECT_THAT(tidied(whole, left_out), ElementsAre(1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1));
  EXPECT_EQ(left_out, 0u);
}

TEST(TidyGap, TeethGo) {
  BulkList<Point> points = kColumn;
  points.push_back({3.0, 1.5});
  Corners gap = row(3, 6);
  gap.push_back({5, 12, 8});
  Whole whole = wholeOf(points, row(6, 9), row(0, 3), gap);
  std::size_t left_out = 0;
  EXPECT_EQ(tidied(whole, left_out).back(), 0);
  EXPECT_EQ(left_out, 1u);
  // Not where the shore was like that before.
  whole.gap.shore = {{5, 12}};
  EXPECT_EQ(tidied(whole, left_out).back(), 1);
}

TEST(TidyGap, LooseTrianglesGo) {
  // Connected to the inserted mesh through a node only.
  BulkList<Point> points = kColumn;
  points.push_back({3.0, 1.2});
  points.push_back({3.0, 1.8});
  const Whole whole = wholeOf(points, row(6, 9), row(0, 3), {{5, 12, 13}});
  std::size_t left_out = 0;
  EXPECT_EQ(tidied(whole, left_out).back(), 0);
  EXPECT_EQ(left_out, 1u);
}

TEST(TidyGap, TrianglesOfTheOtherMeshThatOnlyANodeConnectsGo) {
  const BulkList<Point> points{{0.0, 0.0}, {2.0, 0.0}, {1.0, 1.0}, {0.0, 2.0}, {2.0, 2.0}};
  Whole whole = wholeOf(points, {{2, 4, 3}}, {{0, 1, 2}}, {});
  std::size_t left_out = 0;
  EXPECT_THAT(tidied(whole, left_out), ElementsAre(1, 1));  // as it was
  whole.gap.changed = {2};
  EXPECT_THAT(tidied(whole, left_out), ElementsAre(0, 1));
}

TEST(TidyGap, SharpCornersGo) {
  // The water of the gap ends in a corner of 14° at the inserted mesh.
  const BulkList<Point> points{{0.0, 0.0}, {4.0, 0.0}, {2.0, -3.0}, {4.0, 1.0}, {8.0, 0.0}, {6.0, 4.0}};
  const Whole whole = wholeOf(points, {{4, 5, 3}}, {{0, 2, 1}}, {{0, 1, 3}, {1, 4, 3}});
  std::size_t left_out = 0;
  const std::vector<std::uint8_t> taken = tidied(whole, left_out);
  EXPECT_EQ(taken[2], 0);
}

TEST(TidyGap, FlatTrianglesBesideAShoreGo) {
  // Node 3, on the shore, is close to an edge of the inserted mesh.
  const BulkList<Point> points{{0.0, 0.0}, {4.0, 0.0}, {2.0, -3.0}, {2.0, 0.3}, {0.0, 3.0}, {4.0, 3.0}};
  const Whole whole = wholeOf(points, {}, {{0, 2, 1}}, {{0, 1, 3}, {1, 5, 3}, {0, 3, 4}});
  std::size_t left_out = 0;
  EXPECT_EQ(tidied(whole, left_out)[1], 0);
  EXPECT_GE(left_out, 1u);
}

TEST(TidyGap, WhatTheRestEnclosesStays) {
  // A corner of 14 degrees between two edges of the inserted mesh, with water of the other one in front of it.
  const BulkList<Point> points{{0.0, 0.0}, {4.0, 0.0}, {4.0, 1.0}, {2.0, -6.0}, {2.0, 7.0}, {12.0, 0.5}};
  std::size_t left_out = 0;
  const Whole enclosed = wholeOf(points, {{1, 5, 2}}, {{0, 3, 1}, {0, 2, 4}}, {{0, 1, 2}, {3, 5, 1}, {2, 5, 4}});
  EXPECT_EQ(tidied(enclosed, left_out)[3], 1);
  EXPECT_EQ(left_out, 0u);
  // Land in front of it.
  const Whole at_land = wholeOf(points, {}, {{0, 3, 1}, {0, 2, 4}}, {{0, 1, 2}});
  EXPECT_EQ(tidied(at_land, left_out)[2], 0);
  EXPECT_EQ(left_out, 1u);
}

}  // namespace
}  // namespace coastmesh
