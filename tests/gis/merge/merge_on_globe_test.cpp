// Meshes that are put into a mesh of the whole globe: across the antimeridian, at the poles and elsewhere.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "gis/error.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/merge/merge_grids.hpp"
#include "gis/merge/nest_plane.hpp"
#include "tests/gis/globe_samples.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using namespace coastmesh::testing;
using ::testing::HasSubstr;

constexpr double kDegrees = 180.0 / std::numbers::pi;

Grid globe() {
  return octahedralGlobe(4, [](const SpaceVector&) { return true; });
}

SpaceVector cornerOf(const Grid& grid, const std::array<std::uint32_t, 3>& v, std::size_t i) {
  return vectorOf(grid.nodes[v[i]]);
}

// The solid angle of a triangle (van Oosterom and Strackee 1983), negative if it is clockwise.
double solidAngle(const SpaceVector& a, const SpaceVector& b, const SpaceVector& c) {
  return 2.0 * std::atan2(testing::dot(a, testing::cross(b, c)),
                          1.0 + testing::dot(a, b) + testing::dot(b, c) + testing::dot(c, a));
}

// A disk of hexagonal rings, open all around; its nodes are `spacing` degrees apart.
Grid diskAround(const Point& middle, int rings, double spacing, double turn = 0.3) {
  const TriMesh mesh = lattice(2 * rings, 2 * rings, [&](int i, int j) {
    const int x = i - rings, y = j - rings;
    return std::max({std::abs(x), std::abs(y), std::abs(x + y + 1)}) < rings;
  });
  const SpaceVector up = vectorOf(middle);
  const SpaceVector aside = std::abs(up[2]) > 0.5 ? SpaceVector{1.0, 0.0, 0.0} : SpaceVector{0.0, 0.0, 1.0};
  SpaceVector east = testing::cross(aside, up);
  const double length = lengthOf(east);
  for (double& x : east) x /= length;
  const SpaceVector north = testing::cross(up, east);
  Grid grid;
  grid.crs = wgs84();
  for (const Point& p : mesh.points) {
    // The lattice's squares, sheared to equilateral triangles with the diagonals as sides, and turned.
    const double sheared_x = (p.x - rings) - 0.5 * (p.y - rings), sheared_y = std::sqrt(0.75) * (p.y - rings);
    const double x = std::cos(turn) * sheared_x - std::sin(turn) * sheared_y;
    const double y = std::sin(turn) * sheared_x + std::cos(turn) * sheared_y;
    const double reach = std::hypot(x, y), angle = reach * spacing / kDegrees;
    SpaceVector place{};
    for (std::size_t k = 0; k < 3; ++k)
      place[k] = std::cos(angle) * up[k] + (reach > 0.0 ? std::sin(angle) / reach * (x * east[k] + y * north[k]) : 0.0);
    grid.nodes.push_back(
        {std::atan2(place[1], place[0]) * kDegrees, std::atan2(place[2], std::hypot(place[0], place[1])) * kDegrees});
  }
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  std::vector<EdgeConflict> conflicts;
  grid.boundaries = findBoundaries(linkTriangles(grid.nodes, grid.triangles, conflicts));
  for (Boundary& boundary : grid.boundaries) boundary.role = BoundaryRole::Open;
  removeUnusedNodes(grid);
  return grid;
}

class MergeOnGlobe : public ::testing::TestWithParam<Point> {};

// The result covers the globe once: every triangle is counter-clockwise on it, and their areas add up to it.
TEST_P(MergeOnGlobe, CoversItOnce) {
  Grid grid = globe();
  const Grid before = grid, disk = diskAround(GetParam(), 8, 2.0);
  const MergeReport report = mergeGrids(grid, Grid(disk));
  EXPECT_GT(report.covered, 20u);
  EXPECT_GT(report.gap, 20u);
  EXPECT_EQ(report.joined, edgesOf(disk.boundaries.front()).size());
  EXPECT_TRUE(grid.boundaries.empty());
  EXPECT_LT(report.lost.area_m2, 1.0);
  double all = 0.0;
  for (const std::array<std::uint32_t, 3>& v : grid.triangles) {
    const double own = solidAngle(cornerOf(grid, v, 0), cornerOf(grid, v, 1), cornerOf(grid, v, 2));
    EXPECT_GT(own, 0.0);
    all += own;
  }
  EXPECT_NEAR(all, 4.0 * std::numbers::pi, 1e-9);
  for (std::size_t v = 0; v < grid.nodes.size(); ++v) {
    const auto& [mesh, number] = report.nodes[v];
    ASSERT_NE(mesh, kNone);
    EXPECT_EQ(grid.nodes[v], (mesh == 0 ? before : disk).nodes[number]);
  }
}

INSTANTIATE_TEST_SUITE_P(Places, MergeOnGlobe,
                         ::testing::Values(Point{180.0, 0.0}, Point{-178.0, 52.0}, Point{0.0, 90.0}, Point{40.0, -90.0},
                                           Point{120.0, 84.0}, Point{-71.0, 18.0}, Point{0.0, 0.0}),
                         [](const auto& place) { return "Place" + std::to_string(place.index); });

// Longitudes of the result are in the turn of the grid's.
TEST(MergeIntoGlobe, LongitudesOfOneTurn) {
  Grid grid = globe();
  Grid disk = diskAround({180.0, 10.0}, 8, 2.0);
  for (Point& node : disk.nodes)
    if (node.x < 0.0) node.x += 360.0;
  mergeGrids(grid, std::move(disk));
  for (const Point& node : grid.nodes) EXPECT_LE(std::abs(node.x), 180.0);
}

TEST(MergeIntoGlobe, WhatIsCutOutFitsBackExactly) {
  const auto isNear = [](const SpaceVector& middle) {
    return testing::dot(middle, vectorOf({175.0, 70.0})) > std::cos(30.0 / kDegrees) * lengthOf(middle);
  };
  Grid grid = octahedralGlobe(4, [&](const SpaceVector& middle) { return !isNear(middle); });
  Grid part = octahedralGlobe(4, isNear);
  for (Grid* const each : {&grid, &part})
    for (Boundary& boundary : each->boundaries) boundary.role = BoundaryRole::Open;
  const MergeReport report = mergeGrids(grid, std::move(part));
  EXPECT_EQ(report.covered, 0u);
  EXPECT_EQ(report.gap, 0u);
  EXPECT_EQ(grid.triangles.size(), globe().triangles.size());
  EXPECT_TRUE(grid.boundaries.empty());
}

TEST(MergeIntoGlobe, WhatReachesTooFarIsRefused) {
  Grid grid = globe();
  Grid most = octahedralGlobe(3, [](const SpaceVector& middle) { return middle[2] > -0.5 * lengthOf(middle); });
  for (Boundary& boundary : most.boundaries) boundary.role = BoundaryRole::Open;
  try {
    mergeGrids(grid, std::move(most));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("80 degrees"));
  }
}

TEST(NestPlane, InverseIsInverse) {
  const Grid grid = globe(), disk = diskAround({170.0, 60.0}, 4, 2.0);
  const std::optional<NestPlane> plane = NestPlane::around(grid, disk);
  ASSERT_TRUE(plane.has_value());
  for (const Point& p : {Point{170.0, 60.0}, Point{-170.0, 40.0}, Point{10.0, -20.0}, Point{175.0, 89.0}}) {
    const Point back = plane->inverse(plane->forward(p));
    EXPECT_NEAR(back.x, p.x, 1e-9);
    EXPECT_NEAR(back.y, p.y, 1e-9);
  }
  EXPECT_FALSE(plane->isFar(plane->forward({170.0, -50.0})));
  EXPECT_TRUE(plane->isFar(plane->forward({170.0, -70.0})));
}

// In no direction from the middle, and still not close to it.
TEST(NestPlane, TheOppositePlaceIsFar) {
  Grid pole;
  pole.crs = wgs84();
  pole.nodes = {{0.0, 90.0}};
  const std::optional<NestPlane> plane = NestPlane::around(globe(), pole);
  ASSERT_TRUE(plane.has_value());
  for (const double south : {-90.0, -89.9999999, -89.0}) EXPECT_TRUE(plane->isFar(plane->forward({20.0, south})));
}

TEST(NestPlane, IsForMeshesWhoseLongitudesJump) {
  const Grid disk = diskAround({20.0, 40.0}, 4, 2.0);
  EXPECT_FALSE(NestPlane::around(disk, disk).has_value());
  EXPECT_TRUE(NestPlane::around(globe(), disk).has_value());
}

}  // namespace
}  // namespace coastmesh
