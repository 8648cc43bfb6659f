#include "gis/rivers/lay_rivers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "apps/merge/merge_mesh.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/fields/plain_field.hpp"
#include "tests/gis/merge/merged.hpp"

namespace coastmesh {
namespace {

using namespace coastmesh::testing;

RiverLine lineOf(std::vector<Point> points, double width, const std::string& name = "R") {
  RiverLine line;
  line.points = std::move(points);
  line.width_m = width;
  line.name = name;
  line.source = "rivers";
  return line;
}

// 4 km by 4 km of water.
Grid sea() { return gridOf({20, 20, 200.0}); }

std::size_t boundariesOf(const Grid& grid, BoundaryRole role) {
  std::size_t count = 0;
  for (const Boundary& boundary : grid.boundaries) count += boundary.role == role ? 1 : 0;
  return count;
}

std::vector<RiverLoss> lossesOf(const LaidRivers& laid) {
  std::vector<RiverLoss> losses;
  for (const LostRiver& lost : laid.report.lost) losses.push_back(lost.why);
  return losses;
}

TEST(LayRivers, ARiverEndsARowIntoTheWater) {
  const LaidRivers laid = layRivers({lineOf({{-3000, 2050}, {2000, 2050}}, 100.0)}, sea(), {});
  requireConsistent(laid.grid);
  EXPECT_EQ(laid.report.reaches, 1u);
  EXPECT_EQ(laid.report.quads, quadsOf(laid.grid).size());
  EXPECT_EQ(laid.report.triangles, 0u);
  double most = -1e9;
  for (const Point& p : laid.grid.nodes) most = std::max(most, p.x);
  EXPECT_GT(most, 0.0);
  EXPECT_LT(most, 2.0 * 150.0 + 1.0);  // rows are 150 m long
  EXPECT_NEAR(areaOf(laid.grid), (3000.0 + most) * 100.0, 1e-3);
  EXPECT_EQ(boundariesOf(laid.grid, BoundaryRole::River), 1u);
  EXPECT_TRUE(lossesOf(laid).empty());
}

TEST(LayRivers, BoundariesHaveTheNamesOfTheirRivers) {
  const LaidRivers laid =
      layRivers({lineOf({{-3000, 2050}, {2000, 2050}}, 100.0, "Ouse"), lineOf({{-3000, 3050}, {2000, 3050}}, 80.0, ""),
                 lineOf({{-3000, 1050}, {2000, 1050}}, 60.0, "Don")},
                sea(), {});
  std::multiset<std::string> names;
  for (const Boundary& boundary : laid.grid.boundaries) {
    if (boundary.role == BoundaryRole::River)
      names.insert(boundary.name);
    else
      EXPECT_EQ(boundary.name, "");
  }
  EXPECT_EQ(names, (std::multiset<std::string>{"", "Don", "Ouse"}));
}

TEST(LayRivers, WhatOfAMouthIsWiderThanTheWaterIsLand) {
  // The water ends at y = 4000.
  RiverOptions options;
  options.cells = 6;
  const LaidRivers laid = layRivers({lineOf({{-3000, 3980}, {150, 3980}}, 300.0)}, sea(), options);
  EXPECT_EQ(laid.report.inflows, 1u);
  for (const Boundary& boundary : laid.grid.boundaries) {
    if (boundary.role != BoundaryRole::River) continue;
    for (const std::uint32_t node : boundary.nodes) EXPECT_NEAR(laid.grid.nodes[node].x, -3000.0, 1e-6);
  }
}

TEST(LayRivers, AllOfARiverGetsRowsOnRequest) {
  RiverOptions options;
  options.extent = RiverExtent::All;
  const LaidRivers laid = layRivers({lineOf({{-3000, 2050}, {2000, 2050}}, 100.0)}, sea(), options);
  EXPECT_NEAR(areaOf(laid.grid), 5000.0 * 100.0, 1e-3);
}

TEST(LayRivers, CellsFollowTheWidth) {
  RiverOptions options;
  options.most_cell_width_m = 30.0;
  options.aspect = 2.0;
  const LaidRivers laid = layRivers({lineOf({{-3000, 2050}, {100, 2050}}, 100.0)}, sea(), options);
  std::set<double> across;
  for (const Point& p : laid.grid.nodes) across.insert(std::round(p.y));
  EXPECT_EQ(across.size(), 5u);  // four of 25 m
  EXPECT_NEAR(double(laid.report.quads), 4.0 * 3100.0 / 50.0, 8.0);
}

TEST(LayRivers, BranchesAreJoinedByTriangles) {
  const LaidRivers laid = layRivers(
      {lineOf({{-3000, 2050}, {100, 2050}}, 120.0, "main"), lineOf({{-1500, 4000}, {-1000, 2060}}, 60.0, "tributary")},
      sea(), {});
  requireConsistent(laid.grid);
  EXPECT_EQ(laid.report.junctions, 1u);
  EXPECT_EQ(laid.report.reaches, 3u);
  EXPECT_GT(laid.report.triangles, 3u);
  EXPECT_EQ(boundariesOf(laid.grid, BoundaryRole::River), 2u);
  const TriMesh mesh = linkGrid(laid.grid).mesh;
  EXPECT_EQ(boundaryLoops(mesh).size(), 1u);
  EXPECT_TRUE(triangleOverlaps(laid.grid, mesh).empty());
  for (const GridCorners& v : laid.grid.triangles)
    EXPECT_GT(leastAngleDeg(laid.grid.nodes[v[0]], laid.grid.nodes[v[1]], laid.grid.nodes[v[2]]), 15.0);
}

TEST(LayRivers, JunctionsWithAReachBetweenThatIsTooShortAreOne) {
  const LaidRivers laid =
      layRivers({lineOf({{-3000, 2050}, {100, 2050}}, 120.0), lineOf({{-1500, 4000}, {-1000, 2060}}, 60.0),
                 lineOf({{-900, 100}, {-950, 2040}}, 60.0)},
                sea(), {});
  EXPECT_EQ(laid.report.junctions, 1u);
  EXPECT_EQ(laid.report.reaches, 4u);
  EXPECT_TRUE(lossesOf(laid).empty());
  EXPECT_TRUE(triangleOverlaps(laid.grid, linkGrid(laid.grid).mesh).empty());
}

TEST(LayRivers, WhatIsNotConnectedIsLostByName) {
  const LaidRivers laid = layRivers(
      {lineOf({{-3000, 2050}, {100, 2050}}, 100.0, "kept"), lineOf({{-3000, 3000}, {-1000, 3000}}, 100.0, "far"),
       lineOf({{1000, 1000}, {3000, 1000}}, 100.0, "within")},
      sea(), {});
  EXPECT_THAT(lossesOf(laid), ::testing::UnorderedElementsAre(RiverLoss::Apart, RiverLoss::InWater));
  for (const LostRiver& lost : laid.report.lost) {
    EXPECT_EQ(lost.name, lost.why == RiverLoss::Apart ? "'far'" : "'within'");
    if (lost.why == RiverLoss::Apart) {
      EXPECT_NEAR(lost.distance, 1000.0, 1.0);
    }
  }
}

TEST(LayRivers, EndsCloseToTheWaterAreContinued) {
  const std::vector<RiverLine> lines{lineOf({{-3000, 2050}, {-250, 2050}}, 100.0)};
  const LaidRivers near = layRivers(lines, sea(), {});
  EXPECT_EQ(near.report.extended.size(), 1u);
  EXPECT_TRUE(lossesOf(near).empty());
  const std::vector<RiverLine> farther{lineOf({{-3000, 2050}, {-450, 2050}}, 100.0)};
  EXPECT_THAT(lossesOf(layRivers(farther, sea(), {})), ::testing::ElementsAre(RiverLoss::Apart));
  RiverOptions options;
  options.reach_m = 500.0;
  EXPECT_EQ(layRivers(farther, sea(), options).report.extended.size(), 1u);
}

TEST(LayRivers, ASpringNearTheWaterIsNoSecondMouth) {
  const std::vector<RiverLine> lines{lineOf({{-250, 2050}, {-2000, 2050}, {-2000, 500}, {300, 500}}, 100.0)};
  const LaidRivers laid = layRivers(lines, sea(), {});
  EXPECT_TRUE(laid.report.extended.empty());
  ASSERT_EQ(laid.report.left.size(), 1u);
  EXPECT_NEAR(laid.report.left[0].x, -250.0, 1e-6);
  EXPECT_EQ(laid.report.inflows, 1u);
  RiverOptions options;
  options.reach_m = 300.0;
  const LaidRivers asked = layRivers(lines, sea(), options);
  EXPECT_EQ(asked.report.extended.size(), 1u);
  EXPECT_EQ(asked.report.inflows, 0u);
}

TEST(LayRivers, AMouthBesideAnotherIsContinuedWhicheverWayLinesAreDrawn) {
  std::vector<RiverLine> lines{lineOf({{-3000, 2050}, {-1500, 2050}, {100, 2050}}, 100.0),
                               lineOf({{-1500, 2050}, {-1000, 1000}, {-250, 700}}, 60.0)};
  for (const bool upstream : {false, true}) {
    SCOPED_TRACE(upstream);
    const LaidRivers laid = layRivers(lines, sea(), {});
    // 250 m are more than three widths, and than an edge of the shore.
    EXPECT_TRUE(laid.report.extended.empty());
    std::vector<RiverLine> nearer = lines;
    (upstream ? nearer[1].points.front() : nearer[1].points.back()) = {-170, 700};
    EXPECT_EQ(layRivers(nearer, sea(), {}).report.extended.size(), 1u);
    for (RiverLine& line : lines) std::ranges::reverse(line.points);
  }
}

TEST(LayRivers, ACanalBetweenTwoWatersReachesBoth) {
  Grid waters = gridOf({20, 20, 200.0, {}, 0.0, [](int column, int) { return column < 8 || column > 11; }});
  const LaidRivers laid = layRivers({lineOf({{1690, 2050}, {2310, 2050}}, 30.0)}, waters, {});
  EXPECT_EQ(laid.report.extended.size(), 2u);  // 90 m on either side
  EXPECT_EQ(laid.report.inflows, 0u);
}

TEST(LayRivers, BothBanksReachTheWaterWhereALineJustEndsInIt) {
  for (const double slope : {-1.0, -0.5, 0.3, 1.2}) {
    SCOPED_TRACE(slope);
    Grid grid = sea();
    LaidRivers laid = layRivers({lineOf({{-2999, 2050 - 3000 * slope}, {1, 2050}}, 200.0)}, grid, {});
    ASSERT_EQ(laid.report.inflows, 1u);
    const double area = areaOf(grid);
    mergeMesh(grid, std::move(laid.grid), {});
    EXPECT_EQ(boundaryLoops(linkGrid(grid).mesh).size(), 1u);
    EXPECT_GT(areaOf(grid), area + 0.9 * 200.0 * 3000.0 * std::hypot(1.0, slope));
    // No wall across it.
    for (const Boundary& boundary : grid.boundaries) {
      EXPECT_NE(boundary.role, BoundaryRole::Open);
      for (const NodePair& edge : edgesOf(boundary)) {
        const Point middle = midpoint(grid.nodes[edge[0]], grid.nodes[edge[1]]);
        if (boundary.role == BoundaryRole::River || middle.x > 500.0) continue;
        EXPECT_GT(std::abs(middle.y - 2050 - slope * (middle.x - 1)) / std::hypot(1.0, slope), 95.0) << middle.x;
      }
    }
  }
}

TEST(LayRivers, AnEndOnAShoreIsConnected) {
  for (const Point& end : {Point{0, 2000}, Point{0, 2050}, Point{0, 4000}}) {
    Grid grid = sea();
    LaidRivers laid = layRivers({lineOf({{-3000, 2500}, end}, 60.0)}, grid, {});
    EXPECT_TRUE(lossesOf(laid).empty());
    mergeMesh(grid, std::move(laid.grid), {});
    EXPECT_EQ(boundaryLoops(linkGrid(grid).mesh).size(), 1u);
  }
}

// An inlet that ends in a point, at which the river comes in.
TEST(LayRivers, ARiverAtTheHeadOfAnInletIsConnected) {
  Grid grid = sea();
  // Two triangles beside the sea's western shore, 400 m wide there, with their tip 600 m from it.
  const auto tip = static_cast<std::uint32_t>(grid.nodes.size());
  grid.nodes.push_back({-600, 2000});
  grid.z.push_back(-10.0);
  const auto nodeAt = [&](double y) {
    return static_cast<std::uint32_t>(
        std::ranges::find_if(grid.nodes, [&](const Point& p) { return p.x == 0.0 && p.y == y; }) - grid.nodes.begin());
  };
  grid.triangles.push_back({tip, nodeAt(1800), nodeAt(2000)});
  grid.triangles.push_back({tip, nodeAt(2000), nodeAt(2200)});
  grid.boundaries = findBoundaries(linkGrid(grid).mesh);
  for (const double end : {-599.0, -600.0, -605.0, -560.0}) {
    SCOPED_TRACE(end);
    Grid whole = grid;
    LaidRivers laid = layRivers({lineOf({{-4000, 2100}, {end, 2000}}, 100.0)}, whole, {});
    EXPECT_TRUE(lossesOf(laid).empty());
    mergeMesh(whole, std::move(laid.grid), {});
    EXPECT_EQ(boundaryLoops(linkGrid(whole).mesh).size(), 1u);
  }
}

TEST(LayRivers, AnEndAtTheEdgeOfTheWaterIsAnInflow) {
  RiverOptions options;
  options.extent = RiverExtent::All;
  for (const double start : {0.0, -60.0}) {
    const LaidRivers laid = layRivers({lineOf({{start, 2050}, {2000, 2050}}, 100.0)}, sea(), options);
    EXPECT_EQ(laid.report.inflows, 1u) << start;
    EXPECT_TRUE(laid.report.extended.empty());
  }
}

// The sea with land west of x = 2000.
Grid seaAndPlain() {
  Grid grid = sea();
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) grid.z[i] = grid.nodes[i].x < 1999.0 ? 2.0 : -10.0;
  return grid;
}

TEST(LayRivers, AnEndOnLandCloseToTheEdgeOfTheMeshIsContinuedPastIt) {
  RiverOptions options;
  options.extent = RiverExtent::All;
  // Across the edge at right angles, and with one bank within.
  for (const Point start : {Point{150, 2050}, Point{20, 2050}, Point{-10, 500}, Point{30, 500}}) {
    SCOPED_TRACE(start.x);
    Grid grid = seaAndPlain();
    LaidRivers laid = layRivers({lineOf({start, {3000, 2050}}, 100.0)}, grid, options);
    EXPECT_EQ(laid.report.inflows, 1u);
    ASSERT_EQ(laid.report.led_out.size(), 1u);
    EXPECT_NEAR(distance(laid.report.led_out.front(), start), 0.0, 1e-6);
    EXPECT_TRUE(laid.report.on_land.empty());
    mergeMesh(grid, std::move(laid.grid), {});
    requireConsistent(grid);
    EXPECT_EQ(boundariesOf(grid, BoundaryRole::River), 1u);
    for (const Boundary& boundary : grid.boundaries)
      for (const std::uint32_t node : boundary.nodes) {
        if (boundary.role == BoundaryRole::River) {
          EXPECT_LT(grid.nodes[node].x, 0.0);
        }
      }
  }
}

TEST(LayRivers, EndsWithinTheLandOfTheMeshAreNamed) {
  RiverOptions options;
  options.extent = RiverExtent::All;
  const std::vector<RiverLine> lines{lineOf({{1000, 2050}, {3000, 2050}}, 100.0, "Ouse")};
  const LaidRivers laid = layRivers(lines, seaAndPlain(), options);
  EXPECT_EQ(laid.report.inflows, 0u);
  EXPECT_TRUE(laid.report.led_out.empty());
  ASSERT_EQ(laid.report.on_land.size(), 1u);
  EXPECT_EQ(laid.report.on_land.front().name, "Ouse");
  EXPECT_NEAR(laid.report.on_land.front().place.x, 1000.0, 1e-6);
  // In water, also of a polder that the mesh says is land.
  Grid water = sea();
  EXPECT_TRUE(layRivers(lines, water, options).report.on_land.empty());
  std::vector<std::uint8_t> land(water.nodes.size(), 0);
  for (std::size_t i = 0; i < land.size(); ++i) land[i] = water.nodes[i].x < 1999.0 ? 1 : 0;
  markPlain(water, land);
  EXPECT_EQ(layRivers(lines, water, options).report.on_land.size(), 1u);
}

TEST(LayRivers, RowsBesideAShoreAreShortEnoughForTrianglesBetween) {
  RiverOptions options;
  options.extent = RiverExtent::All;
  Grid grid = sea();
  LaidRivers laid = layRivers({lineOf({{400, 130}, {3600, 130}}, 100.0)}, grid, options);  // 80 m from the shore
  const double area = areaOf(grid);
  const MergedMesh merged = mergeMesh(grid, std::move(laid.grid), {});
  EXPECT_NEAR(areaOf(grid), area, 1e-6 * area);
  EXPECT_NEAR(merged.merged.lost.area_m2, 0.0, 1e-3);
}

TEST(LayRivers, OfTwoThatLeaveAMouthNoRoomTheNarrowerIsLost) {
  const LaidRivers laid = layRivers({lineOf({{-3000, 2050}, {-480, 2050}, {100, 2050}}, 105.0, "main"),
                                     lineOf({{-480, 2050}, {-180, 2100}, {100, 2140}, {200, 2150}}, 45.0, "branch")},
                                    sea(), {});
  ASSERT_EQ(laid.report.lost.size(), 1u);
  EXPECT_EQ(laid.report.lost[0].name, "'branch'");
  EXPECT_NEAR(areaOf(laid.grid), 105.0 * 3100.0, 105.0 * 300.0);
}

TEST(LayRivers, ALineWiderThanLongIsNamed) {
  const LaidRivers laid = layRivers({lineOf({{-3000, 2050}, {100, 2050}}, 1e5, "lake")}, sea(), {});
  ASSERT_EQ(laid.report.lost.size(), 1u);
  EXPECT_EQ(laid.report.lost[0].why, RiverLoss::Short);
}

TEST(LayRivers, TheNarrowerOfTwoThatOverlapIsLost) {
  const LaidRivers laid = layRivers({lineOf({{-3000, 2050}, {100, 2050}}, 200.0, "wide"),
                                     lineOf({{-3000, 2250}, {-1000, 2165}, {-800, 2350}, {100, 2400}}, 80.0, "narrow")},
                                    sea(), {});
  ASSERT_EQ(laid.report.lost.size(), 1u);
  EXPECT_EQ(laid.report.lost[0].why, RiverLoss::Crowded);
  EXPECT_EQ(laid.report.lost[0].name, "'narrow'");
}

TEST(LayRivers, ALineGivenTwiceIsNamed) {
  const LaidRivers laid = layRivers({lineOf({{-3000, 2050}, {100, 2050}}, 100.0, "first"),
                                     lineOf({{-3000, 2050}, {-1000, 2050}, {100, 2050}}, 100.0, "again")},
                                    sea(), {});
  EXPECT_EQ(laid.report.reaches, 1u);
  ASSERT_EQ(laid.report.lost.size(), 1u);
  EXPECT_EQ(laid.report.lost[0].why, RiverLoss::Within);
  EXPECT_EQ(laid.report.lost[0].name, "'again'");
}

TEST(LayRivers, ARiverThatComesCloseToItselfIsNarrowerThere) {
  // It comes back, and runs 80 m beside itself.
  const std::vector<Point> loop{{-3000, 2000}, {-1500, 2000}, {-1500, 3200}, {-700, 3200},
                                {-700, 2800},  {-1420, 2800}, {-1420, 2300}, {100, 2300}};
  const LaidRivers laid = layRivers({lineOf(loop, 100.0)}, sea(), {});
  EXPECT_EQ(laid.report.narrowed, 1u);
  EXPECT_TRUE(lossesOf(laid).empty());
  EXPECT_TRUE(triangleOverlaps(laid.grid, linkGrid(laid.grid).mesh).empty());
}

TEST(LayRivers, DepthsAreThoseOfTheLines) {
  RiverLine line = lineOf({{-3000, 2050}, {100, 2050}}, 100.0);
  line.depth_m = 3.5;
  const LaidRivers laid = layRivers({line}, sea(), {});
  EXPECT_THAT(laid.grid.z, ::testing::Each(-3.5));
  // The mesh has depths only where it is.
  for (std::size_t i = 0; i < laid.mesh_z.size(); ++i) {
    const Point& p = laid.grid.nodes[i];
    if (p.x < 0.0) {
      EXPECT_TRUE(std::isnan(laid.mesh_z[i]));
    }
    if (p.x > 0.0) {
      EXPECT_NEAR(laid.mesh_z[i], -10.0 - 0.25 * p.x + 0.125 * p.y, 1e-6);
    }
  }
}

TEST(LayRivers, LinesWithoutLengthAreErrors) {
  EXPECT_THROW(layRivers({lineOf({{-30, 20}, {-30, 20}}, 10.0)}, sea(), {}), InputError);
}

TEST(LayRivers, NoBorderOfFeaturesWindsThroughTheWaterBetweenRivers) {
  RiverOptions options;
  options.extent = RiverExtent::All;
  Grid grid = sea();
  LaidRivers laid = layRivers({lineOf({{300, 1000}, {3700, 1000}}, 60.0, "straight"),
                               lineOf({{600, 1000}, {1000, 1140}, {3000, 1140}, {3400, 1000}}, 60.0, "arm")},
                              grid, options);
  ASSERT_EQ(laid.report.junctions, 2u);
  const MergedMesh result = mergeMesh(grid, std::move(laid.grid), {});
  const TriMesh mesh = linkGrid(grid).mesh;
  for (TriId t = 0; t < mesh.triangles.size(); ++t)
    for (const EdgeRef across : mesh.triangles[t].adj) {
      if (across == kNone || result.triangles[t].mesh == 1 || result.triangles[triOf(across)].mesh == 1) continue;
      EXPECT_EQ(grid.feature_of[t], grid.feature_of[triOf(across)]);
    }
}

TEST(LayRivers, TooManyQuadrilateralsAreErrors) {
  const std::vector<RiverLine> lines{lineOf({{-3000, 2050}, {100, 2050}}, 100.0)};
  RiverOptions options;
  options.most_cell_width_m = 0.05;
  EXPECT_THROW(layRivers(lines, sea(), options), InputError);
  options = {};
  options.most_quads = 20;
  EXPECT_THROW(layRivers(lines, sea(), options), InputError);
}

// Random networks, in the water and beside it, make sound meshes.
TEST(LayRivers, MergedWithTheMeshTheyAreSound) {
  std::size_t merged = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> turn(0.0, 0.15);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::vector<RiverLine> lines;
    std::vector<Point> places;
    for (int i = 0; i < 3; ++i) {
      const double from_x = share(random), from_y = share(random), pick = share(random);
      Point p{-2000.0 * from_x, 4000.0 * from_y};
      if (i > 0) p = places[static_cast<std::size_t>(pick * static_cast<double>(places.size() - 1))];
      double heading = 6.3 * share(random);
      RiverLine& line = lines.emplace_back(lineOf({p}, 30.0 + 100.0 * share(random)));
      for (int k = 0; k < 40; ++k) {
        heading += turn(random);
        p = p + 80.0 * Point{std::cos(heading), std::sin(heading)};
        line.points.push_back(p);
        places.push_back(p);
      }
    }
    RiverOptions options;
    options.extent = seed % 2 == 0 ? RiverExtent::All : RiverExtent::Outside;
    options.cells = 1 + seed % 3;
    Grid grid = sea();
    LaidRivers laid = layRivers(lines, grid, options);
    if (laid.grid.triangles.empty()) continue;
    ++merged;
    const Grid rivers = laid.grid, before = grid;
    EXPECT_TRUE(triangleOverlaps(rivers, linkGrid(rivers).mesh).empty()) << "seed " << seed;
    for (const Quad& quad : quadsOf(rivers))
      for (const double angle : anglesOf(rivers, quad)) EXPECT_LT(angle, 180.0);
    const MergedMesh result = mergeMesh(grid, std::move(laid.grid), {});
    SCOPED_TRACE(seed);
    requireConsistent(grid);
    const LinkedGrid linked = linkGrid(grid);
    EXPECT_TRUE(linked.conflicts.empty());
    EXPECT_TRUE(triangleOverlaps(grid, linked.mesh).empty());
    EXPECT_EQ(quadsOf(grid).size(), quadsOf(rivers).size());
    std::set<VertexId> nodes;
    for (const std::vector<VertexId>& loop : boundaryLoops(linked.mesh))
      for (const VertexId v : loop) EXPECT_TRUE(nodes.insert(v).second) << "pinched";
  }
  EXPECT_GT(merged, 15u);
}

}  // namespace
}  // namespace coastmesh
