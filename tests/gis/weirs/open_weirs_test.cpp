// Lines become ADCIRC's weirs between pairs of nodes, and the mesh stays one that ADCIRC accepts.
#include "gis/weirs/open_weirs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

#include "core/metric.hpp"
#include "core/quality.hpp"
#include "gis/check/check_target.hpp"
#include "gis/crs/crs.hpp"
#include "gis/error.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/model/apart_waters.hpp"
#include "gis/repair/repair_target.hpp"
#include "gis/weirs/beds_at_weirs.hpp"
#include "tests/gis/check/target_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::Kinds;
using testing::kindsIn;

constexpr int kSide = 8;  // of the sound grid, in cells
std::uint32_t at(int i, int j) { return static_cast<std::uint32_t>(j * (kSide + 1) + i); }

// With what meshes have of their triangles besides.
Grid sea(bool island = false) {
  Grid grid = testing::soundGrid(island);
  grid.area_m2 = triangleAreas(grid.nodes, grid.triangles, grid.crs);
  grid.min_angle_deg.assign(grid.triangles.size(), 59.0);
  return grid;
}

// The nodes from one to another along a side of the lattice's cells, or their diagonals.
std::vector<std::uint32_t> nodesFrom(int i, int j, int di, int dj, int edges) {
  std::vector<std::uint32_t> nodes;
  for (int k = 0; k <= edges; ++k) nodes.push_back(at(i + k * di, j + k * dj));
  return nodes;
}

struct Weirs {
  std::vector<WeirSource> sources;

  // Adds a line, and the feature that it comes from, whose points run the other way if `back`.
  void add(Grid& grid, const std::vector<std::uint32_t>& nodes, std::optional<WeirCrest> crest, bool back = false) {
    const std::string name = "w" + std::to_string(sources.size());
    std::vector<Point> points;
    for (const std::uint32_t node : nodes) points.push_back(grid.nodes[node]);
    if (back) std::ranges::reverse(points);
    grid.lines.push_back(lineOfNodes(LineKind::Weir, name, nodes));
    sources.push_back({name, {points}, crest.value_or(WeirCrest{})});
  }
};

double areaOf(const Grid& grid) {
  double sum = 0.0;
  for (const auto& [a, b, c] : grid.triangles)
    sum += 0.5 * cross(grid.nodes[b] - grid.nodes[a], grid.nodes[c] - grid.nodes[a]);
  return sum;
}

std::vector<Boundary> weirsOf(const Grid& grid) {
  std::vector<Boundary> weirs;
  for (const Boundary& boundary : grid.boundaries)
    if (!boundary.weir.empty()) weirs.push_back(boundary);
  return weirs;
}

// ADCIRC accepts the grid, the pairs are apart, and have the values that there were.
void expectSound(const Grid& grid, const Grid& before) {
  EXPECT_EQ(kindsIn(grid, Target::Adcirc), Kinds{});
  EXPECT_EQ(grid.triangles.size(), before.triangles.size());
  for (const Boundary& weir : weirsOf(grid)) {
    EXPECT_EQ(weir.ibtype, 24);
    ASSERT_EQ(weir.nodes.size(), weir.back_nodes.size());
    ASSERT_EQ(weir.weir.size(), 3 * weir.nodes.size());
    EXPECT_GE(weir.nodes.size(), 2u);
    for (std::size_t i = 0; i < weir.nodes.size(); ++i) {
      const Point gap = grid.nodes[weir.back_nodes[i]] - grid.nodes[weir.nodes[i]];
      EXPECT_GE(std::sqrt(squaredLength(gap)), 0.1);
      EXPECT_LE(std::sqrt(squaredLength(gap)), 10.01);
      EXPECT_EQ(grid.z[weir.nodes[i]], grid.z[weir.back_nodes[i]]);
    }
  }
  EXPECT_LE(areaOf(grid), areaOf(before));
  EXPECT_NEAR(
      areaOf(grid),
      [&grid] {
        double sum = 0.0;
        for (const double area : grid.area_m2) sum += area;
        return sum;
      }(),
      1.0);
}

TEST(OpenWeirs, DividesTheNodesInsideALine) {
  for (const bool back : {false, true}) {
    Grid grid = sea();
    Weirs weirs;
    weirs.add(grid, nodesFrom(2, 4, 1, 0, 4), WeirCrest{3.5, 0.9, 0.8}, back);
    const Grid before = grid;
    const WeirReport report = openWeirs(grid, weirs.sources, 30.0);
    expectSound(grid, before);
    EXPECT_EQ(report.boundaries, 1u);
    EXPECT_EQ(report.pairs, 3u);
    EXPECT_EQ(report.walls, 2u);
    EXPECT_THAT(report.warnings, IsEmpty());
    EXPECT_THAT(report.names, ElementsAre("w0"));
    EXPECT_THAT(report.notes(), ElementsAre("1 weir for ADCIRC with 3 pairs of nodes, 10 m apart; water does not pass "
                                            "the 2 edges at their ends and where they meet"));
    EXPECT_THAT(grid.lines, IsEmpty());
    EXPECT_EQ(grid.nodes.size(), before.nodes.size() + 3);
    const std::vector<Boundary> found = weirsOf(grid);
    ASSERT_EQ(found.size(), 1u);
    for (std::size_t i = 0; i < 3; ++i) {
      // The front is to the left of the feature's line.
      const Point front = grid.nodes[found[0].nodes[i]], across = grid.nodes[found[0].back_nodes[i]];
      EXPECT_NEAR(front.x, before.nodes[back ? at(5 - int(i), 4) : at(3 + int(i), 4)].x, 0.1);
      EXPECT_NEAR(front.y - across.y, back ? -10.0 : 10.0, 0.01);
      EXPECT_THAT(std::vector(found[0].weir.begin() + 3 * i, found[0].weir.begin() + 3 * i + 3),
                  ElementsAre(3.5, 0.9, 0.8));
    }
    // 2 edges between pairs 10 m apart, and a triangle at each end.
    EXPECT_NEAR(areaOf(before) - areaOf(grid), 2 * 10.0 * 1000.0 + 2 * 0.5 * 10.0 * 1000.0, 10.0);
    // Land around each end: from one side over the end to the other.
    EXPECT_EQ(std::ranges::count_if(grid.boundaries, [](const Boundary& each) { return each.nodes.size() == 3; }), 3);
  }
}

TEST(OpenWeirs, FromShoreToShoreEndsWithPairs) {
  Grid grid = sea();
  Weirs weirs;
  weirs.add(grid, nodesFrom(0, 4, 1, 0, 8), WeirCrest{2.0});
  const Grid before = grid;
  const WeirReport report = openWeirs(grid, weirs.sources, 30.0);
  expectSound(grid, before);
  EXPECT_EQ(report.pairs, 9u);
  EXPECT_EQ(report.walls, 0u);
  ASSERT_EQ(grid.boundaries.size(), 3u);  // the shores north and south of it, and the weir last
  EXPECT_EQ(grid.boundaries[2].nodes.size(), 9u);
  // The ends are still on the shore, which is straight there.
  for (const std::size_t end : {0u, 8u}) {
    for (const std::uint32_t node : {grid.boundaries[2].nodes[end], grid.boundaries[2].back_nodes[end]}) {
      const Point& p = grid.nodes[node];
      EXPECT_NEAR(p.x + 500.0 / 866.0 * p.y, end == 0 ? 0.0 : 8000.0, 1e-6);
    }
  }
}

TEST(OpenWeirs, OnAnIslandEndsWithAPairAndItsShoreIsLand) {
  Grid grid = sea(true);
  Weirs weirs;
  weirs.add(grid, nodesFrom(1, 4, 1, 0, 3), WeirCrest{2.0});
  const Grid before = grid;
  const WeirReport report = openWeirs(grid, weirs.sources, 30.0);
  expectSound(grid, before);
  EXPECT_EQ(report.pairs, 3u);
  EXPECT_EQ(report.walls, 1u);
  EXPECT_EQ(std::ranges::count(grid.boundaries, BoundaryRole::Island, &Boundary::role), 0);
}

TEST(OpenWeirs, WhereThreeMeetEachSectorHasItsNode) {
  Grid grid = sea();
  Weirs weirs;
  weirs.add(grid, nodesFrom(1, 4, 1, 0, 6), WeirCrest{2.0});
  weirs.add(grid, nodesFrom(4, 4, 0, 1, 3), WeirCrest{3.0});
  const Grid before = grid;
  const WeirReport report = openWeirs(grid, weirs.sources, 30.0);
  expectSound(grid, before);
  EXPECT_EQ(report.boundaries, 3u);
  EXPECT_EQ(report.pairs, 6u);
  EXPECT_EQ(report.walls, 6u);
  EXPECT_EQ(grid.nodes.size(), before.nodes.size() + 8);
}

TEST(OpenWeirs, LinesThatRunOnAreOneWithTheHigherCrestBetween) {
  Grid grid = sea();
  Weirs weirs;
  weirs.add(grid, nodesFrom(1, 4, 1, 0, 3), WeirCrest{2.0});
  weirs.add(grid, nodesFrom(4, 4, 1, 0, 3), WeirCrest{3.0, 0.5, 0.5});
  const Grid before = grid;
  EXPECT_EQ(openWeirs(grid, weirs.sources, 30.0).boundaries, 1u);
  expectSound(grid, before);
  const std::vector<Boundary> found = weirsOf(grid);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].weir, ElementsAre(2, 1, 1, 2, 1, 1, 3, 0.5, 0.5, 3, 0.5, 0.5, 3, 0.5, 0.5));
}

TEST(OpenWeirs, ARingRepeatsItsFirstPair) {
  Grid grid = sea();
  std::vector<std::uint32_t> ring = nodesFrom(2, 2, 1, 0, 3);
  for (const auto& side : {nodesFrom(5, 2, 0, 1, 3), nodesFrom(5, 5, -1, 0, 3), nodesFrom(2, 5, 0, -1, 3)})
    ring.insert(ring.end(), side.begin() + 1, side.end());
  Weirs weirs;
  weirs.add(grid, ring, WeirCrest{2.0});
  ASSERT_TRUE(grid.lines[0].closed);
  const Grid before = grid;
  const WeirReport report = openWeirs(grid, weirs.sources, 30.0);
  expectSound(grid, before);
  EXPECT_EQ(report.pairs, 12u);
  EXPECT_EQ(report.walls, 0u);
  const std::vector<Boundary> found = weirsOf(grid);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].nodes.size(), 13u);
  EXPECT_EQ(found[0].nodes.front(), found[0].nodes.back());
  EXPECT_EQ(found[0].back_nodes.front(), found[0].back_nodes.back());
}

TEST(OpenWeirs, StayEdgesAtOpenBoundaries) {
  Grid grid = testing::openGrid();
  Weirs weirs;
  weirs.add(grid, nodesFrom(3, 0, 0, 1, 4), WeirCrest{2.0});
  const WeirReport report = openWeirs(grid, weirs.sources, 30.0);
  EXPECT_EQ(kindsIn(grid, Target::Adcirc), Kinds{});
  EXPECT_EQ(report.pairs, 2u);
  ASSERT_EQ(grid.lines.size(), 1u);
  EXPECT_THAT(grid.lines[0].nodes, ElementsAre(at(3, 0), at(3, 1)));
}

// Water flows over a weir into what it surrounds.
TEST(OpenWeirs, WaterWithinARingIsNotApart) {
  Grid grid = testing::openGrid();
  Weirs weirs;
  weirs.add(grid, {at(1, 2), at(2, 2), at(3, 2), at(3, 3), at(3, 4), at(2, 4), at(1, 4), at(1, 3), at(1, 2)},
            WeirCrest{2.0});
  EXPECT_EQ(openWeirs(grid, weirs.sources, 30.0).pairs, 8u);
  EXPECT_FALSE(isOneWater(grid));
  EXPECT_THAT(apartWaters(grid), IsEmpty());
  for (Boundary& boundary : grid.boundaries) boundary.back_nodes.clear();
  EXPECT_EQ(apartWaters(grid).size(), 1u);
}

// Each with a part of the warning.
TEST(OpenWeirs, LinesThatCannotBeOpenedStayEdges) {
  struct Case {
    std::vector<std::uint32_t> nodes;
    std::optional<WeirCrest> crest;
    std::string text;
  };
  const std::vector<Case> cases{
      {nodesFrom(2, 4, 1, 0, 4), std::nullopt, "it has no attribute 'height'"},
      {nodesFrom(2, 4, 1, 0, 1), WeirCrest{2.0}, "no two of its nodes in a row can be doubled"},
      {nodesFrom(2, 4, 1, 0, 2), WeirCrest{2.0}, "no two of its nodes in a row can be doubled"},
      // Around a triangle on the shore.
      {{at(3, 0), at(3, 1), at(2, 0)}, WeirCrest{2.0}, "a triangle would have no neighbour"},
  };
  for (const auto& [nodes, crest, text] : cases) {
    Grid grid = sea();
    Weirs weirs;
    weirs.add(grid, nodes, crest);
    const Grid before = grid;
    const WeirReport report = openWeirs(grid, weirs.sources, 30.0);
    EXPECT_THAT(report.warnings, ElementsAre(::testing::AllOf(HasSubstr("weir 'w0' from "), HasSubstr(text))));
    EXPECT_EQ(report.pairs, 0u);
    EXPECT_THAT(report.notes(), IsEmpty());
    EXPECT_EQ(grid.nodes, before.nodes);
    EXPECT_EQ(grid.triangles, before.triangles);
    ASSERT_EQ(grid.lines.size(), 1u);
    EXPECT_EQ(grid.lines[0].nodes, before.lines[0].nodes);
  }
}

// Whatever lines there are, ADCIRC accepts the mesh, also where coordinates are degrees.
TEST(OpenWeirs, AnyLinesLeaveASoundMesh) {
  std::mt19937_64 random(20261128);
  constexpr std::array<std::array<int, 2>, 6> kSteps{{{1, 0}, {0, 1}, {1, 1}, {-1, 0}, {0, -1}, {-1, -1}}};
  std::size_t opened = 0;
  for (int round = 0; round < 300; ++round) {
    Grid grid = sea(round % 2 == 0);
    if (round % 3 == 0) {
      grid.crs = wgs84();
      for (Point& p : grid.nodes) p = {10.0 + p.x / 111e3, p.y / 111e3};
      grid.area_m2.clear();
    }
    std::set<NodePair> inner, used;
    std::map<NodePair, int> sides;
    for (const auto& v : grid.triangles)
      for (unsigned k = 0; k < 3; ++k) ++sides[edgeKey(v[k], v[(k + 1) % 3])];
    for (const auto& [edge, count] : sides)
      if (count == 2) inner.insert(edge);
    Weirs weirs;
    for (int line = 0; line < 4; ++line) {
      int i = static_cast<int>(random() % (kSide + 1)), j = static_cast<int>(random() % (kSide + 1));
      std::vector<std::uint32_t> nodes{at(i, j)};
      for (int tries = 0; tries < 30; ++tries) {
        const auto& [di, dj] = kSteps[random() % kSteps.size()];
        if (i + di < 0 || j + dj < 0 || i + di > kSide || j + dj > kSide) continue;
        const std::uint32_t next = at(i + di, j + dj);
        const NodePair edge = edgeKey(nodes.back(), next);
        if (!inner.contains(edge) || std::ranges::count(nodes, next) > 0 || !used.insert(edge).second) continue;
        nodes.push_back(next);
        i += di;
        j += dj;
      }
      if (nodes.size() > 1) weirs.add(grid, nodes, WeirCrest{2.0});
    }
    const Grid before = grid;
    const WeirReport report = openWeirs(grid, weirs.sources, 20.0);
    EXPECT_EQ(kindsIn(grid, Target::Adcirc), Kinds{}) << "round " << round;
    opened += report.pairs;
    EXPECT_TRUE(report.pairs > 0 || grid.nodes == before.nodes);
    for (const Boundary& weir : weirsOf(grid)) EXPECT_GE(weir.nodes.size(), 2u);
  }
  EXPECT_GT(opened, 1000u);
}

TEST(WeirSources, AreReadFromAttributes) {
  Coastline coastline;
  Feature feature;
  feature.fid = 7;
  feature.source = "levees.gpkg";
  feature.use = FeatureUse::Weir;
  feature.lines = {{{0, 0}, {1, 1}}};
  feature.attributes = {{"Name", "north"}, {"HEIGHT", "3.5"}, {"coef_super", "0.8"}};
  coastline.features = {feature, feature};
  coastline.features[1].attributes = {{"name", "south"}};
  const std::vector<WeirSource> sources = weirSources(coastline, 0.5);
  ASSERT_EQ(sources.size(), 2u);
  EXPECT_EQ(sources[0].name, "north");
  EXPECT_EQ(sources[0].crest.height_m, 3.0);
  EXPECT_EQ(sources[0].crest.subcritical, 1.0);
  EXPECT_EQ(sources[0].crest.supercritical, 0.8);
  EXPECT_EQ(sources[0].feature, "'levees.gpkg', feature 7");
  EXPECT_FALSE(sources[1].crest.height_m);
  for (const auto& [value, text] : {std::pair("high", "its attribute 'HEIGHT' is high, not a number"),
                                    std::pair("3,5", "its attribute 'HEIGHT' is 3,5, not a number")}) {
    coastline.features[0].attributes[1].second = value;
    EXPECT_THAT([&] { weirSources(coastline, 0.0); },
                ::testing::ThrowsMessage<InputError>(HasSubstr(std::string("'levees.gpkg', feature 7: ") + text)));
  }
  coastline.features[0].attributes = {{"height", "1"}, {"coef_sub", "-1"}};
  EXPECT_THAT(
      [&] { weirSources(coastline, 0.0); },
      ::testing::ThrowsMessage<InputError>(HasSubstr("its attribute 'coef_sub' is -1, not a number of 0 or more")));
}

// Of features with one name the closest counts, also where longitudes are a turn apart.
TEST(WeirSources, AreFoundByPlace) {
  Grid grid = sea();
  grid.crs = wgs84();
  for (Point& p : grid.nodes) p = {179.99 + p.x / 111e3, p.y / 111e3};
  Weirs weirs;
  weirs.add(grid, nodesFrom(2, 4, 1, 0, 3), WeirCrest{1.0});
  weirs.add(grid, nodesFrom(2, 5, 1, 0, 3), WeirCrest{2.0});
  for (WeirSource& source : weirs.sources) {
    source.name = "";
    for (Point& p : source.lines[0]) p.x -= 360.0;
  }
  for (GridLine& line : grid.lines) line.name = "";
  EXPECT_EQ(sourceOf(grid, grid.lines[0], weirs.sources), &weirs.sources[0]);
  EXPECT_EQ(sourceOf(grid, grid.lines[1], weirs.sources), &weirs.sources[1]);
  grid.lines[0].name = "other";
  EXPECT_EQ(sourceOf(grid, grid.lines[0], weirs.sources), nullptr);
}

TEST(BedsAtWeirs, AreBelowTheCrests) {
  Grid grid = sea();
  Weirs weirs;
  weirs.add(grid, nodesFrom(2, 4, 1, 0, 4), WeirCrest{3.5});
  grid.z[at(4, 4)] = 3.5;
  grid.z[at(5, 4)] = 3.4;
  openWeirs(grid, weirs.sources, 30.0);
  const Grid before = grid;
  const WeirBeds beds = fitWeirsToBeds(grid);
  EXPECT_EQ(beds.lowered, 2u);
  ASSERT_EQ(beds.notes().size(), 1u);
  EXPECT_THAT(beds.notes()[0], HasSubstr("2 nodes of weirs were as high as their crests"));
  const Boundary weir = weirsOf(grid)[0];
  for (std::size_t i = 0; i < 3; ++i) {
    for (const std::uint32_t node : {weir.nodes[i], weir.back_nodes[i]}) {
      if (i != 1) {
        EXPECT_EQ(grid.z[node], before.z[node]);
      } else {
        EXPECT_LT(grid.z[node], -19.0);  // as beside it
        EXPECT_GT(grid.z[node], -24.0);
      }
    }
  }
  EXPECT_EQ(fitWeirsToBeds(grid).lowered, 0u);
  // Where the ground beside is as high, the crest rises.
  for (double& z : grid.z) z = 9.0;
  const WeirBeds raised = fitWeirsToBeds(grid);
  EXPECT_EQ(raised.lowered, 0u);
  EXPECT_EQ(raised.raised, 3u);
  EXPECT_THAT(raised.notes(),
              ElementsAre(HasSubstr("3 pairs of nodes of weirs, whose crests are raised to 0.1 m above it")));
  EXPECT_THAT(weirsOf(grid)[0].weir, ElementsAre(9.1, 1, 1, 9.1, 1, 1, 9.1, 1, 1));
}

TEST(BedsAtWeirs, AboveCrestsAreFoundOnBothShores) {
  Grid grid = sea();
  Weirs weirs;
  weirs.add(grid, nodesFrom(2, 4, 1, 0, 4), WeirCrest{3.5});
  openWeirs(grid, weirs.sources, 30.0);
  const Boundary weir = weirsOf(grid)[0];
  const auto found = [](const Grid& of) {
    std::vector<TargetDefect> all = checkTarget(of, Target::Adcirc);
    EXPECT_TRUE(std::ranges::all_of(
        all, [](const TargetDefect& defect) { return defect.kind == TargetDefectKind::BedAboveCrest; }));
    EXPECT_EQ(kindsIn(of, Target::Schism).count(TargetDefectKind::BedAboveCrest), 0u);
    return all;
  };
  // As high as the crest is as high as ADCIRC takes.
  for (const double z : {3.5, 3.75}) {
    for (const std::uint32_t node : {weir.nodes[1], weir.back_nodes[1]}) {
      Grid high = grid;
      high.z[node] = z;
      const std::vector<TargetDefect> all = found(high);
      ASSERT_EQ(all.size(), z > 3.5 ? 1u : 0u);
      if (all.empty()) continue;
      EXPECT_EQ(all[0].node, node);
      EXPECT_EQ(all[0].value, 0.25);
      // Repairs, which refuse meshes with weirs, leave it to what fits them.
      EXPECT_TRUE(repairForTargets(high, std::array{Target::Adcirc}, {}).left.empty());
      EXPECT_EQ(fitWeirsToBeds(high).lowered, 1u);
      EXPECT_TRUE(found(high).empty());
    }
  }
  // Pipes are lower than the crest: height, coefficient and diameter follow it.
  for (Boundary& boundary : grid.boundaries) {
    if (boundary.weir.empty()) continue;
    boundary.ibtype = 25;
    boundary.weir.clear();
    for (std::size_t i = 0; i < boundary.nodes.size(); ++i)
      boundary.weir.insert(boundary.weir.end(), {3.5, 1.0, 1.0, -2.0, 1.0, 0.5});
  }
  EXPECT_TRUE(found(grid).empty());
  grid.z[weir.back_nodes[2]] = -1.5;
  const std::vector<TargetDefect> all = found(grid);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].node, weir.back_nodes[2]);
  EXPECT_EQ(all[0].value, 0.5);
}

}  // namespace
}  // namespace coastmesh
