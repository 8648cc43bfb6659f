// Grids with recognisable values in every array, edited and repaired at random: what remains keeps its values.
#include "gis/grid/grid_edit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "core/bulk_list.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/repair/repair_target.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/bulk_lists.hpp"

namespace coastmesh {
namespace {

using testing::lattice;
using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t count) { return static_cast<std::size_t>(random() % count); }

// z is a function of place, so that it is known between nodes too; size_m follows from z, wherever a node is moved.
double zAt(const Point& p) { return -20.0 + 1e-3 * p.x + 2e-3 * p.y; }
double sizeOfZ(double z) { return 500.0 - 4.0 * z; }

Point middleOf(const Grid& grid, const GridCorners& corners) {
  Point sum{0.0, 0.0};
  for (const std::uint32_t node : corners) sum = {sum.x + grid.nodes[node].x / 3.0, sum.y + grid.nodes[node].y / 3.0};
  return sum;
}

// Squares of a kilometre, each with two triangles, in two features that meet at x = 5 km; a border and a weir run along
// edges of the lattice. `wanted` as for `lattice`.
constexpr int kSide = 10;
constexpr double kBorderX = 5000.0;

Grid valuedGrid(Random& random, const std::function<bool(int, int)>& wanted) {
  std::uniform_real_distribution<double> shift(-120.0, 120.0);
  const TriMesh mesh = lattice(kSide, kSide, wanted, [&](int i, int j) {
    const bool kept = i == 5 || j == 3;  // where lines run, which must be straight
    return Point{1000.0 * i + (kept ? 0.0 : shift(random)), 1000.0 * j + (kept ? 0.0 : shift(random))};
  });
  Grid grid;
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  for (const Point& p : grid.nodes) grid.z.push_back(zAt(p));
  for (const double z : grid.z) grid.size_m.push_back(sizeOfZ(z));
  grid.features = {{70, "west", {}, "w"}, {71, "east", {}, "e"}};
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) {
    grid.feature_of.push_back(middleOf(grid, grid.triangles[t]).x < kBorderX ? 0 : 1);
    grid.piece_of.push_back(t);
    grid.min_angle_deg.push_back(1000.0 + t);
    grid.area_m2.push_back(2000.0 + t);
  }
  grid.boundaries = findBoundaries(mesh);
  const auto at = [](int i, int j) { return static_cast<std::uint32_t>(j * (kSide + 1) + i); };
  GridLine border{LineKind::RegionBorder, "border", false, {}}, weir{LineKind::Weir, "weir", false, {}};
  for (int k = 0; k <= kSide; ++k) border.nodes.push_back(at(5, k));
  for (int k = 0; k <= kSide; ++k) weir.nodes.push_back(at(k, 3));
  GridLine ring{LineKind::Constraint,
                "ring",
                true,
                {at(6, 6), at(7, 6), at(8, 6), at(8, 7), at(8, 8), at(7, 8), at(6, 8), at(6, 7)}};
  grid.lines = {border, weir, ring};
  cutLinesOffEdges(grid);
  return grid;
}

std::map<std::string, double> lengthOfLines(const Grid& grid) {
  std::map<std::string, double> lengths;
  for (const GridLine& line : grid.lines)
    for (const auto& [a, b] : edgesOf({BoundaryRole::Land, line.closed, line.nodes}))
      lengths[line.name] += std::hypot(grid.nodes[b].x - grid.nodes[a].x, grid.nodes[b].y - grid.nodes[a].y);
  return lengths;
}

bool isInside(const Point& p, const std::array<Point, 3>& corners) {
  for (unsigned i = 0; i < 3; ++i) {
    const Point &a = corners[i], &b = corners[(i + 1) % 3];
    if ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) < 0.0) return false;
  }
  return true;
}

double areaOf(const Grid& grid, const GridCorners& corners) {
  const Point &a = grid.nodes[corners[0]], &b = grid.nodes[corners[1]], &c = grid.nodes[corners[2]];
  return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2.0;
}

// Splits an edge of a triangle, inner or on the boundary, together with the triangles on its sides.
void splitEdge(Grid& grid, std::uint32_t t, unsigned corner, double share) {
  const std::uint32_t a = grid.triangles[t][corner], b = grid.triangles[t][(corner + 1) % 3];
  const std::uint32_t middle = addNodeBetween(grid, a, b, share);
  const std::size_t before = grid.triangles.size();
  for (std::uint32_t s = 0; s < before; ++s) {
    const GridCorners corners = grid.triangles[s];
    if (std::ranges::count(corners, a) == 0 || std::ranges::count(corners, b) == 0) continue;
    GridCorners first = corners, second = corners;
    std::ranges::replace(first, b, middle);
    std::ranges::replace(second, a, middle);
    grid.triangles[s] = first;
    copyTriangle(grid, s, second);
  }
}

TEST(GridEdit, WhatIsLeftCarriesItsValues) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Grid grid = valuedGrid(random, [](int i, int j) { return i != 2 || j != 7; });
    const Grid before = grid;
    std::size_t appended = 0;
    for (int edit = 0; edit < 25; ++edit) {
      const std::size_t nodes = grid.nodes.size(), triangles = grid.triangles.size();
      switch (below(random, 6)) {
        case 0:
          splitEdge(grid, static_cast<std::uint32_t>(below(random, triangles)), static_cast<unsigned>(below(random, 3)),
                    0.2 + 0.1 * static_cast<double>(below(random, 7)));
          break;
        case 1: {
          std::vector<bool> gone(triangles, false);
          gone[below(random, triangles)] = gone[below(random, triangles)] = true;
          removeTriangles(grid, gone);
          break;
        }
        case 2:
          removeUnusedNodes(grid);
          break;
        case 3:
        case 4: {
          const bool of_nodes = below(random, 2) == 0;
          std::vector<std::uint32_t> order(of_nodes ? nodes : triangles);
          for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
          std::ranges::shuffle(order, random);
          of_nodes ? orderNodes(grid, order) : orderTriangles(grid, order);
          break;
        }
        case 5:
          if (appended == 1) break;
          ++appended;
          Grid part = before;
          for (Point& p : part.nodes) p.x += 1e5;
          for (std::size_t i = 0; i < part.nodes.size(); ++i) {
            part.z[i] = zAt(part.nodes[i]);
            part.size_m[i] = sizeOfZ(part.z[i]);
          }
          appendGrid(grid, std::move(part));
          break;
      }
      ASSERT_NO_THROW(requireConsistent(grid)) << "edit " << edit;
    }
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
      ASSERT_NEAR(grid.z[i], zAt(grid.nodes[i]), 1e-9);
      ASSERT_NEAR(grid.size_m[i], sizeOfZ(grid.z[i]), 1e-9);
    }
    std::map<std::uint32_t, std::uint32_t> first_pieces;  // by feature: pieces were shifted when appended
    for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
      // The original triangle that it is, or was cut from.
      const auto was = static_cast<std::size_t>(std::lround(grid.area_m2[t] - 2000.0));
      ASSERT_LT(was, before.triangles.size());
      EXPECT_EQ(grid.min_angle_deg[t], 1000.0 + static_cast<double>(was));
      EXPECT_EQ(grid.features[grid.feature_of[t]].source, before.features[before.feature_of[was]].source);
      Point middle = middleOf(grid, grid.triangles[t]);
      const bool is_appended = middle.x > 5e4;
      const std::uint32_t shift = grid.piece_of[t] - static_cast<std::uint32_t>(was);
      EXPECT_EQ(first_pieces.try_emplace(is_appended, shift).first->second, shift);
      if (is_appended) middle.x -= 1e5;
      std::array<Point, 3> corners;
      for (unsigned i = 0; i < 3; ++i) corners[i] = before.nodes[before.triangles[was][i]];
      EXPECT_TRUE(isInside(middle, corners));
    }
    for (const GridLine& line : grid.lines) {
      for (const std::uint32_t node : line.nodes) {
        Point p = grid.nodes[node];
        if (p.x > 5e4) p.x -= 1e5;
        EXPECT_TRUE(line.name != "border" || std::abs(p.x - kBorderX) < 1e-9);
        EXPECT_TRUE(line.name != "weir" || std::abs(p.y - 3000.0) < 1e-9);
      }
    }
  }
}

TEST(GridEdit, ValuesOfWeirsGoWithTheirNodes) {
  Random random(3);
  Grid grid = valuedGrid(random, [](int, int) { return true; });
  grid.lines.clear();
  // Along the southern side, with the northern side across; the values of a node identify it and its back node.
  Boundary weir{BoundaryRole::Land, false, {}, 24};
  for (std::uint32_t i = 0; i <= kSide; ++i) {
    const std::uint32_t back = kSide * (kSide + 1) + i;
    weir.nodes.push_back(i);
    weir.back_nodes.push_back(back);
    weir.weir.insert(weir.weir.end(), {grid.z[i], grid.z[back]});
  }
  grid.boundaries = {weir};
  // Removes all triangles at node 4, which divides the weir.
  std::vector<bool> gone(grid.triangles.size(), false);
  for (std::size_t t = 0; t < gone.size(); ++t) gone[t] = std::ranges::count(grid.triangles[t], 4u) > 0;
  removeTriangles(grid, gone);
  removeUnusedNodes(grid);
  std::vector<std::uint32_t> order(grid.nodes.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::shuffle(order, random);
  orderNodes(grid, order);
  requireConsistent(grid);
  ASSERT_EQ(grid.boundaries.size(), 2u);
  EXPECT_EQ(grid.boundaries[0].nodes.size(), 4u);
  EXPECT_EQ(grid.boundaries[1].nodes.size(), 6u);
  for (const Boundary& piece : grid.boundaries) {
    ASSERT_EQ(piece.weir.size(), 2 * piece.nodes.size());
    for (std::size_t i = 0; i < piece.nodes.size(); ++i) {
      EXPECT_EQ(piece.weir[2 * i], grid.z[piece.nodes[i]]);
      EXPECT_EQ(piece.weir[2 * i + 1], grid.z[piece.back_nodes[i]]);
    }
  }
  Grid whole = valuedGrid(random, [](int, int) { return true; });
  const auto shift = static_cast<std::uint32_t>(whole.nodes.size());
  const std::uint32_t back = grid.boundaries[0].back_nodes[0];
  grid.lines.clear();
  appendGrid(whole, std::move(grid));
  requireConsistent(whole);
  EXPECT_EQ(whole.boundaries[1].back_nodes[0], shift + back);
}

TEST(GridEdit, WhatOneOfTwoGridsDoesNotTellIsUnknown) {
  Random random(4);
  const auto all = [](int, int) { return true; };
  Grid whole = valuedGrid(random, all), part = valuedGrid(random, all);
  const std::size_t nodes = whole.nodes.size();
  whole.z.clear();
  whole.piece_of.clear();
  part.size_m.clear();
  appendGrid(whole, std::move(part));
  requireConsistent(whole);
  for (std::size_t i = 0; i < nodes; ++i) {
    EXPECT_TRUE(std::isnan(whole.z[i]) && std::isnan(whole.size_m[nodes + i]));
    EXPECT_FALSE(std::isnan(whole.size_m[i]) || std::isnan(whole.z[nodes + i]));
  }
  EXPECT_EQ(whole.piece_of[0], 0u);
  EXPECT_EQ(whole.piece_of.back(), whole.triangles.size() / 2);

  Grid nameless = valuedGrid(random, all);
  nameless.feature_of.clear();
  EXPECT_THROW(appendGrid(whole, std::move(nameless)), std::logic_error);
}

TEST(GridEdit, AClosedLineThatIsCutStaysOneLine) {
  Random random(5);
  Grid grid = valuedGrid(random, [](int, int) { return true; });
  grid.lines.erase(grid.lines.begin(), grid.lines.begin() + 2);
  ASSERT_TRUE(grid.lines[0].closed);
  const auto loop = grid.lines[0].nodes;
  std::vector<bool> gone(grid.triangles.size(), false);
  for (std::size_t t = 0; t < gone.size(); ++t)
    gone[t] = std::ranges::count(grid.triangles[t], loop[2]) > 0 && std::ranges::count(grid.triangles[t], loop[3]) > 0;
  removeTriangles(grid, gone);
  ASSERT_EQ(grid.lines.size(), 1u);
  EXPECT_FALSE(grid.lines[0].closed);
  // One of the two triangles was in a corner of the loop, so both its edges are lost.
  std::vector<std::uint32_t> left(loop.begin() + 3, loop.end());
  left.insert(left.end(), {loop[0], loop[1]});
  EXPECT_EQ(grid.lines[0].nodes, left);
}

TEST(GridEdit, ValuesMoveWithANode) {
  Grid grid;
  grid.nodes = {{0.0, 0.0}, {8.0, 0.0}, {0.0, 8.0}};
  grid.z = {-10.0, -20.0, -40.0};
  grid.size_m = {1.0, std::numeric_limits<double>::quiet_NaN(), 3.0};
  moveNode(grid, 0, 1, 2, 0.5);
  EXPECT_EQ(grid.nodes[0], (Point{2.0, 2.0}));
  EXPECT_EQ(grid.z[0], -20.0);     // half the way to -30
  EXPECT_EQ(grid.size_m[0], 1.0);  // the size beside it is unknown
  moveNode(grid, 2, 1, 1, 0.25);
  EXPECT_EQ(grid.nodes[2], (Point{2.0, 6.0}));
  EXPECT_EQ(grid.z[2], -35.0);
}

TEST(GridEdit, PlacesBetweenLieTheShortWayRound) {
  const auto expectPlace = [](const Point& place, double x, double y) {
    EXPECT_NEAR(place.x, x, 1e-9);
    EXPECT_NEAR(place.y, y, 1e-9);
  };
  expectPlace(placeBetween(wgs84(), {179.0, 10.0}, {-178.0, 20.0}, 0.25), 179.75, 12.5);
  expectPlace(placeBetween(wgs84(), {179.0, 10.0}, {-178.0, 20.0}, 0.5), -179.5, 15.0);
  expectPlace(placeBetween(wgs84(), {359.0, 0.0}, {2.0, 0.0}, 0.5), 0.5, 0.0);
  expectPlace(placeBetween(wgs84(), {-179.0, 0.0}, {-177.0, 0.0}, 0.5), -178.0, 0.0);
  expectPlace(placeBetween({}, {-179.0, 0.0}, {179.0, 0.0}, 0.5), 0.0, 0.0);
  expectPlace(meanPlace(wgs84(), std::array{Point{179.0, 0.0}, Point{-179.0, 3.0}, Point{-178.0, 3.0}}),
              -179.0 - 1.0 / 3, 2.0);
}

TEST(GridEdit, WhatIsNotConsistentIsABug) {
  Random random(6);
  const Grid sound = valuedGrid(random, [](int, int) { return true; });
  EXPECT_NO_THROW(requireConsistent(sound));
  const auto expectRefused = [&](auto&& spoil) {
    Grid grid = sound;
    spoil(grid);
    EXPECT_THROW(requireConsistent(grid), std::logic_error);
  };
  expectRefused([](Grid& grid) { grid.size_m.pop_back(); });
  expectRefused([](Grid& grid) { grid.piece_of.push_back(0); });
  expectRefused([](Grid& grid) { grid.nodes.pop_back(); });
  expectRefused([](Grid& grid) { grid.feature_of[3] = 2; });
  expectRefused([](Grid& grid) { grid.boundaries[0].nodes[1] = 10000; });
  expectRefused([](Grid& grid) { grid.boundaries[0].back_nodes.push_back(1); });
  expectRefused([](Grid& grid) { std::swap(grid.lines[0].nodes[1], grid.lines[0].nodes[4]); });
  expectRefused([](Grid& grid) { grid.lines[0].nodes.resize(1); });
  // Along the shore there is no mesh on the other side.
  expectRefused([](Grid& grid) { grid.lines[0].nodes = {0, 1, 2}; });
}

// Defects of all kinds that are repaired by changing triangles, and pinched nodes.
TEST(RepairTarget, WhatIsLeftCarriesItsValues) {
  constexpr Target kAll[] = {Target::Adcirc,  Target::Schism,  Target::Fvcom,
                             Target::Telemac, Target::Dflowfm, Target::Swan};
  std::size_t doubled = 0, split = 0, flipped = 0, taken_out = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const int hole = 1 + static_cast<int>(below(random, 3));
    const bool pinched = seed % 2 == 0;
    Grid grid = valuedGrid(
        random, [&](int i, int j) { return !(i == hole && j == 5) && !(pinched && i == hole + 1 && j == 6); });
    // Moves nodes off the lines towards edges, which makes angles large.
    for (int k = 0; k < 6; ++k) {
      const std::size_t node = below(random, grid.nodes.size());
      Point& p = grid.nodes[node];
      const bool on_line = std::ranges::any_of(
          grid.lines, [&](const GridLine& line) { return std::ranges::count(line.nodes, node) > 0; });
      if (on_line || p.x < 500.0 || p.y < 500.0 || p.x > 9500.0 || p.y > 9500.0) continue;
      p.y += 600.0;
      grid.z[node] = zAt(p);
      grid.size_m[node] = sizeOfZ(grid.z[node]);
    }
    // Moves others so close to lines that angles there call for flips of the lines' edges.
    for (const std::uint32_t k : {1u, 3u, 6u, 8u}) {
      const auto below_weir = 2 * (kSide + 1) + k, beside_border = k * (kSide + 1) + 4;
      if (below(random, 2) == 0) grid.nodes[below_weir].y = 2880.0;
      if (below(random, 2) == 0) grid.nodes[beside_border].x = kBorderX - 120.0;
      for (const std::uint32_t node : {below_weir, beside_border}) {
        grid.z[node] = zAt(grid.nodes[node]);
        grid.size_m[node] = sizeOfZ(grid.z[node]);
      }
    }
    // The border between features is kept without a line, too.
    if (below(random, 2) == 0) std::erase_if(grid.lines, [](const GridLine& line) { return line.name == "border"; });
    // A separate triangle, and a node without triangles.
    const std::uint32_t lone = addNode(grid, {-900.0, 0.0});
    addNode(grid, {-900.0, 500.0});
    addNode(grid, {-1300.0, 0.0});
    copyTriangle(grid, 0, {lone, lone + 1, lone + 2});
    addNode(grid, {-2000.0, 0.0});
    for (std::uint32_t node = lone; node < grid.nodes.size(); ++node) {
      grid.z[node] = zAt(grid.nodes[node]);
      grid.size_m[node] = sizeOfZ(grid.z[node]);
    }
    for (std::size_t t = 0; t < grid.triangles.size(); ++t) grid.piece_of[t] = 100 + grid.feature_of[t];
    grid.area_m2 = triangleAreas(grid.nodes, grid.triangles, grid.crs);
    grid.min_angle_deg.assign(grid.triangles.size(), 0.0);
    grid.boundaries = cutLoops(grid, boundaryLoops(grid), [&](std::uint32_t a, std::uint32_t b) {
      const bool south = std::max(grid.nodes[a].y, grid.nodes[b].y) < 200.0 && std::min(a, b) < lone;
      return BoundaryKind{south ? BoundaryRole::Open : BoundaryRole::Land};
    });
    const Grid before = grid;
    std::vector<Target> targets{kAll[below(random, 6)]};
    if (below(random, 2) == 0) targets.push_back(kAll[below(random, 6)]);
    const RepairReport report = repairForTargets(grid, targets);
    for (const Repair& repair : report.repairs) {
      doubled += repair.what.starts_with("node duplicated");
      split += repair.what == "edge split";
      flipped += repair.what == "edge flipped";
      taken_out += repair.what == "triangle removed";
    }
    const std::set<double> known(before.z.begin(), before.z.end());
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
      ASSERT_NEAR(grid.size_m[i], sizeOfZ(grid.z[i]), 1e-9);
      // Either a function of place, or a copy that was moved a little.
      EXPECT_TRUE(known.contains(grid.z[i]) || std::abs(grid.z[i] - zAt(grid.nodes[i])) < 1.0);
    }
    for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
      EXPECT_EQ(grid.piece_of[t], 100 + grid.feature_of[t]);
      EXPECT_EQ(grid.feature_of[t], middleOf(grid, grid.triangles[t]).x < kBorderX ? 0u : 1u);
      EXPECT_NEAR(grid.area_m2[t], areaOf(grid, grid.triangles[t]), 1e-6 * std::abs(grid.area_m2[t]));
    }
    if (!pinched) {
      const auto was = lengthOfLines(before), is = lengthOfLines(grid);
      ASSERT_EQ(was.size(), is.size());
      for (const auto& [name, length] : was) EXPECT_NEAR(is.at(name), length, 1e-6 * length) << name;
    }
  }
  EXPECT_GT(doubled, 5u);
  EXPECT_GT(split, 5u);
  EXPECT_GT(flipped, 5u);
  EXPECT_GT(taken_out, 5u);
}

// Nodes made by repairs are between the nodes they were made from, even if longitudes jump there.
TEST(RepairTarget, NodesAcrossTheAntimeridian) {
  std::size_t made = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Grid grid = valuedGrid(random, [](int i, int j) { return !(i == 5 && j == 5) && !(i == 4 && j == 6); });
    grid.lines.clear();
    grid.z.clear();
    grid.size_m.clear();
    grid.crs = wgs84();
    for (Point& p : grid.nodes) {
      if (below(random, 12) == 0 && p.y > 500.0 && p.y < 9500.0) p.y += 600.0;
      p = {180.0 + (p.x - kBorderX) * 1e-5, p.y * 1e-5};
      if (p.x > 180.0) p.x -= 360.0;
    }
    const std::size_t before = grid.nodes.size();
    const RepairReport report = repairForTargets(grid, std::array{Target::Swan, Target::Dflowfm});
    EXPECT_GT(std::ranges::count(report.repairs, TargetDefectKind::PinchedNode, &Repair::kind), 0);
    made += grid.nodes.size() - std::min(before, grid.nodes.size());
    for (const Point& p : grid.nodes) EXPECT_TRUE(std::abs(p.x) > 179.9 && std::abs(p.x) <= 180.0) << p.x;
  }
  EXPECT_GT(made, 10u);
}

// Models get unwrapped longitudes, so a jump is not a defect; other defects are repaired as elsewhere.
TEST(RepairTarget, TheAntimeridianIsNoDefect) {
  const auto repaired = [](double middle, double dent) {
    Random random(1);
    Grid grid = valuedGrid(random, [](int, int) { return true; });
    grid.crs = wgs84();
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
      Point& p = grid.nodes[i];
      if (i == 5 * (kSide + 1) + 6) p = {p.x + 0.6 * dent, p.y + dent};
      p = {std::remainder(middle + (p.x - kBorderX) * 1e-5, 360.0), p.y * 1e-5};
    }
    const BulkList<Point> before = grid.nodes;
    const RepairReport report = repairForTargets(grid, std::array{Target::Swan});
    if (dent == 0.0) {
      EXPECT_EQ(grid.nodes, before);
    }
    EXPECT_TRUE(report.left.empty());
    for (const Repair& repair : report.repairs)
      EXPECT_LT(std::abs(std::remainder(repair.place.x - middle, 360.0)), 0.1);
    for (const Repair& repair : report.repairs) EXPECT_LE(std::abs(repair.place.x), 180.0);
    return report.repairs.size();
  };
  EXPECT_EQ(repaired(180.0, 0.0), 0u);
  EXPECT_EQ(repaired(180.0, 850.0), repaired(100.0, 850.0));
  EXPECT_GT(repaired(180.0, 850.0), 0u);
}

// A line through a duplicated node continues with the triangles that it runs along.
TEST(RepairTarget, LinesThroughADoubledNode) {
  const TriMesh mesh = lattice(
      6, 6, [](int i, int j) { return (i < 3) == (j < 3); },
      [](int i, int j) {
        return Point{1000.0 * i - 500.0 * j, 866.0 * j};
      });
  Grid grid;
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  grid.boundaries = findBoundaries(mesh);
  const auto at = [](int i, int j) { return static_cast<std::uint32_t>(j * 7 + i); };
  grid.lines = {{LineKind::Weir, "through", false, {at(1, 1), at(2, 2), at(3, 3), at(4, 4), at(5, 5)}}};
  requireConsistent(grid);
  const RepairReport report = repairForTargets(grid, std::array{Target::Schism});
  EXPECT_EQ(std::ranges::count(report.repairs, TargetDefectKind::PinchedNode, &Repair::kind), 1);
  ASSERT_EQ(grid.lines.size(), 2u);
  EXPECT_EQ(grid.lines[0].nodes.size(), 3u);
  EXPECT_EQ(grid.lines[1].nodes.size(), 3u);
  EXPECT_NE(grid.lines[0].nodes.back(), grid.lines[1].nodes.front());
  EXPECT_EQ(grid.lines[0].name, grid.lines[1].name);
  requireConsistent(grid);
}

}  // namespace
}  // namespace coastmesh
