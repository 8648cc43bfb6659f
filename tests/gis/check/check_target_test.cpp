// Defects that models refuse, each planted in a mesh that they accept, and their repair.
#include "gis/check/check_target.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "core/quality.hpp"
#include "gis/check/flow_links.hpp"
#include "gis/crs/crs.hpp"
#include "gis/error.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/grid/geographic_nodes.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/model/assign_boundaries.hpp"
#include "gis/repair/repair_target.hpp"
#include "tests/gis/check/target_samples.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using testing::expectMended;
using testing::kAll;
using testing::Kinds;
using testing::kindsIn;
using testing::lattice;
using testing::openGrid;
using testing::soundGrid;
using testing::TemporaryFolder;

TEST(CheckTarget, FindsNothingInASoundGrid) {
  for (const Target target : kAll) {
    EXPECT_EQ(kindsIn(soundGrid(), target), Kinds{}) << kTargetNames[static_cast<std::size_t>(target)];
    Grid grid = soundGrid();
    EXPECT_TRUE(repairForTargets(grid, std::array{target}, {.min_angle_deg = 33.0}).repairs.empty());
    EXPECT_EQ(grid.nodes, soundGrid().nodes);
    EXPECT_EQ(grid.triangles, soundGrid().triangles);
  }
}

TEST(CheckTarget, BrokenEdge) {
  Grid grid = soundGrid();
  grid.triangles.push_back(grid.triangles[20]);
  for (const Target target : kAll) EXPECT_TRUE(kindsIn(grid, target).contains(TargetDefectKind::BrokenEdge));
}

TEST(CheckTarget, UnusedNode) {
  Grid grid = soundGrid();
  grid.nodes.push_back({-1e4, 3.0});
  grid.z.push_back(-20.0);
  for (const Target target : kAll) EXPECT_EQ(kindsIn(grid, target), Kinds{TargetDefectKind::UnusedNode});
  expectMended(grid, {Target::Schism});
}

TEST(CheckTarget, RepeatedNode) {
  Grid grid = soundGrid();
  const auto twin = static_cast<std::uint32_t>(grid.nodes.size());
  grid.nodes.push_back(Point(grid.nodes[20]));
  grid.z.push_back(-20.0);
  std::ranges::replace(
      *std::ranges::find_if(grid.triangles, [](const auto& t) { return std::ranges::count(t, 20u) > 0; }), 20u, twin);
  for (const Target target : kAll) EXPECT_TRUE(kindsIn(grid, target).contains(TargetDefectKind::RepeatedNode));
}

TEST(CheckTarget, HangingNode) {
  Grid grid = soundGrid();
  // The middle of an inner edge becomes a corner on one of its sides only.
  const auto corners = grid.triangles[40];
  const auto middle = static_cast<std::uint32_t>(grid.nodes.size());
  grid.nodes.push_back({(grid.nodes[corners[0]].x + grid.nodes[corners[1]].x) / 2.0,
                        (grid.nodes[corners[0]].y + grid.nodes[corners[1]].y) / 2.0});
  grid.z.push_back(-20.0);
  grid.triangles[40] = {corners[0], middle, corners[2]};
  grid.triangles.push_back({middle, corners[1], corners[2]});
  for (const Target target : kAll) EXPECT_TRUE(kindsIn(grid, target).contains(TargetDefectKind::HangingNode));
}

// The southern side runs along a parallel from 179.97 to -179.95.
TEST(CheckTarget, NothingHangsOnAnEdgeAcrossTheAntimeridian) {
  Grid grid = soundGrid();
  grid.crs = wgs84();
  for (Point& p : grid.nodes) {
    p = {179.97 + 1e-5 * p.x, 1e-5 * p.y};
    if (p.x > 180) p.x -= 360;
  }
  EXPECT_FALSE(kindsIn(grid, Target::Adcirc).contains(TargetDefectKind::HangingNode));
}

TEST(CheckTarget, PinchedNode) {
  const TriMesh mesh = lattice(
      6, 6, [](int i, int j) { return (i < 3) == (j < 3); },
      [](int i, int j) {
        return Point{1000.0 * i - 500.0 * j, 866.0 * j};
      });
  Grid grid;
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  grid.z.assign(grid.nodes.size(), -20.0);
  grid.boundaries = findBoundaries(mesh);
  for (const Target target : kAll) {
    EXPECT_TRUE(kindsIn(grid, target).contains(TargetDefectKind::PinchedNode));
    expectMended(grid, {target}, 1e5);
  }
}

// A node is duplicated in a round in which its triangles also need longer edges.
TEST(CheckTarget, PinchedNodeOfTrianglesThatMissTheStep) {
  const TriMesh mesh = lattice(
      9, 9, [](int i, int j) { return ((i / 3) + (j / 3)) % 2 == 0; },
      [](int i, int j) {
        return Point{1000.0 * i - 500.0 * j, 866.0 * j};
      });
  Grid grid;
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  grid.z.assign(grid.nodes.size(), -20.0);
  grid.boundaries = findBoundaries(mesh);
  repairForTargets(grid, std::array{Target::Adcirc}, {.time_step_s = 1000.0});
  EXPECT_EQ(kindsIn(grid, Target::Adcirc), Kinds{});
  EXPECT_EQ(checkTimeStep(grid, 1000.0).size(), grid.triangles.size());
}

TEST(CheckTarget, OrphanCell) {
  Grid grid = soundGrid();
  const auto first = static_cast<std::uint32_t>(grid.nodes.size());
  for (const Point& p : {Point{20000.0, 0.0}, Point{21000.0, 0.0}, Point{20500.0, 866.0}}) grid.nodes.push_back(p);
  grid.z.resize(grid.nodes.size(), -20.0);
  grid.triangles.push_back({first, first + 1, first + 2});
  grid.boundaries.push_back({BoundaryRole::Land, true, {first, first + 1, first + 2}});
  for (const Target target : kAll) {
    EXPECT_EQ(kindsIn(grid, target), Kinds{TargetDefectKind::OrphanCell});
    expectMended(grid, {target}, 433001.0);
  }
}

TEST(CheckTarget, NothingLeftIsAnError) {
  Grid grid = soundGrid();
  grid.nodes = {{0.0, 0.0}, {1000.0, 0.0}, {500.0, 866.0}, {20000.0, 0.0}, {21000.0, 0.0}, {20500.0, 866.0}};
  grid.z.assign(grid.nodes.size(), -20.0);
  grid.triangles = {{0, 1, 2}, {3, 4, 5}};
  grid.boundaries = {{BoundaryRole::Land, true, {0, 1, 2}}, {BoundaryRole::Land, true, {3, 4, 5}}};
  EXPECT_THROW(repairForTargets(grid, std::array{Target::Fvcom}), InputError);
}

TEST(CheckTarget, UnknownDepth) {
  Grid grid = soundGrid();
  grid.z[7] = std::numeric_limits<double>::quiet_NaN();
  for (const Target target : kAll) EXPECT_EQ(kindsIn(grid, target), Kinds{TargetDefectKind::UnknownDepth});
}

TEST(CheckTarget, SegmentsOfNodes) {
  for (const Target target : {Target::Adcirc, Target::Schism}) {
    Grid grid = openGrid();
    EXPECT_EQ(kindsIn(grid, target), Kinds{});

    Grid lacks = grid;
    lacks.boundaries.pop_back();
    EXPECT_EQ(kindsIn(lacks, target), Kinds{TargetDefectKind::NoBoundary});
    expectMended(lacks, {target});

    Grid turned = grid;
    std::ranges::reverse(turned.boundaries[0].nodes);
    EXPECT_EQ(kindsIn(turned, target), Kinds{TargetDefectKind::BoundaryTurned});
    expectMended(turned, {target});

    Grid twice = grid;
    twice.boundaries.push_back(Boundary(twice.boundaries[0]));
    EXPECT_EQ(kindsIn(twice, target), Kinds{TargetDefectKind::BoundaryTwice});
    expectMended(twice, {target});

    Grid off = grid;
    off.boundaries[0].nodes.erase(off.boundaries[0].nodes.begin() + 1);
    EXPECT_EQ(kindsIn(off, target), (Kinds{TargetDefectKind::NoBoundary, TargetDefectKind::StrayBoundary}));
    expectMended(off, {target});

    Grid shore = grid;
    for (Boundary& boundary : shore.boundaries)
      if (boundary.role == BoundaryRole::Island) boundary.role = BoundaryRole::Land;
    EXPECT_EQ(kindsIn(shore, target), Kinds{TargetDefectKind::WrongShore});
    expectMended(shore, {target});
  }
}

// Counts and loops as files state them.
TEST(CheckTarget, WhatFilesSayOfThemselves) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& edited) {
    std::ofstream(folder / "hgrid.gr3") << edited;
    return readGrid(folder / "hgrid.gr3");
  };
  const std::string square = "square\n2 4\n1 0 0 5\n2 1000 0 5\n3 1000 1000 5\n4 0 1000 5\n1 3 1 2 3\n2 3 1 3 4\n";
  const std::string sound =
      square + "1 = open\n2 = nodes\n2 = of it\n1\n2\n1 = land\n4 = nodes\n4 0 = of it\n2\n3\n4\n1\n";
  EXPECT_EQ(kindsIn(read(sound), Target::Schism), Kinds{});
  const std::string wrong_sum = square + "1\n3\n2\n1\n2\n1\n4\n4 0\n2\n3\n4\n1\n";
  EXPECT_EQ(kindsIn(read(wrong_sum), Target::Schism), Kinds{TargetDefectKind::WrongCount});
  const std::string wrong_land_sum = square + "1\n2\n2\n1\n2\n1\n5\n4 0\n2\n3\n4\n1\n";
  EXPECT_EQ(kindsIn(read(wrong_land_sum), Target::Adcirc), Kinds{TargetDefectKind::WrongCount});
  const std::string open_loop = square + "1\n5\n5\n1\n2\n3\n4\n1\n0\n0\n";
  EXPECT_EQ(kindsIn(read(open_loop), Target::Schism), Kinds{TargetDefectKind::LoopedBoundary});
  const std::string one_shore = square + "0\n0\n1\n5\n5 0\n1\n2\n3\n4\n1\n";
  EXPECT_EQ(kindsIn(read(one_shore), Target::Schism), Kinds{TargetDefectKind::LoopedBoundary});
  const std::string island = square + "0\n0\n1\n4\n4 1\n1\n2\n3\n4\n";
  EXPECT_EQ(kindsIn(read(island), Target::Schism), Kinds{TargetDefectKind::WrongShore});
  for (const std::string& wrong : {wrong_sum, wrong_land_sum, open_loop, one_shore, island}) {
    Grid grid = read(wrong);
    EXPECT_TRUE(repairForTargets(grid, std::array{Target::Schism}).left.empty());
    StagedOutput output(folder / "mended.gr3", gridFormatFor("mended.gr3"), true);
    output.write(grid);
    output.commit();
    EXPECT_EQ(kindsIn(readGrid(folder / "mended.gr3"), Target::Schism), Kinds{});
  }
}

// The corner of a square: both its edges belong to one triangle.
Grid corner(bool both_open) {
  const TriMesh mesh = lattice(
      4, 4, [](int, int) { return true; },
      [](int i, int j) {
        return Point{1000.0 * (4 - i), 1000.0 * j};
      });
  Grid grid;
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back({t.v[1], t.v[0], t.v[2]});
  grid.z.assign(grid.nodes.size(), -20.0);
  grid.boundaries = cutLoops(grid, boundaryLoops(grid), [&](std::uint32_t a, std::uint32_t b) {
    const auto on = [&](double Point::*axis) { return grid.nodes[a].*axis == 0.0 && grid.nodes[b].*axis == 0.0; };
    return BoundaryKind{on(&Point::y) || (both_open && on(&Point::x)) ? BoundaryRole::Open : BoundaryRole::Land};
  });
  return grid;
}

TEST(CheckTarget, TwoOpenEdges) {
  EXPECT_TRUE(kindsIn(corner(true), Target::Fvcom).contains(TargetDefectKind::TwoOpenEdges));
  EXPECT_FALSE(kindsIn(corner(true), Target::Adcirc).contains(TargetDefectKind::TwoOpenEdges));
  expectMended(corner(true), {Target::Fvcom});
}

TEST(CheckTarget, OpenAndSolid) {
  EXPECT_TRUE(kindsIn(corner(false), Target::Fvcom).contains(TargetDefectKind::OpenAndSolid));
  expectMended(corner(false), {Target::Fvcom});
}

// A channel of one row of triangles, open in the south, and in the north as well or a shore.
Grid channel(bool open_north) {
  const TriMesh mesh = lattice(
      8, 1, [](int, int) { return true; },
      [](int i, int j) {
        return Point{1000.0 * i - 500.0 * j, 866.0 * j};
      });
  Grid grid = testing::gridOf(mesh);
  grid.z.assign(grid.nodes.size(), -20.0);
  grid.boundaries = cutLoops(grid, boundaryLoops(grid), [&](std::uint32_t a, std::uint32_t b) {
    const double from = grid.nodes[a].y, to = grid.nodes[b].y;
    return BoundaryKind{from == to && (open_north || from == 0.0) ? BoundaryRole::Open : BoundaryRole::Land};
  });
  return grid;
}

TEST(CheckTarget, OpenEdgeThatFacesTheShore) {
  const Grid grid = channel(false);
  // Of eight triangles with open edges, the first has no shore but that node.
  EXPECT_EQ(std::ranges::count(checkTarget(grid, Target::Fvcom), TargetDefectKind::OpenAndSolid, &TargetDefect::kind),
            8);
  EXPECT_FALSE(kindsIn(grid, Target::Fvcom).contains(TargetDefectKind::OpenBridge));
  EXPECT_FALSE(kindsIn(grid, Target::Adcirc).contains(TargetDefectKind::OpenAndSolid));
  expectMended(grid, {Target::Fvcom});
}

TEST(CheckTarget, InnerEdgeBetweenOpenNodes) {
  const Grid grid = channel(true);
  EXPECT_EQ(std::ranges::count(checkTarget(grid, Target::Fvcom), TargetDefectKind::OpenBridge, &TargetDefect::kind),
            16);
  EXPECT_FALSE(kindsIn(grid, Target::Adcirc).contains(TargetDefectKind::OpenBridge));
  expectMended(grid, {Target::Fvcom});
}

// FVCOM accepts a triangle with two edges of the shore, but the level between them never changes.
TEST(CheckTarget, OneNeighbourIsAdviceForFvcom) {
  const auto corners = [](const Grid& grid) {
    const std::vector<TargetDefect> defects = checkTarget(grid, Target::Fvcom);
    for (const TargetDefect& defect : defects) EXPECT_TRUE(defect.advice) << toString(defect.kind);
    return std::ranges::count(defects, TargetDefectKind::OneNeighbour, &TargetDefect::kind);
  };
  Grid grid = soundGrid();
  ASSERT_EQ(corners(grid), 2);
  // Angles of 60 degrees cannot be divided: the corners stay, without an error.
  EXPECT_TRUE(repairForTargets(grid, std::array{Target::Fvcom}, {.min_angle_deg = 33.0}).left.empty());
  EXPECT_EQ(corners(grid), 2);
  EXPECT_TRUE(repairForTargets(grid, std::array{Target::Fvcom}, {.min_angle_deg = 29.0}).left.empty());
  EXPECT_EQ(corners(grid), 0);
}

TEST(CheckTarget, LoneWall) {
  Grid grid = soundGrid();
  grid.boundaries = cutLoops(grid, boundaryLoops(grid), [&](std::uint32_t a, std::uint32_t b) {
    const bool south = grid.nodes[a].y == 0.0 && grid.nodes[b].y == 0.0;
    const bool wall = std::min(grid.nodes[a].x, grid.nodes[b].x) == 3000.0;
    return BoundaryKind{south && !wall ? BoundaryRole::Open : BoundaryRole::Land};
  });
  for (const Target target : {Target::Fvcom, Target::Telemac, Target::Mike}) {
    EXPECT_TRUE(kindsIn(grid, target).contains(TargetDefectKind::LoneWall));
    expectMended(grid, {target});
  }
}

// A wall of two edges has a single solid node, which TELEMAC refuses between liquid ones; a wall of three has two.
TEST(CheckTarget, OneSolidNodeBetweenOpenings) {
  for (const double length : {2000.0, 3000.0}) {
    Grid grid = soundGrid();
    grid.boundaries = cutLoops(grid, boundaryLoops(grid), [&](std::uint32_t a, std::uint32_t b) {
      const bool south = grid.nodes[a].y == 0.0 && grid.nodes[b].y == 0.0;
      const double west = std::min(grid.nodes[a].x, grid.nodes[b].x);
      const bool wall = west >= 2000.0 && west < 2000.0 + length;
      return BoundaryKind{south && !wall ? BoundaryRole::Open : BoundaryRole::Land};
    });
    EXPECT_FALSE(kindsIn(grid, Target::Fvcom).contains(TargetDefectKind::LoneWall));
    EXPECT_EQ(kindsIn(grid, Target::Telemac).contains(TargetDefectKind::LoneWall), length == 2000.0);
    if (length == 2000.0) expectMended(grid, {Target::Telemac});
  }
}

// A fan of `cells` triangles around an inner node, surrounded by a ring of squares.
Grid fan(int cells) {
  Grid grid;
  grid.nodes.push_back({0.0, 0.0});
  for (const double radius : {1000.0, 1900.0})
    for (int k = 0; k < cells; ++k)
      grid.nodes.push_back({radius * std::cos(2.0 * M_PI * k / cells), radius * std::sin(2.0 * M_PI * k / cells)});
  const auto n = static_cast<std::uint32_t>(cells);
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t a = 1 + k, b = 1 + (k + 1) % n;
    grid.triangles.push_back({0, a, b});
    grid.triangles.push_back({a, a + n, b + n});
    grid.triangles.push_back({a, b + n, b});
  }
  grid.z.assign(grid.nodes.size(), -20.0);
  std::vector<EdgeConflict> conflicts;
  grid.boundaries = findBoundaries(linkTriangles(grid.nodes, grid.triangles, conflicts));
  return grid;
}

TEST(CheckTarget, Valence) {
  for (const int cells : {11, 12, 14}) {
    EXPECT_TRUE(kindsIn(fan(cells), Target::Swan).contains(TargetDefectKind::Valence)) << cells;
    expectMended(fan(cells), {Target::Swan});
  }
  Grid three = soundGrid();
  const auto [a, b, c] = three.triangles[50];
  const auto middle = static_cast<std::uint32_t>(three.nodes.size());
  three.nodes.push_back({(three.nodes[a].x + three.nodes[b].x + three.nodes[c].x) / 3.0,
                         (three.nodes[a].y + three.nodes[b].y + three.nodes[c].y) / 3.0});
  three.z.push_back(-20.0);
  three.triangles[50] = {a, b, middle};
  three.triangles.push_back({b, c, middle});
  three.triangles.push_back({c, a, middle});
  EXPECT_EQ(kindsIn(three, Target::Swan), Kinds{TargetDefectKind::Valence});
  expectMended(three, {Target::Swan});
  EXPECT_FALSE(kindsIn(fan(8), Target::Swan).contains(TargetDefectKind::Valence));
}

TEST(CheckTarget, LargeAngle) {
  Grid grid = soundGrid();
  // A node moved towards an edge makes an angle of more than 143 degrees.
  grid.nodes[30].y += 760.0;
  ASSERT_TRUE(kindsIn(grid, Target::Swan).contains(TargetDefectKind::LargeAngle));
  expectMended(grid, {Target::Swan});
}

// Models differ in whether they use differences in longitude as they are.
TEST(CheckTarget, RoundTheGlobe) {
  Grid past = soundGrid();
  past.crs = wgs84();
  for (Point& p : past.nodes) p = {179.98 + p.x * 1e-5, p.y * 1e-5};
  Grid jumping = past;
  for (Point& p : jumping.nodes)
    if (p.x > 180.0) p.x -= 360.0;
  const auto count = std::ranges::count_if(jumping.triangles, [&](const auto& corners) {
    const auto [west, east] =
        std::minmax({jumping.nodes[corners[0]].x, jumping.nodes[corners[1]].x, jumping.nodes[corners[2]].x});
    return east - west > 180.0;
  });
  ASSERT_GT(count, 0);
  for (const Target target : kAll) {
    const bool minds = target == Target::Adcirc || target == Target::Telemac || target == Target::Swan;
    EXPECT_EQ(std::ranges::count(checkTarget(jumping, target), TargetDefectKind::RoundTheGlobe, &TargetDefect::kind),
              minds ? count : 0);
    EXPECT_EQ(kindsIn(past, target), Kinds{});
  }
}

// Around a pole, longitudes must jump somewhere.
TEST(CheckTarget, RoundThePole) {
  Grid grid;
  grid.crs = wgs84();
  grid.nodes = {{0.0, 80.0}, {120.0, 80.0}, {-120.0, 80.0}, {0.0, 90.0}};
  grid.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  EXPECT_FALSE(kindsIn(grid, Target::Schism).contains(TargetDefectKind::RoundTheGlobe));
  for (const Target target : {Target::Adcirc, Target::Telemac, Target::Swan}) {
    std::size_t jumps = 0;
    for (const TargetDefect& defect : checkTarget(grid, target)) {
      if (defect.kind != TargetDefectKind::RoundTheGlobe) continue;
      ++jumps;
      EXPECT_EQ(defect.triangle, 1);
      EXPECT_EQ(defect.advice, target == Target::Adcirc);
    }
    EXPECT_EQ(jumps, 1u);
  }
}

// At 75 degrees north, where a degree of longitude is a quarter of one of latitude.
TEST(CheckTarget, SwanMeasuresAnglesOfDegreesAsIfTheyWereAPlane) {
  Grid grid = soundGrid();
  grid.crs = wgs84();
  for (Point& p : grid.nodes) p = {p.x * 1e-5 / std::cos(75.0 * M_PI / 180.0), 75.0 + p.y * 1e-5};
  // Equilateral on the ground: 60 degrees at the top become 2 atan(tan(30) / cos(75)) = 131.7, and 70 become 139.4.
  EXPECT_EQ(kindsIn(grid, Target::Swan), Kinds{});
  grid.nodes[30].y -= 260e-5;
  EXPECT_EQ(kindsIn(grid, Target::Swan), Kinds{TargetDefectKind::LargeAngle});
  for (const TargetDefect& defect : checkTarget(grid, Target::Swan)) {
    const auto& [a, b, c] = grid.triangles[static_cast<std::size_t>(defect.triangle)];
    const auto on_paper = anglesDeg(grid.nodes[a], grid.nodes[b], grid.nodes[c]);
    EXPECT_NEAR(defect.value, std::ranges::max(on_paper), 1e-9);
    const double narrow = std::cos(75.0 * M_PI / 180.0);
    const auto on_ground = [&](std::uint32_t node) { return Point{grid.nodes[node].x * narrow, grid.nodes[node].y}; };
    EXPECT_LT(std::ranges::max(anglesDeg(on_ground(a), on_ground(b), on_ground(c))), 110.0);
  }
  expectMended(grid, {Target::Swan});
  // The reverse: equilateral in degrees, with angles of 17 and 81.5 degrees on the ground.
  Grid flat = soundGrid();
  flat.crs = wgs84();
  for (Point& p : flat.nodes) p = {p.x * 1e-5, 75.0 + p.y * 1e-5};
  EXPECT_EQ(kindsIn(flat, Target::Swan), Kinds{});
}

// Two of the rhombus' corners have both their edges in one triangle.
TEST(CheckTarget, OneNeighbourIsTooFewForFesom) {
  const Grid grid = soundGrid();
  const std::vector<TargetDefect> found = checkTarget(grid, Target::Fesom);
  ASSERT_EQ(found.size(), 2u);
  for (const TargetDefect& defect : found) {
    EXPECT_EQ(defect.kind, TargetDefectKind::OneNeighbour);
    const auto& v = grid.triangles[static_cast<std::size_t>(defect.triangle)];
    int neighbours = 0;
    for (const auto& other : grid.triangles) {
      const auto shared = std::ranges::count_if(other, [&](std::uint32_t node) { return std::ranges::count(v, node); });
      neighbours += shared == 2;
    }
    EXPECT_EQ(neighbours, 1);
  }
  expectMended(grid, {Target::Fesom});
}

TEST(CheckTarget, FesomsPartitionerHasRoomForSoManyTriangles) {
  EXPECT_FALSE(kindsIn(fan(32), Target::Fesom).contains(TargetDefectKind::Valence));
  EXPECT_TRUE(kindsIn(fan(33), Target::Fesom).contains(TargetDefectKind::Valence));
  expectMended(fan(33), {Target::Fesom});
}

// Latitudes are on a sphere, whatever the ellipsoid: at 60 degrees, a degree of longitude is half of one of latitude.
// Angles are those of the flat triangle, which add up to 180.
TEST(CheckTarget, MpasMeasuresAnglesOnItsSphere) {
  for (const double lon : {10.0, 179.99}) {
    for (const double off : {-1e-4, 1e-4}) {
      Grid grid;
      grid.crs = wgs84();
      // On the ground, the northern corner has 90 degrees if it is half as far from the base as the base is long.
      const double half = 0.02;
      grid.nodes = {{lon - half, 60.0}, {lon + half, 60.0}, {lon, 60.0 + half * 0.5 + off}};
      if (lon + half > 180.0) grid.nodes[1].x -= 360.0;
      grid.triangles = {{0, 1, 2}};
      const bool obtuse = off < 0;
      EXPECT_EQ(kindsIn(grid, Target::Mpas).contains(TargetDefectKind::LargeAngle), obtuse) << lon << ' ' << off;
      // The place is at the triangle, not on the other side of the Earth.
      for (const TargetDefect& defect : checkTarget(grid, Target::Mpas))
        EXPECT_NEAR(std::remainder(defect.place.x - lon, 360.0), 0.0, 0.1);
    }
  }
  // With a node at the pole, the others are far apart in longitude. The chords of an octant have 60 degrees in each
  // corner.
  EXPECT_NEAR(largestSphereAngle({0, 0}, {90, 0}, {123, 90}), 60.0, 1e-12);
  EXPECT_NEAR(largestSphereAngle({170, 80}, {-170, 80}, {0, 90}), 80.03844190190964, 1e-9);
}

// MPAS' file holds meshes of any CRS on the sphere. Equilateral triangles of an equal-area CRS are obtuse there, and
// the other way round.
TEST(CheckTarget, MpasMeasuresProjectedMeshesOnItsSphere) {
  for (const bool sound_on_sphere : {false, true}) {
    Grid grid = soundGrid();
    if (sound_on_sphere) {  // at 55 degrees north
      const double scale = std::cos(55.0 * std::numbers::pi / 180.0);
      for (Point& p : grid.nodes) p = {p.x / scale, 5'200'000.0 + p.y * scale};
    }
    grid.crs = parseCrs(sound_on_sphere ? "+proj=cea +lat_ts=0 +datum=WGS84" : "+proj=cea +lat_ts=50 +datum=WGS84");
    EXPECT_EQ(kindsIn(grid, Target::Mpas).contains(TargetDefectKind::LargeAngle), !sound_on_sphere);
    const RepairReport report = repairForTargets(grid, std::array{Target::Mpas});
    EXPECT_EQ(report.repairs.empty(), sound_on_sphere);
    Grid geographic = grid;
    const std::vector<Point> lonlat = geographicNodes(grid);
    geographic.nodes.assign(lonlat.begin(), lonlat.end());
    geographic.crs = wgs84();
    EXPECT_EQ(checkTarget(geographic, Target::Mpas).size(), report.left.size());
    EXPECT_EQ(checkTarget(grid, Target::Mpas).size(), report.left.size());
  }
}

TEST(CheckTarget, ObtuseTrianglesAreMendedForMpas) {
  Grid grid = soundGrid();
  grid.nodes[30].y += 400.0;
  ASSERT_EQ(kindsIn(grid, Target::Mpas), Kinds{TargetDefectKind::LargeAngle});
  expectMended(grid, {Target::Mpas});
}

TEST(CheckTarget, SmallFlowLink) {
  // Circumcentres are the middles of the hypotenuses: those of a square's two triangles coincide.
  EXPECT_NEAR(flowLinkAcross({0, 0}, {4, 4}, {0, 4}, {4, 0}).length, 0.0, 1e-12);
  // Cocircular, too, though one triangle is obtuse: models may keep its centre inside it, or not.
  EXPECT_NEAR(flowLinkAcross({3, 4}, {-3, 4}, {0, -5}, {0, 5}).length, 0.0, 1e-12);
  // Equilateral with sides of 2: centres 2 / sqrt(3) apart, areas sqrt(3).
  EXPECT_NEAR(flowLinkAcross({0, 0}, {2, 0}, {1, std::sqrt(3.0)}, {1, -std::sqrt(3.0)}).length,
              2.0 / std::sqrt(3.0) / std::pow(3.0, 0.25), 1e-12);
  Grid grid = soundGrid();
  // Gives two neighbouring triangles right angles, with their corners on a circle around the middle of the common edge.
  const auto [a, b, c] = grid.triangles[50];
  const Point middle{(grid.nodes[b].x + grid.nodes[c].x) / 2.0, (grid.nodes[b].y + grid.nodes[c].y) / 2.0};
  for (const auto& corners : grid.triangles) {
    if (std::ranges::count(corners, b) == 0 || std::ranges::count(corners, c) == 0) continue;
    Point& apex = grid.nodes[*std::ranges::find_if(corners, [&](std::uint32_t n) { return n != b && n != c; })];
    const double nearer = 1.0 / std::sqrt(3.0);
    apex = {middle.x + nearer * (apex.x - middle.x), middle.y + nearer * (apex.y - middle.y)};
  }
  EXPECT_EQ(kindsIn(grid, Target::Dflowfm), Kinds{TargetDefectKind::SmallFlowLink});
  for (const Target target : {Target::Adcirc, Target::Schism, Target::Swan})
    EXPECT_FALSE(kindsIn(grid, target).contains(TargetDefectKind::SmallFlowLink));
  expectMended(grid, {Target::Dflowfm});
  const std::size_t nodes = grid.nodes.size();
  const RepairReport report = repairForTargets(grid, std::array{Target::Dflowfm});
  EXPECT_EQ(grid.nodes.size(), nodes);  // moving is enough
  EXPECT_EQ(report.repairs.front().what, "node moved");
}

// Nodes on the boundary and on lines do not move.
TEST(CheckTarget, NoRepairMovesABoundaryOrALine) {
  Grid grid = corner(false);  // squares cut in two: each diagonal is a flow link of length 0
  grid.lines = {{LineKind::Constraint, "dam", false, {}}};
  for (std::uint32_t node = 0; node < grid.nodes.size(); ++node)
    if (grid.nodes[node].x == 2000.0) grid.lines[0].nodes.push_back(node);
  std::ranges::sort(grid.lines[0].nodes, {}, [&](std::uint32_t node) { return grid.nodes[node].y; });
  requireConsistent(grid);
  const Grid before = grid;
  const RepairReport report = repairForTargets(grid, std::array{Target::Dflowfm});
  EXPECT_TRUE(report.left.empty());
  bool any_moved = false;
  for (std::size_t node = 0; node < before.nodes.size(); ++node) {
    const Point& p = before.nodes[node];
    const bool fixed = p.x == 0.0 || p.x == 2000.0 || p.x == 4000.0 || p.y == 0.0 || p.y == 4000.0;
    any_moved = any_moved || grid.nodes[node] != p;
    if (fixed) {
      EXPECT_EQ(grid.nodes[node], p);
    }
  }
  EXPECT_TRUE(any_moved);
  for (const std::uint32_t node : grid.lines[0].nodes) EXPECT_EQ(grid.nodes[node].x, 2000.0);
}

TEST(CheckTarget, Orthogonality) {
  // In acute triangles, the line between the circumcentres is perpendicular to the edge.
  EXPECT_NEAR(flowLinkAcross({0, 0}, {2, 0}, {1, std::sqrt(3.0)}, {1, -std::sqrt(3.0)}).cosine, 0.0, 1e-12);
  EXPECT_NEAR(flowLinkAcross({0, 0}, {4, 0}, {1, 3}, {3, -3}).cosine, 0.0, 1e-12);  // acute, not equilateral
  Grid grid = soundGrid();
  grid.nodes[30].y += 760.0;
  ASSERT_TRUE(kindsIn(grid, Target::Dflowfm).contains(TargetDefectKind::NotOrthogonal));
  expectMended(grid, {Target::Dflowfm});
}

TEST(CheckTarget, OpeningsAreUnderWater) {
  Grid grid = openGrid();
  const auto open = std::ranges::find(grid.boundaries, BoundaryRole::Open, &Boundary::role);
  ASSERT_NE(open, grid.boundaries.end());
  // Two consecutive nodes at the end of the opening, near land.
  const std::uint32_t first = open->nodes.at(0), second = open->nodes.at(1);
  grid.z[first] = 3.0;
  grid.z[second] = 0.5;
  for (const Target target : kAll) {
    const bool minds = target != Target::Swan && target != Target::Dflowfm && target != Target::Mpas;
    EXPECT_EQ(kindsIn(grid, target).contains(TargetDefectKind::DryOpening), minds);
  }
  Grid mended = grid;
  const RepairReport report = repairForTargets(mended, std::array{Target::Adcirc});
  EXPECT_EQ(report.repairs.size(), 2u);
  EXPECT_EQ(kindsIn(mended, Target::Adcirc), Kinds{});
  EXPECT_LT(mended.z[first], 0.0);
  EXPECT_LT(mended.z[second], 0.0);
  // Elsewhere, nodes above the water are land that may flood.
  grid.z[first] = grid.z[second] = -5.0;
  grid.z[40] = 3.0;
  EXPECT_EQ(kindsIn(grid, Target::Adcirc), Kinds{});
}

TEST(CheckTarget, Courant) {
  // sqrt(9.81 * 22) is 14.7 m/s; edges are a kilometre.
  EXPECT_EQ(kindsIn(soundGrid(), Target::Adcirc, {50.0}), Kinds{});
  EXPECT_EQ(kindsIn(soundGrid(), Target::Adcirc, {100.0}), Kinds{TargetDefectKind::Courant});
  EXPECT_EQ(kindsIn(soundGrid(), Target::Schism, {100.0}), Kinds{});
  EXPECT_EQ(kindsIn(soundGrid(), Target::Schism, {20.0}), Kinds{TargetDefectKind::Courant});
  // On flats that are hardly under water they are small at any size.
  Grid flat = soundGrid();
  std::ranges::fill(flat.z, -0.9);
  EXPECT_EQ(kindsIn(flat, Target::Schism, {20.0}), Kinds{});
  flat.z[0] = -1.1;
  EXPECT_EQ(kindsIn(flat, Target::Schism, {20.0}), Kinds{TargetDefectKind::Courant});
  // The worst first. SCHISM, TELEMAC and D-Flow FM run nevertheless, so that theirs is advice.
  for (const Target target : {Target::Adcirc, Target::Fvcom, Target::Telemac, Target::Dflowfm, Target::Schism}) {
    const bool from_below = target == Target::Schism;
    std::vector<TargetDefect> found = checkTarget(soundGrid(), target, {from_below ? 20.0 : 100.0});
    std::erase_if(found, [](const TargetDefect& defect) { return defect.kind != TargetDefectKind::Courant; });
    ASSERT_FALSE(found.empty());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].advice, target != Target::Adcirc && target != Target::Fvcom);
      if (i == 0) continue;
      EXPECT_TRUE(from_below ? found[i].value >= found[i - 1].value : found[i].value <= found[i - 1].value);
    }
  }
}

// Angles and areas of changed triangles are measured again; features are kept.
TEST(CheckTarget, RepairKeepsWhatTrianglesTell) {
  Grid grid = corner(true);
  grid.feature_of.assign(grid.triangles.size(), 0);
  grid.features = {{7, {}, {}}};
  grid.min_angle_deg.assign(grid.triangles.size(), 45.0);
  grid.area_m2.assign(grid.triangles.size(), 5e5);
  repairForTargets(grid, std::array{Target::Fvcom});
  ASSERT_EQ(grid.feature_of.size(), grid.triangles.size());
  ASSERT_EQ(grid.min_angle_deg.size(), grid.triangles.size());
  double area = 0.0;
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    const auto& [a, b, c] = grid.triangles[t];
    const auto angles = anglesDeg(grid.nodes[a], grid.nodes[b], grid.nodes[c]);
    EXPECT_NEAR(grid.min_angle_deg[t], std::ranges::min(angles), 1e-9);
    area += grid.area_m2[t];
  }
  EXPECT_NEAR(area, 16e6, 1.0);
}

// Between two shores with pairs of nodes; the edges that join the pairs at its ends are in no list.
TEST(CheckTarget, TheEndsOfAWeirAreItsOwn) {
  const auto isWater = [](int i, int j) { return j != 3 || i < 2 || i > 5; };
  const TriMesh mesh = lattice(8, 7, isWater, [](int i, int j) { return Point{1000.0 * i, 1000.0 * j}; });
  Grid grid;
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  for (Boundary& boundary : findBoundaries(mesh))
    if (boundary.role == BoundaryRole::Land) grid.boundaries.push_back(std::move(boundary));
  Boundary weir{BoundaryRole::Land, false, {}, 24};
  for (std::uint32_t i = 2; i <= 6; ++i) {
    weir.nodes.push_back(3 * 9 + i);
    weir.back_nodes.push_back(4 * 9 + i);
    for (const double value : {1.5, 1.0, 1.0}) weir.weir.push_back(value);
  }
  std::ranges::reverse(weir.nodes);
  std::ranges::reverse(weir.back_nodes);
  grid.boundaries.push_back(weir);
  EXPECT_EQ(kindsIn(grid, Target::Adcirc), Kinds{});
  // The shore across is part of it too.
  grid.boundaries.back().back_nodes.clear();
  EXPECT_EQ(kindsIn(grid, Target::Adcirc), Kinds{TargetDefectKind::NoBoundary});
}

// Nodes joined by a weir cannot be separated, so meshes with weirs are not repaired.
TEST(Targets, DefectsOfAMeshWithWeirsAreNamedAndCountsAreNone) {
  Grid grid = soundGrid();
  grid.boundaries.back().weir = {1.0, 1.0, 1.0};
  grid.notes = {"NVEL is 38, but the land segments have 45 nodes"};
  EXPECT_FALSE(checkTarget(grid, Target::Adcirc).empty());
  const Grid before = grid;
  EXPECT_TRUE(repairForTargets(grid, std::array{Target::Adcirc}).repairs.empty());
  EXPECT_EQ(grid.nodes, before.nodes);
  grid.nodes.push_back({100.0, -5000.0});
  grid.z.push_back(-20.0);
  try {
    repairForTargets(grid, std::array{Target::Adcirc});
    FAIL() << "the node that is in no triangle was taken out";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("1 in all, the first at 100, -5000: unused node"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace coastmesh
