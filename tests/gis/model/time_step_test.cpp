// The time step that a grid allows a model, by geodesics; and floors of sizes that still hold after grading.
#include "gis/model/time_step.hpp"

#include <gdal.h>
#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>

#include "gis/size/size_source.hpp"
#include "tests/gis/check/target_samples.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using testing::lattice;

// Squares of a tenth of a degree at `latitude`, cut into triangles, 40 m deep except one node.
Grid gridAt(double latitude) {
  const TriMesh mesh = lattice(
      6, 4, [](int, int) { return true; },
      [&](int i, int j) {
        return Point{179.8 + 0.1 * i + 0.01 * j, latitude + 0.1 * j};
      });
  Grid grid;
  grid.crs = wgs84();
  grid.nodes = mesh.points;
  for (Point& p : grid.nodes)
    if (p.x > 180.0) p.x -= 360.0;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  grid.z.assign(grid.nodes.size(), -40.0);
  grid.z[9] = -160.0;
  grid.boundaries = findBoundaries(mesh);
  return grid;
}

double geodesicBetween(const Point& a, const Point& b) {
  double metres = 0.0;
  GeographicLib::Geodesic::WGS84().Inverse(a.y, a.x, b.y, b.x, metres);
  return metres;
}

TEST(TimeStep, IsTheShortestEdgeOverTheSpeedOfALongWave) {
  for (const double latitude : {-0.2, 52.0, 88.5}) {
    const Grid grid = gridAt(latitude);
    const std::vector<double> steps = timeSteps(grid);
    double least = std::numeric_limits<double>::infinity(), shortest = least;
    for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
      const auto& [a, b, c] = grid.triangles[t];
      const double edge =
          std::min({geodesicBetween(grid.nodes[a], grid.nodes[b]), geodesicBetween(grid.nodes[b], grid.nodes[c]),
                    geodesicBetween(grid.nodes[c], grid.nodes[a])});
      const double depth = a == 9 || b == 9 || c == 9 ? 160.0 : 40.0;
      EXPECT_NEAR(steps[t], edge / std::sqrt(9.81 * depth), 1e-6 * steps[t]);
      least = std::min(least, edge / std::sqrt(9.81 * depth));
      shortest = std::min(shortest, edge);
    }
    const StepReport report = measureStep(grid);
    EXPECT_NEAR(report.step_s, least, 1e-6 * least);
    EXPECT_NEAR(report.shortest_edge_m, shortest, 1e-6 * shortest);
    EXPECT_LT(geodesicBetween(report.step_place, grid.nodes[9]), 12000.0);
  }
}

TEST(TimeStep, NeedsDepthsBelowWater) {
  Grid grid = gridAt(52.0);
  std::ranges::fill(grid.z, 3.0);
  EXPECT_TRUE(measureStep(grid).has_depths);
  EXPECT_TRUE(std::isinf(measureStep(grid).step_s));
  grid.z.clear();
  EXPECT_FALSE(measureStep(grid).has_depths);
  EXPECT_TRUE(std::ranges::all_of(timeSteps(grid), [](double step) { return std::isnan(step); }));
  EXPECT_GT(measureStep(grid).shortest_edge_m, 0.0);
}

TEST(TimeStep, IsShorterOnAFloodedPlain) {
  Grid grid = gridAt(52.0);
  const StepReport dry = measureStep(grid);
  EXPECT_EQ(dry.flood_m, 0.0);
  // Land of 2 m, but for one corner, and far from the deepest node.
  const std::size_t land = grid.nodes.size() / 4;
  std::fill(grid.z.end() - static_cast<std::ptrdiff_t>(land), grid.z.end(), 2.0);
  const StepReport report = measureStep(grid);
  EXPECT_EQ(report.step_s, dry.step_s);
  EXPECT_EQ(report.flood_m, 2.0);
  EXPECT_LT(report.flooded_step_s, report.step_s);
  for (double& z : grid.z) z -= 2.0;
  EXPECT_NEAR(report.flooded_step_s, measureStep(grid).step_s, 1e-12);
  // Mountains are no plain, nor is a single node.
  for (double& z : grid.z) z = z == 0.0 ? 300.0 : z;
  EXPECT_EQ(measureStep(grid).flood_m, 0.0);
  for (double& z : grid.z) z = -40.0;
  EXPECT_EQ(measureStep(grid).flood_m, 0.0);
}

TEST(TimeStep, TooLongStepsAreThoseInWaterOfTheLeastDepth) {
  Grid grid = gridAt(52.0);
  std::ranges::fill(grid.z, -2.0);
  const double step = 0.1 * measureStep(grid).step_s;
  EXPECT_EQ(stepsAbove(grid, step, 0.5, 2.0).size(), grid.triangles.size());
  EXPECT_TRUE(stepsAbove(grid, step, 0.5, 2.1).empty());
  EXPECT_TRUE(stepsAbove(grid, step, 0.05, 2.0).empty());
}

TEST(TimeStep, WhatFallsShortIsListedWorstFirstWithItsCause) {
  const Grid grid = gridAt(52.0);
  const double least = measureStep(grid).step_s;
  EXPECT_TRUE(stepsBelow(grid, 0.999 * least, 1.0).empty());
  const std::vector<ShortStep> found = stepsBelow(grid, 1.5 * least, 1.0);
  ASSERT_FALSE(found.empty());
  EXPECT_TRUE(std::ranges::is_sorted(found, {}, &ShortStep::step_s));
  EXPECT_NEAR(found.front().step_s, least, 1e-9 * least);
  // A larger Courant number allows a longer step.
  EXPECT_TRUE(stepsBelow(grid, 1.5 * least, 1.6).empty());

  // The edges along parallels are the shorter ones; those of the outermost rows are shore.
  const double parallel = geodesicBetween(grid.nodes[0], grid.nodes[1]);
  const std::vector<ShortEdge> edges = edgesBelow(grid, 1.0001 * parallel);
  ASSERT_EQ(edges.size(), 5u * 6u);
  EXPECT_EQ(std::ranges::count(edges, ShortCause::Shore, &ShortEdge::cause), 2 * 6);
  EXPECT_EQ(std::ranges::count(edges, ShortCause::Interior, &ShortEdge::cause), 3 * 6);
}

TEST(TimeStep, AnEdgeFromShoreToShoreIsNarrow) {
  const TriMesh mesh = lattice(3, 1, [](int, int) { return true; });
  Grid grid;
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  const std::vector<ShortEdge> edges = edgesBelow(grid, 1.1);
  EXPECT_EQ(std::ranges::count(edges, ShortCause::Narrow, &ShortEdge::cause), 2);
  EXPECT_EQ(std::ranges::count(edges, ShortCause::Shore, &ShortEdge::cause), 8);
}

TEST(TimeStep, AnEdgeOfAnOpeningIsNoShore) {
  Grid grid = testing::openGrid();
  const auto countOf = [&grid](ShortCause cause) {
    return std::ranges::count(edgesBelow(grid, 1e6), cause, &ShortEdge::cause);
  };
  const auto opening = countOf(ShortCause::Opening), shore = countOf(ShortCause::Shore);
  EXPECT_GT(opening, 4);
  const auto narrow = countOf(ShortCause::Narrow);
  for (Boundary& boundary : grid.boundaries) boundary.role = BoundaryRole::Land;
  EXPECT_EQ(countOf(ShortCause::Shore), shore + opening);
  EXPECT_GE(countOf(ShortCause::Narrow), narrow);
  EXPECT_EQ(countOf(ShortCause::Opening), 0);
}

TEST(TimeStep, AnEdgeOfALineIsNoShore) {
  const TriMesh mesh = lattice(6, 4, [](int, int) { return true; });
  Grid grid;
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  const auto nodeAt = [&](double x, double y) {
    return static_cast<std::uint32_t>(
        std::ranges::find_if(grid.nodes, [&](const Point& p) { return p.x == x && p.y == y; }) - grid.nodes.begin());
  };
  const auto countOf = [&grid](ShortCause cause) {
    return std::ranges::count(edgesBelow(grid, 1.1), cause, &ShortEdge::cause);
  };
  const auto shore = countOf(ShortCause::Shore), interior = countOf(ShortCause::Interior);
  grid.lines = {{LineKind::Constraint, "dike", false, {nodeAt(2.0, 2.0), nodeAt(3.0, 2.0)}}};
  EXPECT_EQ(countOf(ShortCause::Shore), shore);
  EXPECT_EQ(countOf(ShortCause::Line), 7);  // itself, and three that end at each of its ends
  EXPECT_EQ(countOf(ShortCause::Interior), interior - 7);
}

// Beside a cliff of 2000 m, sizes on the shelf must grow before the cliff is reached.
TEST(TimeStep, SizesGrowTowardsDeepWaterAsFarAsGradingNeeds) {
  GDALAllRegister();
  const testing::TemporaryFolder folder;
  const std::string path = folder / "cliff.asc";
  {
    std::ofstream file(path);
    file << "ncols 200\nnrows 100\nxllcorner 0\nyllcorner 0\ncellsize 500\n";
    for (int j = 0; j < 100; ++j) {
      for (int i = 0; i < 200; ++i) file << (i < 100 ? -20 : -2000) << ' ';
      file << '\n';
    }
  }
  Domain domain;
  domain.pslg.points = {{1000.0, 1000.0}, {99000.0, 1000.0}, {99000.0, 49000.0}, {1000.0, 49000.0}};
  for (VertexId v = 0; v < 4; ++v) domain.pslg.segments.push_back({v, (v + 1) % 4});
  domain.input_points = domain.pslg.points;
  SizeOptions options;
  options.size_m = 500.0;
  options.gradation = 0.1;
  options.bathymetry = {path};
  options.time_step_s = 20.0;
  const auto size = makeSizeFunction(options, readSizeInputs(options, {}), domain, 1e9, inOrder).function;
  const double deep = 20.0 * std::sqrt(9.81 * 2000.0), shelf = 20.0 * std::sqrt(9.81 * 20.0);
  for (double x = 2000.0; x < 98000.0; x += 777.0) {
    const double needed = x < 50000.0 ? std::max(shelf, deep - 0.1 * (50500.0 - x)) : deep;
    EXPECT_GE(size->at({x, 25000.0}), needed) << x;
    EXPECT_LE(size->at({x, 25000.0}), 1.1 * std::max(500.0, deep / 0.6 - 0.097 * std::max(0.0, 49500.0 - x))) << x;
  }
}

}  // namespace
}  // namespace coastmesh
