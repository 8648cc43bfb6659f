#include "apps/merge/merge_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "gis/cut/cut_grid.hpp"
#include "parallel/recorder.hpp"
#include "parallel/workers.hpp"
#include "tests/gis/merge/merged.hpp"

namespace coastmesh {
namespace {

using namespace coastmesh::testing;

MergedMesh mergeAndCheck(Grid& grid, const Grid& inserted, const MergeOptions& options = {}) {
  const Grid before = grid;
  const MergedMesh result = mergeMesh(grid, Grid(inserted), options);
  expectMerged(before, inserted, grid, result.nodes, result.triangles);
  return result;
}

struct Figures {
  double least_angle = 180.0;
  double longest_m = 0.0;
  std::size_t triangles = 0;
};

Figures figuresOfNew(const Grid& grid, const MergedMesh& result) {
  Figures figures;
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    if (result.triangles[t].mesh != kNone) continue;
    const GridCorners& v = grid.triangles[t];
    const Point &a = grid.nodes[v[0]], &b = grid.nodes[v[1]], &c = grid.nodes[v[2]];
    figures.least_angle = std::min(figures.least_angle, leastAngleDeg(a, b, c));
    figures.longest_m = std::max({figures.longest_m, distance(a, b), distance(b, c), distance(c, a)});
    ++figures.triangles;
  }
  return figures;
}

TEST(MergeMesh, SizesGrowFromTheFinerMeshToTheCoarser) {
  Grid grid = gridOf({40, 40});
  const Grid fine = gridOf({60, 50, 0.1, {17.3, 18.4}, 0.2}, BoundaryRole::Open);
  const MergedMesh result = mergeAndCheck(grid, fine);
  const Figures made = figuresOfNew(grid, result);
  EXPECT_GE(made.least_angle, 32.9);
  EXPECT_LT(made.longest_m, 1.8);
  ASSERT_TRUE(result.band.has_value());
  EXPECT_EQ(result.band->below_bounds, 0u);
  EXPECT_GT(result.replaced, 150u);
  // Sizes differ by at most a fifth of the distance: at a distance of d from the finer mesh, edges are at most about
  // 0.12 + 0.2 d, and it takes 5 to reach those of the coarser one.
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    if (result.triangles[t].mesh == 1) continue;
    const GridCorners& v = grid.triangles[t];
    const Point middle = centroid(grid.nodes[v[0]], grid.nodes[v[1]], grid.nodes[v[2]]);
    double nearest = 1e9;
    for (const Point& p : fine.nodes) nearest = std::min(nearest, distance(p, middle));
    const double longest =
        std::max({distance(grid.nodes[v[0]], grid.nodes[v[1]]), distance(grid.nodes[v[1]], grid.nodes[v[2]]),
                  distance(grid.nodes[v[2]], grid.nodes[v[0]])});
    if (nearest < 3.0) {
      EXPECT_LT(longest, 1.7 * (0.12 + 0.2 * (nearest + longest))) << nearest;
    }
  }
  // Depths are linear before and after.
  for (std::size_t n = 0; n < grid.nodes.size(); ++n)
    EXPECT_NEAR(grid.z[n], -10.0 - 0.25 * grid.nodes[n].x + 0.125 * grid.nodes[n].y, 0.15);
}

// Those of new triangles, between the meshes too, and of a mesh that has none.
TEST(MergeMesh, AnglesAndAreasOfAllTrianglesAreMeasured) {
  for (const int columns : {10, 20}) {
    Grid grid = gridOf({40, 40});
    grid.area_m2.assign(grid.triangles.size(), 0.5);
    grid.min_angle_deg.assign(grid.triangles.size(), 45.0);
    mergeAndCheck(grid, gridOf({columns, columns, 1.0, {12.3, 12.4}, 0.2}, BoundaryRole::Open));
    ASSERT_EQ(grid.area_m2.size(), grid.triangles.size());
    ASSERT_EQ(grid.min_angle_deg.size(), grid.triangles.size());
    for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
      const GridCorners& v = grid.triangles[t];
      const Point &a = grid.nodes[v[0]], &b = grid.nodes[v[1]], &c = grid.nodes[v[2]];
      EXPECT_NEAR(grid.area_m2[t], signedArea(a, b, c), 1e-9) << t;
      EXPECT_NEAR(grid.min_angle_deg[t], leastAngleDeg(a, b, c), 1e-6) << t;
    }
  }
}

TEST(MergeMesh, ASteeperGradationReplacesLess) {
  const Grid fine = gridOf({60, 50, 0.1, {17.3, 18.4}, 0.2}, BoundaryRole::Open);
  const auto replacedBy = [&](double gradation) {
    Grid grid = gridOf({40, 40});
    MergeOptions options;
    options.gradation = gradation;
    return mergeAndCheck(grid, fine, options).replaced;
  };
  const std::size_t gentle = replacedBy(0.1), steep = replacedBy(0.5);
  EXPECT_GT(gentle, 2 * steep);
}

TEST(MergeMesh, RandomPlacesInTheMidst) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int run = 0; run < 25; ++run) {
    Grid grid = gridOf({20, 20});
    Squares squares;
    squares.length = 0.2 + 0.8 * share(random);
    squares.columns = 2 + static_cast<int>(5.0 * share(random) / squares.length);
    squares.rows = 2 + static_cast<int>(5.0 * share(random) / squares.length);
    squares.turn = 6.0 * share(random);
    squares.corner.x = 10.0 + share(random);
    squares.corner.y = 10.0 + share(random);
    SCOPED_TRACE(run);
    const MergedMesh result = mergeAndCheck(grid, gridOf(squares, BoundaryRole::Open));
    EXPECT_NEAR(areaOf(grid), 400.0, 1e-9);
    EXPECT_GE(figuresOfNew(grid, result).least_angle, 25.0);
  }
}

TEST(MergeMesh, AtACoastAnglesStayLarge) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int run = 0; run < 25; ++run) {
    Grid grid = gridOf({20, 20});
    const double length = 0.3 + 0.5 * share(random), south = 3.0 + 4.0 * share(random);
    Grid bay = gridOf(
        {static_cast<int>(6.0 / length), static_cast<int>(8.0 / length), length, {-0.4 + 0.8 * share(random), south}});
    const double west = bay.nodes[0].x;
    openWhere(bay, [&](const Point& p) { return p.x > west + 0.01; });
    SCOPED_TRACE(run);
    const MergedMesh result = mergeAndCheck(grid, bay);
    EXPECT_GE(figuresOfNew(grid, result).least_angle, 30.0);
  }
}

TEST(MergeMesh, NothingIsMeshedAnewWherePartsContinueOneAnother) {
  const Grid whole = gridOf({20, 20});
  Grid west = whole, east = whole;
  const auto middlesWhere = [&](bool is_west) {
    std::vector<std::uint8_t> taken;
    for (const GridCorners& v : whole.triangles)
      taken.push_back((whole.nodes[v[0]].x + whole.nodes[v[1]].x + whole.nodes[v[2]].x < 27.0) == is_west ? 1 : 0);
    return taken;
  };
  cutGrid(west, middlesWhere(true));
  cutGrid(east, middlesWhere(false));
  const MergedMesh result = mergeAndCheck(west, east);
  EXPECT_FALSE(result.band.has_value());
  EXPECT_EQ(trianglesOf(west), trianglesOf(whole));
}

TEST(MergeMesh, IsTheSameForAnyNumberOfThreads) {
  const Grid fine = gridOf({60, 50, 0.1, {17.3, 18.4}, 0.2}, BoundaryRole::Open);
  const auto mergedBy = [&](int threads) {
    Grid grid = gridOf({40, 40});
    withThreads({threads}, [&] {
      Recorder recorder;
      mergeMesh(grid, Grid(fine), {}, {}, recorder.loop("merge"));
    });
    return grid;
  };
  const Grid one = mergedBy(1), three = mergedBy(3);
  EXPECT_EQ(one.nodes, three.nodes);
  EXPECT_EQ(one.triangles, three.triangles);
}

}  // namespace
}  // namespace coastmesh
