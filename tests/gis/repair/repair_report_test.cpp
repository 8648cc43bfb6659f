// What repairs report as left, their progress, and their end on request.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

#include "tests/gis/check/target_samples.hpp"

namespace coastmesh {
namespace {

// A sea in degrees with all nodes moved, those of the shore too, so that some angles cannot be repaired.
Grid shakenSea(unsigned seed) {
  Grid grid = testing::soundGrid();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-420.0, 420.0);
  grid.crs = wgs84();
  for (Point& p : grid.nodes) p = {(p.x + shift(random)) * 1e-5, 60.0 + (p.y + shift(random)) * 1e-5};
  return grid;
}

using Left = std::vector<std::tuple<TargetDefectKind, double, double>>;

TEST(RepairReport, WhatIsLeftIsWhatACheckFinds) {
  std::size_t left_over = 0;
  for (const Target target : {Target::Swan, Target::Mpas}) {
    for (unsigned seed = 0; seed < 10; ++seed) {
      Grid grid = shakenSea(seed);
      const RepairReport report = repairForTargets(grid, std::array{target}, {.min_angle_deg = 15.0});
      Left left, found;
      for (const auto& [of, defect] : report.left) left.emplace_back(defect.kind, defect.place.x, defect.place.y);
      for (const TargetDefect& defect : checkTarget(grid, target))
        if (!defect.advice) found.emplace_back(defect.kind, defect.place.x, defect.place.y);
      std::ranges::sort(left);
      std::ranges::sort(found);
      EXPECT_EQ(left, found) << seed;
      left_over += left.size();
    }
  }
  EXPECT_GT(left_over, 20u);
}

TEST(RepairReport, ProgressGrowsAndRepairsEndOnRequest) {
  std::vector<double> shares;
  Grid grid = shakenSea(1);
  const RunControl watching{{}, [&shares](double share) { shares.push_back(share); }};
  repairForTargets(grid, std::array{Target::Swan}, {.min_angle_deg = 33.0}, nullptr, watching);
  EXPECT_GT(shares.size(), 2u);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_TRUE(std::ranges::all_of(shares, [](double share) { return share >= 0.0 && share <= 1.0; }));

  int polls = 0;
  const RunControl ending{[&polls] { return ++polls > 1; }, {}};
  grid = shakenSea(1);
  EXPECT_THROW(repairForTargets(grid, std::array{Target::Swan}, {.min_angle_deg = 33.0}, nullptr, ending), Cancelled);
}

}  // namespace
}  // namespace coastmesh
