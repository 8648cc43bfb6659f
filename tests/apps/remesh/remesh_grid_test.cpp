#include "apps/remesh/remesh_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "gis/error.hpp"
#include "gis/fields/plain_field.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "parallel/recorder.hpp"
#include "parallel/workers.hpp"
#include "tests/apps/remesh/remeshed.hpp"
#include "tests/gis/globe_samples.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using namespace coastmesh::testing;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A square lattice with boundaries, and depths that are linear.
Grid sea(
    int cells, const std::function<bool(int, int)>& wanted = [](int, int) { return true; }) {
  const TriMesh mesh = lattice(cells, cells, wanted);
  Grid grid;
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  for (const Point& p : grid.nodes) grid.z.push_back(-10.0 - 0.25 * p.x + 0.125 * p.y);
  grid.boundaries = findBoundaries(mesh);
  return grid;
}

// The mean length of edges between new nodes, and nodes at most `reach` from a place.
double meanEdgeNear(const Grid& grid, const Point& place, double reach) {
  double sum = 0.0, count = 0.0;
  for (const GridCorners& v : grid.triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      const Point a = grid.nodes[v[i]], b = grid.nodes[v[(i + 1) % 3]];
      if (distance(midpoint(a, b), place) > reach) continue;
      sum += distance(a, b);
      count += 1.0;
    }
  }
  return sum / count;
}

double leastAngle(const Grid& grid, const RemeshReport& report) {
  double least = 180.0;
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    if (report.replaced.triangles[t] != kNone) continue;
    const GridCorners& v = grid.triangles[t];
    least = std::min(least, leastAngleDeg(grid.nodes[v[0]], grid.nodes[v[1]], grid.nodes[v[2]]));
  }
  return least;
}

TEST(RemeshGrid, MakesAPartFiner) {
  const Grid before = sea(40);
  Grid after = before;
  const Flags taken = middlesInBox(before, 10.0, 10.0, 30.0, 30.0);
  const RemeshReport report = remeshGrid(after, taken, ofSize(0.25));
  expectRemeshed(before, taken, after, report);
  EXPECT_EQ(report.patches, 1u);
  EXPECT_EQ(report.replaced.triangles_removed, 798u);  // at two corners one sticks out with two sides
  EXPECT_EQ(report.tidied.teeth, 2u);
  EXPECT_GE(leastAngle(after, report), 30.0);
  EXPECT_EQ(report.below_bounds, 0u);
  EXPECT_NEAR(meanEdgeNear(after, {20.0, 20.0}, 4.0), 0.25, 0.03);
  // In between, sizes fall at the rate of the gradation.
  EXPECT_NEAR(report.rim.width_m, (1.138 - 0.25) / 0.3, 0.05);
  EXPECT_NEAR(meanEdgeNear(after, {20.0, 11.5}, 0.5), 1.138 - 0.3 * 1.5, 0.15);
  for (std::size_t n = 0; n < after.nodes.size(); ++n) {
    const Point& p = after.nodes[n];
    EXPECT_NEAR(after.z[n], -10.0 - 0.25 * p.x + 0.125 * p.y, 1e-12);
  }
}

TEST(RemeshGrid, MakesAPartCoarser) {
  const Grid before = sea(60);
  Grid after = before;
  const Flags taken = middlesInBox(before, 10.0, 10.0, 50.0, 50.0);
  const RemeshReport report = remeshGrid(after, taken, ofSize(5.0));
  expectRemeshed(before, taken, after, report);
  EXPECT_LT(after.triangles.size(), before.triangles.size() - 2000);
  EXPECT_EQ(report.below_bounds, 0u);
  EXPECT_NEAR(meanEdgeNear(after, {30.0, 30.0}, 8.0), 5.0, 0.7);
}

TEST(RemeshGrid, BoundariesKeepTheirNodesAndTypes) {
  // The part has a piece of the shore, of the open boundary, and of the island.
  const Grid before = sampleGrid(Crs{}, {100.0, 200.0}, 10.0, 12);
  Grid after = before;
  const Flags taken = middlesInBox(before, 0.0, 180.0, 175.0, 262.0);
  const RemeshReport report = remeshGrid(after, taken, ofSize(2.0));
  expectRemeshed(before, taken, after, report);
  EXPECT_GT(report.replaced.boundary_nodes, 20u);
  EXPECT_GT(after.boundaries[0].nodes.size(), before.boundaries[0].nodes.size() + 10);
}

TEST(RemeshGrid, AllOfAGrid) {
  const Grid before = sampleGrid(Crs{}, {100.0, 200.0}, 10.0, 6);
  Grid after = before;
  const Flags taken(before.triangles.size(), 1);
  const RemeshReport report = remeshGrid(after, taken, ofSize(3.0));
  expectRemeshed(before, taken, after, report);
  EXPECT_EQ(report.patches, 2u);
  EXPECT_EQ(report.outside.triangles, 0u);
  EXPECT_EQ(report.rim.share, 0.0);
}

TEST(RemeshGrid, ProgressIsOfAllPartsTogetherAndOnlyGrows) {
  Grid grid = sea(60);
  Flags taken = middlesInBox(grid, 5.0, 5.0, 25.0, 25.0);
  const Flags other = middlesInBox(grid, 35.0, 35.0, 55.0, 55.0);
  for (std::size_t t = 0; t < taken.size(); ++t) taken[t] |= other[t];
  std::vector<double> shares;
  withThreads({4}, [&] {
    Recorder recorder;
    const RunControl control{{}, [&shares](double share) { shares.push_back(share); }};
    EXPECT_EQ(remeshGrid(grid, taken, ofSize(0.1), control, recorder.loop("test")).patches, 2u);
  });
  ASSERT_GT(shares.size(), 10u);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_GE(shares.front(), 0.0);
  EXPECT_LT(shares.front(), 0.1);
  EXPECT_GT(shares.back(), 0.5);
  EXPECT_LE(shares.back(), 1.0);
}

TEST(RemeshGrid, PartsRoundAnIslandAndWithHoles) {
  const Grid before = sea(40, [](int i, int j) { return !(i >= 18 && i < 22 && j >= 18 && j < 22); });
  for (const int hole : {0, 1, 2}) {
    Grid after = before;
    Flags taken = middlesInBox(before, 8.0, 8.0, 32.0, 32.0);
    // A ring round the island that does not touch it; holes of triangles that stay.
    const auto leaveOut = [&](double west, double south, double east, double north) {
      const Flags left = middlesInBox(before, west, south, east, north);
      for (std::size_t t = 0; t < taken.size(); ++t)
        if (left[t] != 0) taken[t] = 0;
    };
    if (hole == 1) leaveOut(15.0, 15.0, 25.0, 25.0);
    if (hole == 2) {
      leaveOut(10.0, 10.0, 13.0, 13.0);
      leaveOut(13.0, 13.0, 16.0, 16.0);  // touches the first in a node
      leaveOut(26.0, 20.0, 27.0, 21.0);
    }
    const RemeshReport report = remeshGrid(after, taken, ofSize(0.5));
    expectRemeshed(before, taken, after, report);
    EXPECT_EQ(report.below_bounds, 0u) << hole;
    EXPECT_EQ(report.replaced.boundary_nodes > 0, hole != 1);
  }
}

TEST(RemeshGrid, WeirsStayAsTheyAre) {
  // A wall of two shores, four nodes long, and a line.
  Grid before = sea(20);
  Boundary wall{BoundaryRole::Land, false, {}, 24};
  std::vector<std::uint32_t> inner;
  for (std::uint32_t i = 8; i <= 12; ++i) wall.nodes.push_back(10 * 21 + i);
  // Triangles above the wall get nodes of their own along it.
  for (std::size_t k = 0; k < wall.nodes.size(); ++k) {
    const std::uint32_t node = wall.nodes[k];
    const bool is_end = k == 0 || k + 1 == wall.nodes.size();
    if (is_end) {
      wall.back_nodes.push_back(node);
      continue;
    }
    const auto across = static_cast<std::uint32_t>(before.nodes.size());
    before.nodes.push_back(before.nodes[node] + Point{0.0, 0.125});
    before.z.push_back(before.z[node]);
    for (GridCorners& v : before.triangles) {
      const double y = (before.nodes[v[0]].y + before.nodes[v[1]].y + before.nodes[v[2]].y) / 3.0;
      if (y < 10.0) continue;
      std::ranges::replace(v, node, across);
    }
    wall.back_nodes.push_back(across);
  }
  std::ranges::reverse(wall.nodes);  // the mesh is to the left of the lower shore
  std::ranges::reverse(wall.back_nodes);
  for (std::size_t k = 0; k < wall.nodes.size(); ++k) wall.weir.insert(wall.weir.end(), {2.0 + double(k), 1.0, 1.0});
  before.boundaries.push_back(wall);
  GridLine line{LineKind::Constraint, "pipe", false, {}};
  for (std::uint32_t i = 5; i <= 15; ++i) line.nodes.push_back(5 * 21 + i);
  before.lines.push_back(line);
  requireConsistent(before);
  for (const double size : {0.3, 3.0}) {
    Grid after = before;
    const Flags taken = middlesInBox(before, 3.0, 3.0, 17.0, 17.0);
    const RemeshReport report = remeshGrid(after, taken, ofSize(size));
    expectRemeshed(before, taken, after, report);
    EXPECT_EQ(report.whole_edges, 8u);
    EXPECT_EQ(after.boundaries.back().nodes.size(), wall.nodes.size());
    EXPECT_EQ(report.replaced.line_nodes > 0, size < 1.0);
  }
}

TEST(RemeshGrid, SizesFollowFromShoresOutsideThePart) {
  const Grid before = sea(40);
  Grid after = before;
  const Flags taken = middlesInBox(before, 5.0, 5.0, 35.0, 35.0);
  RemeshOptions options;
  options.sizes.shore_m = 0.2;
  options.sizes.shore_rate = 0.05;
  options.sizes.most_m = 4.0;
  const RemeshReport report = remeshGrid(after, taken, options);
  expectRemeshed(before, taken, after, report);
  EXPECT_TRUE(report.has_shore);
  EXPECT_NEAR(meanEdgeNear(after, {20.0, 12.0}, 1.5), 0.2 + 0.05 * 12.0, 0.12);
}

TEST(RemeshGrid, SizesFollowFromTheCoastWithinAFloodPlain) {
  Grid before = sea(40);  // land from x = 20 on
  for (std::size_t i = 0; i < before.nodes.size(); ++i) before.z[i] = before.nodes[i].x > 20.0 ? 3.0 : -3.0;
  const Flags taken = middlesInBox(before, 5.0, 5.0, 35.0, 35.0);
  RemeshOptions options;
  options.sizes.shore_m = 0.3;
  options.sizes.most_m = 3.0;
  Grid unknown = before;
  EXPECT_GT(remeshGrid(unknown, taken, options).land_unknown, 100u);
  EXPECT_GT(meanEdgeNear(unknown, {20.0, 20.0}, 1.5), 1.5);

  std::vector<std::uint8_t> land;
  for (const Point& p : before.nodes) land.push_back(p.x > 20.0 ? 1 : 0);
  markPlain(before, land);
  Grid after = before;
  const RemeshReport report = remeshGrid(after, taken, options);
  EXPECT_EQ(report.land_unknown, 0u);
  EXPECT_LT(meanEdgeNear(after, {20.0, 20.0}, 1.0), 0.6);
  EXPECT_GT(meanEdgeNear(after, {12.0, 20.0}, 1.0), 0.8);
  EXPECT_GT(meanEdgeNear(after, {30.0, 20.0}, 1.0), 0.8);
  // Sizes of other kinds take no notice of it.
  Grid even = before;
  remeshGrid(even, taken, ofSize(3.0));
  EXPECT_GT(meanEdgeNear(even, {20.0, 20.0}, 1.5), 1.5);
}

TEST(RemeshGrid, ShoresOfSmallEdgesAreApproached) {
  // At a shore of edges of length 1, with 5 asked for.
  const Grid before = sea(30);
  Grid after = before;
  const Flags taken = middlesInBox(before, 0.0, 0.0, 30.0, 15.0);
  const RemeshReport report = remeshGrid(after, taken, ofSize(5.0));
  expectRemeshed(before, taken, after, report);
  EXPECT_EQ(report.below_bounds, 0u);
}

TEST(RemeshGrid, IsTheSameOnAnyNumberOfThreads) {
  const Grid before = sampleGrid(parseCrs("EPSG:4326"), {12.3, 45.6}, 0.01, 12);
  Grid one = before, many = before;
  Flags taken(before.triangles.size(), 0);
  for (std::size_t t = 0; t < taken.size(); ++t) taken[t] = t % 50 < 42 ? 1 : 0;
  remeshGrid(one, taken, ofSize(150.0));
  withThreads({4}, [&] {
    Recorder recorder;
    remeshGrid(many, taken, ofSize(150.0), {}, recorder.loop("remesh"));
  });
  EXPECT_EQ(one.nodes, many.nodes);
  EXPECT_EQ(one.triangles, many.triangles);
  EXPECT_EQ(one.z, many.z);
}

TEST(RemeshGrid, DegreesAndOtherValues) {
  for (const double west : {12.3, 179.9, -180.05}) {
    Grid before = inParts(sampleGrid(parseCrs("EPSG:4326"), {west, 45.6}, 0.01, 12));
    if (west == 179.9)  // longitudes that jump
      for (Point& p : before.nodes)
        if (p.x > 180.0) p.x -= 360.0;
    for (std::uint32_t t = 0; t < before.triangles.size(); ++t) before.piece_of.push_back(t % 5);
    for (const Point& p : before.nodes) before.size_m.push_back(100.0 * p.y);
    Grid after = before;
    Flags taken(before.triangles.size(), 0);
    for (std::size_t t = 0; t < taken.size() / 2; ++t) taken[t] = 1;
    const RemeshReport report = remeshGrid(after, taken, ofSize(200.0));
    requireConsistent(after);
    EXPECT_TRUE(report.replaced.partition_dropped);
    EXPECT_THAT(after.part_of, IsEmpty());
    EXPECT_THAT(after.node_part_of, IsEmpty());
    ASSERT_EQ(after.z.size(), after.nodes.size());
    double least = 1e9, greatest = -1e9, least_before = 1e9, greatest_before = -1e9;
    for (const Point& p : before.nodes)
      least_before = std::min(least_before, p.x), greatest_before = std::max(greatest_before, p.x);
    for (std::size_t n = 0; n < after.nodes.size(); ++n) {
      least = std::min(least, after.nodes[n].x), greatest = std::max(greatest, after.nodes[n].x);
      EXPECT_TRUE(std::isfinite(after.z[n]));
      EXPECT_TRUE(std::isfinite(after.size_m[n]));
      if (report.replaced.nodes[n] != kNone) {
        EXPECT_EQ(after.nodes[n], before.nodes[report.replaced.nodes[n]]);
      }
    }
    if (west != 179.9) {
      EXPECT_GE(least, least_before);
      EXPECT_LE(greatest, greatest_before);
    } else {
      EXPECT_GE(least, -180.0);
      EXPECT_LE(greatest, 180.0);
    }
    double area = 0.0;
    for (const double a : after.area_m2) {
      EXPECT_GT(a, 0.0);
      area += a;
    }
    for (const double a : before.area_m2) area -= a;
    EXPECT_NEAR(area, 0.0, 1e-6 * 1e9);
    for (std::size_t t = 0; t < after.triangles.size(); ++t)
      if (report.replaced.triangles[t] == kNone) {
        EXPECT_GT(after.min_angle_deg[t], 15.0);
        EXPECT_EQ(after.piece_of[t], 5u);
      }
    EXPECT_NEAR(report.inside.min_angle_deg, *std::ranges::min_element(after.min_angle_deg), 30.0);
  }
}

TEST(RemeshGrid, RandomParts) {
  std::mt19937_64 random(7);
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  int grown = 0;
  for (int run = 0; run < 60; ++run) {
    const Grid before = sampleGrid(Crs{}, {100.0, 200.0}, 10.0, 10);
    Flags taken(before.triangles.size(), 0);
    const int boxes = 1 + run % 4;
    for (int k = 0; k < boxes; ++k) {
      const double west = uniform(90.0, 300.0), south = uniform(190.0, 290.0);
      // One after the other: compilers evaluate arguments in different orders.
      const double height = uniform(20.0, 80.0), width = uniform(20.0, 120.0);
      const Flags box = middlesInBox(before, west, south, west + width, south + height);
      for (std::size_t t = 0; t < taken.size(); ++t) taken[t] = taken[t] ^ box[t];
    }
    // In every other run ragged edges, and single triangles.
    for (std::uint8_t& flag : taken)
      if (run % 2 == 1 && random() % 20 == 0) flag ^= 1;
    if (std::ranges::count(taken, 1) == 0) continue;
    Grid after = before;
    const double size = std::exp(uniform(std::log(2.0), std::log(40.0)));
    SCOPED_TRACE(::testing::Message() << "run " << run << ", size " << size);
    const RemeshReport report = remeshGrid(after, taken, ofSize(size));
    expectRemeshed(before, taken, after, report);
    // Triangles that stay would leave no room for that in some of these parts.
    EXPECT_GT(leastAngle(after, report), 32.9);
    EXPECT_EQ(report.below_bounds, 0u);
    grown += report.taken_in > 0 ? 1 : 0;
  }
  EXPECT_GT(grown, 20);
}

TEST(RemeshGrid, SingleTrianglesWithinThePartGoToo) {
  const Grid before = sea(20);
  Grid after = before;
  Flags taken = middlesInBox(before, 5.0, 5.0, 15.0, 15.0);
  const auto at = [&](double x, double y) {
    for (std::size_t t = 0; t < taken.size(); ++t)
      if (middlesInBox(before, x, y, x + 0.5, y + 0.5)[t] != 0) return t;
    return taken.size();
  };
  taken[at(8.5, 8.0)] = 0;
  // Of two that stay together none goes.
  taken[at(12.5, 12.0)] = taken[at(12.0, 12.5)] = 0;
  const RemeshReport report = remeshGrid(after, taken, ofSize(0.5));
  expectRemeshed(before, taken, after, report);
  EXPECT_EQ(report.taken_in, 1u);
  EXPECT_EQ(report.below_bounds, 0u);
}

TEST(RemeshGrid, LargePartsAreNotMeshedAgain) {
  const Grid before = sampleGrid(Crs{}, {100.0, 200.0}, 10.0, 10);
  std::mt19937_64 random(41);
  std::size_t taken_in = 0, at_once = 0;
  for (int run = 0; run < 10; ++run) {
    Flags taken = middlesInBox(before, 100.0, 200.0, 180.0, 280.0);
    for (std::uint8_t& flag : taken)
      if (random() % 10 == 0) flag ^= 1;
    RemeshOptions options = ofSize(4.0);
    Grid after = before;
    taken_in += remeshGrid(after, taken, options).taken_in;
    options.most_again = 50;
    after = before;
    const RemeshReport report = remeshGrid(after, taken, options);
    expectRemeshed(before, taken, after, report);
    at_once += report.taken_in;
  }
  EXPECT_GT(taken_in, at_once);
}

// Parts of which what is left out has to be beyond the plane: around a pole, in several places, or land alone.
TEST(RemeshGrid, MoreThanAHemisphere) {
  const auto noneLeftOut = [](const SpaceVector&) { return true; };
  const auto seasAndLands = [](const SpaceVector& p) { return !(p[0] > 0.8 || p[2] < -0.9 || p[0] + p[1] < -1.3); };
  const auto all = [](const Point&) { return true; };
  const auto south = [](const Point& p) { return p.y < 70.0; };
  const auto north = [](const Point& p) { return p.y > -5.0; };
  const auto between = [](const Point& p) { return std::abs(p.y) < 60.0; };
  const auto restOf = [](const Point& p) { return std::abs(p.x - 100.0) > 25.0 || std::abs(p.y) > 30.0; };
  const std::vector<std::pair<Grid, std::function<bool(const Point&)>>> parts{
      {octahedralGlobe(4, noneLeftOut), south},   {octahedralGlobe(4, noneLeftOut), north},
      {octahedralGlobe(4, noneLeftOut), between}, {octahedralGlobe(4, noneLeftOut), restOf},
      {octahedralGlobe(4, seasAndLands), all},    {octahedralGlobe(4, seasAndLands), between}};
  for (std::size_t k = 0; k < parts.size(); ++k) {
    SCOPED_TRACE(k);
    const auto& [before, isTaken] = parts[k];
    Grid after = before;
    Flags taken;
    for (std::uint32_t t = 0; t < before.triangles.size(); ++t) taken.push_back(isTaken(middleOf(before, t)) ? 1 : 0);
    const RemeshReport report = remeshGrid(after, taken, ofSize(400e3));
    requireConsistent(after);
    EXPECT_GT(report.replaced.triangles_added, 900u);
    for (const auto& [edge, count] : edgeCounts(after)) EXPECT_EQ(count, 1) << edge[0] << " " << edge[1];
    double area = 0.0;
    for (const double a : triangleAreas(after.nodes, after.triangles, after.crs)) {
      EXPECT_GT(a, 0.0);
      area += a;
    }
    for (const double a : triangleAreas(before.nodes, before.triangles, before.crs)) area -= a;
    // Edges of shores are divided in the plane.
    EXPECT_LT(std::abs(area), 5e-4 * 5e14);
    EXPECT_EQ(after.boundaries.size(), before.boundaries.size());
  }
}

TEST(RemeshGrid, RefusesWhatCannotBeMeshed) {
  Grid globe = octahedralGlobe(3, [](const SpaceVector&) { return true; });
  try {
    remeshGrid(globe, Flags(globe.triangles.size(), 1), ofSize(1e6));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a whole globe"));
  }
  Grid grid = sea(10);
  grid.triangles.push_back(grid.triangles[100]);
  const Flags taken(grid.triangles.size(), 1);
  try {
    remeshGrid(grid, taken, ofSize(0.5));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("check finds such edges"));
  }
  grid = sea(10);
  std::swap(grid.triangles[0][1], grid.triangles[0][2]);
  EXPECT_THROW(remeshGrid(grid, Flags(grid.triangles.size(), 1), ofSize(0.5)), InputError);
  grid = sea(10);
  for (GridCorners& v : grid.triangles) std::swap(v[1], v[2]);
  try {
    remeshGrid(grid, Flags(grid.triangles.size(), 1), ofSize(0.5));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("clockwise"));
  }
}

}  // namespace
}  // namespace coastmesh
