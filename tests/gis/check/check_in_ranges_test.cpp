// Checks of a grid with many triangles go through it range by range, on several threads: what they find, and its order,
// must not depend on the order of the ranges.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "gis/model/apart_waters.hpp"
#include "tests/gis/check/target_samples.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using testing::Kinds;
using ::testing::Not;

constexpr int kCells = 150;

// A sea with many holes, some of which touch in a node, and many waters apart. Some triangles are clockwise or there
// twice, some nodes have no depth, and a corner is covered a second time.
Grid brokenSea(const Crs& crs) {
  std::mt19937_64 random(20261126);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  const TriMesh mesh = testing::lattice(
      kCells, kCells, [](int i, int j) { return (7 * i + 13 * j) % 29 != 0 && j % 50 != 49; },
      [&](int i, int j) {
        return Point{5.0 + 0.01 * (i + shift(random)), 50.0 + 0.01 * (j + shift(random))};
      });
  Grid grid;
  grid.crs = crs;
  grid.nodes = mesh.points;
  grid.nodes[50] = grid.nodes[20'000];
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  for (std::size_t i = 0; i < grid.nodes.size(); ++i)
    grid.z.push_back(i % 1777 == 0 ? std::numeric_limits<double>::quiet_NaN() : i % 3 == 0 ? 1.0 : -10.0);
  grid.boundaries = findBoundaries(mesh);
  for (std::size_t b = 0; b < grid.boundaries.size(); b += 5) grid.boundaries[b].role = BoundaryRole::Open;
  grid.boundaries[3].nodes.pop_back();
  std::swap(grid.boundaries[7].nodes[0], grid.boundaries[7].nodes[1]);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 997) std::swap(grid.triangles[t][0], grid.triangles[t][1]);
  for (std::size_t t = 500; t < mesh.triangles.size(); t += 4999) grid.triangles.push_back(grid.triangles[t]);
  const auto first = static_cast<std::uint32_t>(grid.nodes.size());
  for (const Point& p : {Point{5.11, 50.11}, Point{5.14, 50.11}, Point{5.12, 50.14}}) {
    grid.nodes.push_back(p);
    grid.z.push_back(-5.0);
  }
  grid.triangles.push_back({first, first + 1, first + 2});
  return grid;
}

TEST(CheckInRanges, OrderOfRangesDoesNotMatter) {
  Kinds kinds;
  for (const Crs& crs : {Crs{}, wgs84()}) {
    const Grid grid = brokenSea(crs);
    ASSERT_GT(grid.triangles.size(), 4u * 8192);  // several ranges
    for (std::size_t i = 0; i < kTargetNames.size(); ++i) {
      const auto target = static_cast<Target>(i);
      const TargetCheckOptions options{.time_step_s = isOfLongWaves(target) ? 30.0 : 0.0};
      const std::vector<TargetDefect> found = checkTarget(grid, target, options);
      EXPECT_EQ(found, checkTarget(grid, target, options, testing::backwards)) << kTargetNames[i];
      for (const TargetDefect& defect : found) kinds.insert(defect.kind);
    }
    const std::vector<ApartWater> apart = apartWaters(grid);
    EXPECT_THAT(apart, Not(IsEmpty()));
    EXPECT_EQ(apart, apartWaters(grid, testing::backwards));
  }
  EXPECT_THAT(
      kinds,
      IsSupersetOf({TargetDefectKind::BrokenEdge, TargetDefectKind::Clockwise, TargetDefectKind::Overlap,
                    TargetDefectKind::RepeatedNode, TargetDefectKind::PinchedNode, TargetDefectKind::OrphanCell,
                    TargetDefectKind::UnknownDepth, TargetDefectKind::DryOpening, TargetDefectKind::NoBoundary,
                    TargetDefectKind::StrayBoundary, TargetDefectKind::OneNeighbour, TargetDefectKind::LargeAngle,
                    TargetDefectKind::NotOrthogonal, TargetDefectKind::SmallFlowLink, TargetDefectKind::Courant}));
}

}  // namespace
}  // namespace coastmesh
