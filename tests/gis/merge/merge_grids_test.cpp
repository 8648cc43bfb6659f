#include "gis/merge/merge_grids.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "core/union_find.hpp"
#include "gis/cut/cut_grid.hpp"
#include "gis/error.hpp"
#include "tests/gis/merge/merged.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

using namespace coastmesh::testing;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Merges, and checks what has to hold for all grids.
MergeReport mergeAndCheck(Grid& grid, const Grid& inserted) {
  const Grid before = grid;
  const MergeReport report = mergeGrids(grid, Grid(inserted));
  expectMerged(before, inserted, grid, report.nodes, report.triangles);
  EXPECT_EQ(report.gap, static_cast<std::size_t>(std::ranges::count(report.triangles, kNone, &MergeSource::mesh)));
  return report;
}

Grid basin() { return gridOf({20, 20}); }

std::vector<std::uint8_t> middlesWhere(const Grid& grid, const std::function<bool(const Point&)>& isIn) {
  std::vector<std::uint8_t> taken;
  for (const GridCorners& v : grid.triangles)
    taken.push_back(isIn(centroid(grid.nodes[v[0]], grid.nodes[v[1]], grid.nodes[v[2]])) ? 1 : 0);
  return taken;
}

TEST(MergeGrids, AFinerMeshInTheMidst) {
  Grid grid = basin();
  const Grid before = grid;
  const Grid fine = gridOf({16, 12, 0.3, {7.3, 6.4}, 0.2}, BoundaryRole::Open);
  const MergeReport report = mergeAndCheck(grid, fine);
  EXPECT_NEAR(areaOf(grid), areaOf(before), 1e-9);
  EXPECT_EQ(report.joined, 56u);  // all around
  EXPECT_EQ(report.walls, 0u);
  EXPECT_EQ(report.cut_off, 0u);
  EXPECT_EQ(report.united, 0u);
  EXPECT_TRUE(report.has_open);
  EXPECT_GT(report.covered, 30u);
  EXPECT_EQ(shoresOf(grid), shoresOf(before));
  EXPECT_THAT(openOf(grid), IsEmpty());
}

TEST(MergeGrids, ACoarserMeshInTheMidst) {
  Grid grid = gridOf({40, 40, 0.5});
  const Grid coarse = gridOf({3, 4, 2.5, {5.1, 6.2}, 0.1}, BoundaryRole::Open);
  const MergeReport report = mergeAndCheck(grid, coarse);
  EXPECT_NEAR(areaOf(grid), 400.0, 1e-9);
  EXPECT_EQ(report.joined, 14u);
}

TEST(MergeGrids, RandomPlacesInTheMidst) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int run = 0; run < 60; ++run) {
    Grid grid = basin();
    Squares squares;
    squares.length = 0.2 + 1.5 * share(random);
    squares.columns = 1 + static_cast<int>(6.0 * share(random) / squares.length);
    squares.rows = 1 + static_cast<int>(6.0 * share(random) / squares.length);
    squares.turn = 2.0 * std::numbers::pi * share(random);
    squares.corner.x = 10.0 + share(random);
    squares.corner.y = 10.0 + share(random);
    SCOPED_TRACE(run);
    const Grid inserted = gridOf(squares, BoundaryRole::Open);
    const MergeReport report = mergeAndCheck(grid, inserted);
    EXPECT_NEAR(areaOf(grid), 400.0, 1e-9);
    EXPECT_EQ(report.joined, 2u * static_cast<unsigned>(squares.columns + squares.rows));
  }
}

TEST(MergeGrids, RandomPlacesAcrossTheShore) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int run = 0; run < 80; ++run) {
    // Two islands, and a shore all around.
    Grid grid = gridOf({20, 20, 1.0, {}, 0.0, [](int x, int y) {
                          return !((x >= 4 && x < 7 && y >= 4 && y < 6) || (x >= 12 && x < 14 && y >= 9 && y < 15));
                        }});
    Squares squares;
    squares.length = 0.3 + 1.2 * share(random);
    squares.columns = 2 + static_cast<int>(8.0 * share(random) / squares.length);
    squares.rows = 2 + static_cast<int>(8.0 * share(random) / squares.length);
    squares.turn = 2.0 * std::numbers::pi * share(random);
    squares.corner.x = 20.0 * share(random);
    squares.corner.y = 20.0 * share(random);
    const Grid inserted = gridOf(squares, BoundaryRole::Open);
    SCOPED_TRACE(run);
    const double before = areaOf(grid);
    const MergeReport report = mergeAndCheck(grid, inserted);
    EXPECT_GE(report.joined, 1u);
    // Nowhere are there both, and little is lost or won where shores are connected.
    EXPECT_LE(areaOf(grid), before + areaOf(inserted) + 2.0);
    EXPECT_GE(areaOf(grid), before - 2.0);
  }
}

TEST(MergeGrids, AtACoast) {
  // The inserted mesh has a coast of its own in the west, a little off the other's.
  Grid grid = basin();
  Grid bay = gridOf({10, 14, 0.5, {0.2, 5.1}});
  openWhere(bay, [](const Point& p) { return p.x > 0.3; });
  const std::set<std::array<double, 4>> coast = shoresOf(bay);
  ASSERT_EQ(coast.size(), 14u);
  const MergeReport report = mergeAndCheck(grid, bay);
  EXPECT_EQ(report.joined + report.walls, 34u);
  EXPECT_LE(report.walls, 2u);
  EXPECT_THAT(openOf(grid), IsEmpty());
  const std::set<std::array<double, 4>> shores = shoresOf(grid);
  EXPECT_TRUE(std::ranges::includes(shores, coast));
  ASSERT_EQ(grid.boundaries.size(), 1u);  // one shore, closed
  EXPECT_TRUE(grid.boundaries[0].closed);
  EXPECT_NEAR(areaOf(grid), 400.0, 4.0);
}

TEST(MergeGrids, KeepsOpenBoundariesAndTypes) {
  Grid grid = basin();
  openWhere(grid, [](const Point& p) { return p.y > 19.9 || p.y < 0.1; });
  ASSERT_EQ(grid.boundaries.size(), 4u);
  for (Boundary& boundary : grid.boundaries)
    if (boundary.role == BoundaryRole::Land) boundary.ibtype = 0;
  std::vector<std::vector<std::uint32_t>> open;
  for (const Boundary& boundary : grid.boundaries)
    if (boundary.role == BoundaryRole::Open) open.push_back(boundary.nodes);
  const Grid before = grid;
  Grid bay = gridOf({10, 14, 0.5, {0.2, 5.1}});
  openWhere(bay, [](const Point& p) { return p.x > 0.3; });
  for (Boundary& boundary : bay.boundaries)
    if (boundary.role == BoundaryRole::Land) boundary.ibtype = 10;
  const MergeReport report = mergeAndCheck(grid, bay);
  EXPECT_EQ(openOf(grid), openOf(before));
  std::size_t of_10 = 0;
  for (const Boundary& boundary : grid.boundaries) {
    if (boundary.ibtype == 10) of_10 += edgesOf(boundary).size();
    if (boundary.role == BoundaryRole::Land) {
      EXPECT_TRUE(boundary.ibtype == 0 || boundary.ibtype == 10 || boundary.nodes.size() <= 3) << boundary.ibtype;
    }
  }
  EXPECT_EQ(of_10, 14u);
  // Open boundaries are in their order.
  std::vector<std::vector<Point>> now, then;
  for (const Boundary& boundary : grid.boundaries)
    if (boundary.role == BoundaryRole::Open) now.push_back({grid.nodes[boundary.nodes.front()]});
  for (const std::vector<std::uint32_t>& nodes : open) then.push_back({before.nodes[nodes.front()]});
  EXPECT_EQ(now, then);
}

TEST(MergeGrids, AcrossAnOpenBoundary) {
  // The inserted mesh goes on beyond the sea in the north: what is left of its open boundary stays open.
  Grid grid = basin();
  openWhere(grid, [](const Point& p) { return p.y > 19.9; });
  const Grid beyond = gridOf({10, 12, 0.5, {6.1, 17.2}}, BoundaryRole::Open);
  const MergeReport report = mergeAndCheck(grid, beyond);
  EXPECT_EQ(report.walls, 0u);
  EXPECT_LT(report.joined, 24u);
  EXPECT_GT(report.joined, 15u);
  const std::set<std::array<double, 4>> open = openOf(grid);
  EXPECT_GT(std::ranges::count_if(open, [](const auto& edge) { return edge[1] > 23.1 && edge[3] > 23.1; }), 9);
  for (const std::array<double, 4>& edge : shoresOf(grid)) EXPECT_LE(std::max(edge[1], edge[3]), 20.0);
  EXPECT_EQ(std::ranges::count(grid.boundaries, BoundaryRole::Open, &Boundary::role), 1);
}

TEST(MergeGrids, IslandsOfTheInsertedMeshStay) {
  Grid grid = basin();
  Grid fine = gridOf({16, 16, 0.4, {6.0, 7.0}, 0.0, [](int x, int y) { return !(x > 4 && x < 10 && y > 5 && y < 9); }});
  openWhere(fine, [](const Point& p) { return p.x < 6.1 || p.x > 12.3 || p.y < 7.1 || p.y > 13.3; });
  mergeAndCheck(grid, fine);
  EXPECT_NEAR(areaOf(grid), 400.0 - 15.0 * 0.16, 1e-9);
  EXPECT_EQ(std::ranges::count(grid.boundaries, BoundaryRole::Island, &Boundary::role), 1);
}

TEST(MergeGrids, WaterInAnOpenHoleIsTheGrids) {
  Grid grid = basin();
  const Grid ring = [] {
    Grid made = gridOf({16, 16, 0.6, {5.1, 5.2}, 0.0, [](int x, int y) { return x < 5 || x > 10 || y < 5 || y > 10; }});
    openWhere(made, [](const Point&) { return true; });
    return made;
  }();
  const MergeReport report = mergeAndCheck(grid, ring);
  EXPECT_EQ(report.joined, 64u + 24u);
  EXPECT_NEAR(areaOf(grid), 400.0, 1e-9);
}

TEST(MergeGrids, AnOpenHoleOfTheGridIsFilled) {
  const auto inHole = [](int x, int y) { return x >= 6 && x < 14 && y >= 5 && y < 12; };
  const auto withHole = [&](BoundaryRole role) {
    Grid grid = gridOf({20, 20, 1.0, {}, 0.0, [&](int x, int y) { return !inHole(x, y); }});
    EXPECT_EQ(grid.boundaries.size(), 2u);
    grid.boundaries[1].role = role;
    return grid;
  };
  // Smaller than the hole, and across its edge.
  for (const Point& corner : {Point{8.1, 6.7}, Point{4.2, 6.7}}) {
    Grid grid = withHole(BoundaryRole::Open);
    const MergeReport report = mergeAndCheck(grid, gridOf({7, 6, 0.6, corner, 0.1}, BoundaryRole::Open));
    EXPECT_NEAR(areaOf(grid), 400.0, 1e-9);
    EXPECT_EQ(report.joined, 26u);
    EXPECT_EQ(grid.boundaries.size(), 1u);
  }
  // An island stays one.
  Grid island = withHole(BoundaryRole::Island);
  EXPECT_THROW(mergeGrids(island, gridOf({7, 6, 0.6, {8.1, 6.7}, 0.1}, BoundaryRole::Open)), InputError);
}

TEST(MergeGrids, WithoutOpenBoundariesItJoinsAllAround) {
  Grid grid = basin();
  const MergeReport report = mergeAndCheck(grid, gridOf({16, 12, 0.3, {7.3, 6.4}, 0.2}));
  EXPECT_FALSE(report.has_open);
  EXPECT_EQ(report.joined, 56u);
  EXPECT_NEAR(areaOf(grid), 400.0, 1e-9);
  EXPECT_EQ(grid.boundaries.size(), 1u);
}

TEST(MergeGrids, APartIsPutBack) {
  Grid grid = inParts(sampleGrid(Crs{}, {100.0, 200.0}, 10.0, 12));
  const Grid before = grid;
  const auto taken = middlesWhere(grid, [](const Point& p) { return p.x < 175.0 && p.y < 262.0; });
  Grid part = grid;
  cutGrid(part, taken);
  ASSERT_LT(part.triangles.size(), grid.triangles.size() / 2);
  const MergeReport report = mergeGrids(grid, Grid(part));
  EXPECT_EQ(report.gap, 0u);
  EXPECT_EQ(report.covered, part.triangles.size());
  EXPECT_TRUE(report.partition_dropped);
  EXPECT_EQ(trianglesOf(grid), trianglesOf(before));
  EXPECT_EQ(openOf(grid), openOf(before));
  EXPECT_EQ(shoresOf(grid), shoresOf(before));
  EXPECT_EQ(grid.nodes.size(), before.nodes.size());
  double sum = 0.0, sum_before = 0.0;
  for (const double z : grid.z) sum += z;
  for (const double z : before.z) sum_before += z;
  EXPECT_NEAR(sum, sum_before, 1e-9 * std::abs(sum_before));
}

// A sea in the north with islands, some of them thin, and no two edges alike.
Grid unevenSea(std::mt19937& random) {
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  std::set<std::pair<int, int>> dry;
  for (int k = 0; k < 14; ++k) dry.emplace(1 + 2 * (random() % 9), 1 + 2 * (random() % 9));  // apart
  Grid grid = gridOf({20, 20, 1.0, {}, 0.0, [&](int x, int y) { return !dry.contains({x, y}); }});
  openWhere(grid, [](const Point& p) { return p.y > 19.9; });
  for (Point& p : grid.nodes) {
    if (p.x > 0.0 && p.x < 20.0) p.x += 0.22 * share(random);
    if (p.y > 0.0 && p.y < 20.0) p.y += 0.22 * share(random);
  }
  return grid;
}

std::multiset<std::pair<BoundaryRole, std::size_t>> lengthsOf(const Grid& grid) {
  std::multiset<std::pair<BoundaryRole, std::size_t>> lengths;
  for (const Boundary& boundary : grid.boundaries) lengths.emplace(boundary.role, edgesOf(boundary).size());
  return lengths;
}

TEST(MergeGrids, APartFitsIntoTheRestAndIntoTheWhole) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Grid whole = unevenSea(random);
    std::uniform_real_distribution<double> place(3.0, 17.0), radius(3.0, 7.0);
    const Point middle{place(random), place(random)};
    const double r = radius(random);
    const auto isIn = [&](const Point& p) { return distance(p, middle) < r; };
    Grid part = whole, rest = whole;
    cutGrid(part, middlesWhere(whole, isIn));
    cutGrid(rest, middlesWhere(whole, [&](const Point& p) { return !isIn(p); }));
    ASSERT_EQ(part.triangles.size() + rest.triangles.size(), whole.triangles.size());
    for (const Grid& into : {rest, whole}) {
      Grid grid = into;
      const MergeReport report = mergeAndCheck(grid, part);
      EXPECT_EQ(report.gap, 0u);
      EXPECT_EQ(report.walls, 0u);
      EXPECT_EQ(trianglesOf(grid), trianglesOf(whole));
      EXPECT_EQ(openOf(grid), openOf(whole));
      EXPECT_EQ(shoresOf(grid), shoresOf(whole));
      EXPECT_EQ(lengthsOf(grid), lengthsOf(whole));
    }
  }
}

TEST(MergeGrids, AnOpeningThatIsTheGridsOwnStaysDivided) {
  Grid grid = basin();
  openWhere(grid, [](const Point& p) { return p.y > 19.9; });
  const auto at = std::ranges::find(grid.boundaries, BoundaryRole::Open, &Boundary::role);
  ASSERT_NE(at, grid.boundaries.end());
  Boundary half = *at;  // two of them, which meet in the midst
  at->nodes.resize(11);
  half.nodes.erase(half.nodes.begin(), half.nodes.begin() + 10);
  grid.boundaries.push_back(half);
  Grid part = grid;
  cutGrid(part, middlesWhere(grid, [](const Point& p) { return p.x < 10.0; }));
  const Grid whole = grid;
  mergeAndCheck(grid, part);
  EXPECT_EQ(std::ranges::count(grid.boundaries, BoundaryRole::Open, &Boundary::role), 2);
  EXPECT_EQ(lengthsOf(grid), lengthsOf(whole));
}

TEST(MergeGrids, AnOpeningAtTheCoastOfTheGridBecomesLand) {
  // The inserted mesh reaches a little or far beyond the coast in the west, where it has an opening of one edge.
  const auto openInTheWest = [](double beyond, std::size_t& walls) {
    Grid grid = basin();
    Grid bay = gridOf({12, 14, 0.5, {-beyond, 5.1}});
    const auto isOfFrame = [&](const Point& p) { return p.x > 0.0; };
    openWhere(bay, [&](const Point& p) { return isOfFrame(p) || (p.x < 0.01 - beyond && p.y > 8.1 && p.y < 8.6); });
    walls = mergeAndCheck(grid, bay).walls;
    return std::ranges::count(grid.boundaries, BoundaryRole::Open, &Boundary::role);
  };
  std::size_t walls = 0;
  EXPECT_EQ(openInTheWest(0.1, walls), 0);
  EXPECT_EQ(walls, 1u);
  EXPECT_EQ(openInTheWest(3.0, walls), 1);
  EXPECT_EQ(walls, 0u);
}

TEST(MergeGrids, PartsSideBySide) {
  // Neither has the teeth along the diagonal: they are filled.
  const Grid whole = basin();
  Grid west = whole, east = whole;
  const auto cutTidily = [&](Grid& grid, std::vector<std::uint8_t> taken) {
    tidyCut(linkGrid(whole).mesh, {}, taken);
    cutGrid(grid, taken);
  };
  const auto isWest = [](const Point& p) { return p.x + 0.7 * p.y < 16.0; };
  cutTidily(west, middlesWhere(whole, isWest));
  cutTidily(east, middlesWhere(whole, [&](const Point& p) { return !isWest(p); }));
  ASSERT_LT(west.triangles.size() + east.triangles.size(), whole.triangles.size());
  const Grid inserted = east;
  const MergeReport report = mergeAndCheck(west, inserted);
  EXPECT_EQ(report.covered, 0u);
  EXPECT_GT(report.united, 20u);
  EXPECT_NEAR(areaOf(west), 400.0, 1.0);  // but for teeth at the shore
  EXPECT_EQ(std::ranges::count(west.boundaries, BoundaryRole::Island, &Boundary::role), 0);
}

TEST(MergeGrids, NodesOfBothNeedNotBeTheSameBits) {
  const Grid whole = basin();
  Grid west = whole, east = whole;
  const auto isWest = [](const Point& p) { return p.x < 9.0; };
  cutGrid(west, middlesWhere(whole, isWest));
  cutGrid(east, middlesWhere(whole, [&](const Point& p) { return !isWest(p); }));
  for (Point& p : east.nodes) p = {p.x + 0.004, p.y - 0.003};
  const MergeReport report = mergeAndCheck(west, east);
  EXPECT_EQ(report.united, 21u);
  EXPECT_EQ(report.joined, 20u);
  EXPECT_EQ(report.gap, 0u);
}

TEST(MergeGrids, WaterThatIsCutOffIsLeftOut) {
  // A channel, and across it a mesh that is open in the west only.
  const auto merged = [](bool open_in_the_east) {
    Grid grid = gridOf({30, 4});
    openWhere(grid, [&](const Point& p) { return p.x < 0.1 || (open_in_the_east && p.x > 29.9); });
    Grid harbour = gridOf({10, 16, 0.4, {12.2, -1.1}});
    openWhere(harbour, [](const Point& p) { return p.x < 12.3; });
    return mergeAndCheck(grid, harbour);
  };
  EXPECT_EQ(merged(true).cut_off, 0u);
  EXPECT_GT(merged(false).cut_off, 90u);
}

// The triangles of each water, by the least of them.
std::vector<std::uint32_t> watersOf(const Grid& grid) {
  const TriMesh mesh = linkGrid(grid).mesh;
  UnionFind sets(mesh.triangles.size());
  for (TriId t = 0; t < mesh.triangles.size(); ++t)
    for (const EdgeRef across : mesh.triangles[t].adj)
      if (across != kNone) sets.unite(t, triOf(across));
  std::vector<std::uint32_t> water_of;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) water_of.push_back(sets.find(t));
  return water_of;
}

TEST(MergeGrids, WatersThatAreCutOffGo) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::size_t cut_off = 0;
  for (int run = 0; run < 200; ++run) {
    SCOPED_TRACE(run);
    std::vector<std::uint8_t> is_water(400);
    for (std::uint8_t& square : is_water) square = share(random) < 0.75 ? 1 : 0;
    Grid grid = gridOf({20, 20, 1.0, {}, 0.0, [&](int column, int row) {
                          return is_water[static_cast<std::size_t>(20 * row + column)] != 0;
                        }});
    const Grid before = grid;
    const double x = 4.0 + 4.0 * share(random), y = 4.0 + 4.0 * share(random), turn = share(random);
    const Grid fine = gridOf({9, 9, 0.7, {x, y}, turn}, BoundaryRole::Open);
    MergeReport report;
    try {
      report = mergeGrids(grid, Grid(fine));
    } catch (const InputError&) {
      continue;  // no water beside it
    }
    cut_off += report.cut_off;
    const std::vector<std::uint32_t> was = watersOf(before), is = watersOf(grid);
    std::map<std::uint32_t, std::size_t> size_before, size;
    for (const std::uint32_t water : was) ++size_before[water];
    for (const std::uint32_t water : is) ++size[water];
    std::set<std::uint32_t> joined;
    for (std::size_t t = 0; t < is.size(); ++t)
      if (report.triangles[t].mesh == 1) joined.insert(is[t]);
    for (std::size_t t = 0; t < is.size(); ++t) {
      if (joined.contains(is[t])) continue;
      ASSERT_EQ(report.triangles[t].mesh, 0u);
      ASSERT_EQ(size[is[t]], size_before[was[report.triangles[t].number]]);
    }
  }
  EXPECT_GT(cut_off, 0u);
}

TEST(MergeGrids, LinesAndFeatures) {
  Grid grid = basin();
  grid.features = {{1, "sea", {}}};
  grid.feature_of.assign(grid.triangles.size(), 0);
  GridLine line{LineKind::Constraint, "cable", false, {}};
  for (std::uint32_t i = 0; i <= 20; ++i) line.nodes.push_back(21 * 3 + i);
  for (std::uint32_t i = 0; i + 1 < line.nodes.size(); ++i)
    ASSERT_EQ(distance(grid.nodes[line.nodes[i]], grid.nodes[line.nodes[i + 1]]), 1.0);
  grid.lines = {line};
  Grid fine = gridOf({10, 10, 0.5, {8.0, 0.7}}, BoundaryRole::Open);
  fine.lines = {{LineKind::Weir, "dam", false, {60, 61, 62}}};
  const MergeReport report = mergeAndCheck(grid, fine);
  ASSERT_EQ(grid.features.size(), 2u);
  ASSERT_EQ(grid.lines.size(), 3u);  // the cable on either side
  EXPECT_EQ(grid.lines[0].name, "cable");
  EXPECT_EQ(grid.lines[1].name, "cable");
  EXPECT_EQ(grid.lines[2].name, "dam");
  // Up to the inserted mesh.
  EXPECT_EQ(grid.nodes[grid.lines[0].nodes.front()].x, 0.0);
  EXPECT_EQ(grid.nodes[grid.lines[0].nodes.back()].x, 8.0);
  EXPECT_EQ(grid.nodes[grid.lines[1].nodes.front()].x, 13.0);
  EXPECT_EQ(grid.nodes[grid.lines[1].nodes.back()].x, 20.0);
  for (std::size_t t = 0; t < grid.triangles.size(); ++t)
    EXPECT_EQ(grid.features[grid.feature_of[t]].source, report.triangles[t].mesh == 1 ? "" : "sea");
}

TEST(MergeGrids, DepthsOfOneOnly) {
  Grid grid = basin();
  grid.z.clear();
  const Grid fine = gridOf({10, 10, 0.5, {8.0, 7.0}}, BoundaryRole::Open);
  const MergeReport report = mergeGrids(grid, Grid(fine));
  for (std::size_t n = 0; n < grid.nodes.size(); ++n) EXPECT_EQ(std::isnan(grid.z[n]), report.nodes[n].mesh == 0);
}

TEST(MergeGrids, IsTheSameForAnyLoop) {
  const Grid fine = gridOf({16, 12, 0.3, {7.3, 6.4}, 0.2}, BoundaryRole::Open);
  Grid one = basin(), other = basin();
  mergeGrids(one, Grid(fine));
  mergeGrids(other, Grid(fine), backwards);
  EXPECT_EQ(one.nodes, other.nodes);
  EXPECT_EQ(one.triangles, other.triangles);
  ASSERT_EQ(one.boundaries.size(), other.boundaries.size());
  EXPECT_EQ(one.boundaries[0].nodes, other.boundaries[0].nodes);
}

std::string refusal(Grid grid, Grid inserted) {
  try {
    mergeGrids(grid, std::move(inserted));
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(MergeGrids, RefusesWhatCannotBeJoined) {
  EXPECT_THAT(refusal(basin(), gridOf({3, 3, 1.0, {40.0, 0.0}}, BoundaryRole::Open)), HasSubstr("no open boundary"));
  EXPECT_THAT(refusal(basin(), gridOf({3, 3, 1.0, {40.0, 0.0}})), HasSubstr("no water of the other one"));
  EXPECT_THAT(refusal(basin(), gridOf({9, 9, 10.0, {-30.0, -30.0}}, BoundaryRole::Open)), HasSubstr("covers all"));
  Grid turned = gridOf({3, 3, 1.0, {4.2, 4.2}}, BoundaryRole::Open);
  std::swap(turned.triangles[4][0], turned.triangles[4][1]);
  EXPECT_THAT(refusal(basin(), turned), HasSubstr("triangle 5 of the mesh that is put in at"));
  Grid clockwise = basin();
  for (GridCorners& v : clockwise.triangles) std::swap(v[0], v[1]);
  EXPECT_THAT(refusal(clockwise, gridOf({3, 3, 1.0, {4.2, 4.2}}, BoundaryRole::Open)), HasSubstr("of the mesh at"));
}

}  // namespace
}  // namespace coastmesh
