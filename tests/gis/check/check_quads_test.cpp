// What models say to quadrilaterals, and repairs of the triangles beside them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "gis/check/check_target.hpp"
#include "gis/check/flow_links.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/repair/repair_target.hpp"
#include "tests/gis/quad_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::mixedGrid;

std::size_t countOf(const Grid& grid, Target target, TargetDefectKind kind) {
  return static_cast<std::size_t>(std::ranges::count(checkTarget(grid, target), kind, &TargetDefect::kind));
}

TEST(CheckQuads, ModelsOfTrianglesRejectThem) {
  const Grid grid = mixedGrid(
      6, 4, [](int i, int) { return i > 2; }, wgs84(), 0.01);
  for (const Target target :
       {Target::Adcirc, Target::Fvcom, Target::Telemac, Target::Swan, Target::Fesom, Target::Mpas})
    EXPECT_EQ(countOf(grid, target, TargetDefectKind::Quadrilateral), 12u);
  for (const Target target : {Target::Schism, Target::Dflowfm})
    EXPECT_EQ(countOf(grid, target, TargetDefectKind::Quadrilateral), 0u);
}

// The halves of a rectangle have the same circumcentre: a link between them would have no length.
TEST(CheckQuads, FlowLinksLeadFromElementToElement) {
  const Grid rectangles = mixedGrid(5, 4, [](int, int) { return true; });
  EXPECT_THAT(checkTarget(rectangles, Target::Dflowfm), IsEmpty());
  const Grid halves = mixedGrid(5, 4, [](int, int) { return false; });
  EXPECT_GT(countOf(halves, Target::Dflowfm, TargetDefectKind::SmallFlowLink), 0u);
  Grid slanting = rectangles;
  for (Point& p : slanting.nodes) p.x += 2.5 * p.y;
  EXPECT_GT(countOf(slanting, Target::Dflowfm, TargetDefectKind::NotOrthogonal), 0u);
}

TEST(FlowLinks, BetweenRectangles) {
  const std::vector<Point> left{{2, 0}, {2, 1}, {0, 1}, {0, 0}}, right{{2, 1}, {2, 0}, {5, 0}, {5, 1}};
  const FlowLink link = flowLinkAcross(left, right);
  EXPECT_NEAR(link.cosine, 0.0, 1e-12);
  EXPECT_NEAR(link.length, 2.5 / (0.5 * (std::sqrt(2.0) + std::sqrt(3.0))), 1e-12);
}

// The corners of both lie on circles, whose centres are theirs.
TEST(FlowLinks, BetweenATriangleAndATrapezoid) {
  const double h = std::sqrt(3.0) / 2.0;
  const std::vector<Point> triangle{{0, 0}, {1, 0}, {0.5, h}};
  const std::vector<Point> trapezoid{{1, 0}, {0, 0}, {-0.5, -h}, {1.5, -h}};  // half of a hexagon with sides of 1
  const FlowLink link = flowLinkAcross(triangle, trapezoid);
  EXPECT_NEAR(link.cosine, 0.0, 1e-9);
  EXPECT_NEAR(link.length, (h / 3.0 + h) / (0.5 * (std::sqrt(h / 2.0) + std::sqrt(1.5 * h))), 1e-9);
}

// The places of the nodes of each.
std::set<std::vector<std::pair<double, double>>> placesOf(const Grid& grid) {
  std::set<std::vector<std::pair<double, double>>> places;
  for (const Quad& quad : quadsOf(grid)) {
    std::vector<std::pair<double, double>> corners;
    for (const std::uint32_t node : quad.nodes) corners.emplace_back(grid.nodes[node].x, grid.nodes[node].y);
    places.insert(corners);
  }
  return places;
}

TEST(RepairQuads, TheyStayWhileTrianglesAreRepaired) {
  Grid grid = mixedGrid(8, 6, [](int i, int) { return i < 3; });
  const auto before = placesOf(grid);
  ASSERT_EQ(before.size(), 18u);
  const RepairReport report = repairForTargets(grid, std::vector{Target::Dflowfm});
  EXPECT_FALSE(report.repairs.empty());
  EXPECT_EQ(placesOf(grid), before);
}

TEST(RepairQuads, ModelsOfTrianglesGetTriangles) {
  Grid grid = mixedGrid(
      6, 4, [](int i, int) { return i > 2; }, wgs84(), 0.01);
  const RepairReport report = repairForTargets(grid, std::vector{Target::Adcirc, Target::Schism});
  ASSERT_FALSE(report.repairs.empty());
  EXPECT_EQ(report.repairs.front().kind, TargetDefectKind::Quadrilateral);
  EXPECT_EQ(report.repairs.front().target, Target::Adcirc);
  EXPECT_THAT(report.repairs.front().what, HasSubstr("12 split into two triangles each"));
  EXPECT_THAT(quadsOf(grid), IsEmpty());
  EXPECT_EQ(countOf(grid, Target::Adcirc, TargetDefectKind::Quadrilateral), 0u);
}

// A pond of one quadrilateral is taken out whole.
TEST(RepairQuads, WithoutANeighbourTheyAreOrphans) {
  Grid grid = mixedGrid(6, 2, [](int i, int j) { return i == 5 && j == 1; });
  std::vector<bool> gone(grid.triangles.size(), false);
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t)
    for (const std::uint32_t node : grid.triangles[t])
      if (grid.quad_of[t] == kNone && grid.nodes[node].x > 8.0) gone[t] = true;
  removeTriangles(grid, gone);
  removeUnusedNodes(grid);
  grid.boundaries = findBoundaries(linkGrid(grid).mesh);
  ASSERT_EQ(quadsOf(grid).size(), 1u);
  EXPECT_EQ(countOf(grid, Target::Schism, TargetDefectKind::OrphanCell), 1u);
  const std::size_t triangles = grid.triangles.size();
  const RepairReport report = repairForTargets(grid, std::vector{Target::Schism});
  EXPECT_TRUE(std::ranges::any_of(report.repairs, [](const Repair& r) { return r.what == "quadrilateral removed"; }));
  EXPECT_EQ(grid.triangles.size(), triangles - 2);
  EXPECT_THAT(checkTarget(grid, Target::Schism), IsEmpty());
}

}  // namespace
}  // namespace coastmesh
