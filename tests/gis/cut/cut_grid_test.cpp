#include "gis/cut/cut_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "gis/check/check_target.hpp"
#include "gis/elements/quads.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/linked_grid.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/gis/quad_samples.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

using coastmesh::testing::inParts;
using coastmesh::testing::lattice;
using coastmesh::testing::sampleGrid;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Flags = std::vector<std::uint8_t>;

Grid gridOf(const TriMesh& mesh) {
  Grid grid;
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  grid.boundaries = findBoundaries(mesh);
  return grid;
}

// Flags of the triangles whose three corners are in the box.
Flags inBox(const Grid& grid, double west, double south, double east, double north) {
  Flags taken;
  for (const GridCorners& corners : grid.triangles)
    taken.push_back(std::ranges::all_of(corners, [&](std::uint32_t node) {
      const Point& p = grid.nodes[node];
      return west <= p.x && p.x <= east && south <= p.y && p.y <= north;
    }));
  return taken;
}

// The directed edges that only one triangle has.
std::set<NodePair> endsOfMesh(const Grid& grid) {
  std::set<NodePair> edges;
  for (const GridCorners& v : grid.triangles)
    for (unsigned i = 0; i < 3; ++i) edges.insert({v[i], v[(i + 1) % 3]});
  std::set<NodePair> ends;
  for (const auto& [a, b] : edges)
    if (!edges.contains({b, a})) ends.insert({a, b});
  return ends;
}

std::map<NodePair, BoundaryKind> kindsOf(const Grid& grid) {
  std::map<NodePair, BoundaryKind> kinds;
  for (const Boundary& boundary : grid.boundaries)
    for (const NodePair& edge : edgesOf(boundary))
      EXPECT_TRUE(kinds.emplace(edge, BoundaryKind{boundary.role, boundary.ibtype}).second) << "in two boundaries";
  return kinds;
}

// A part of an island is land, with the mainland's type.
BoundaryKind asPart(BoundaryKind kind) {
  if (kind.role == BoundaryRole::Island) kind.role = BoundaryRole::Land;
  if (kind.ibtype == 11) kind.ibtype = 10;
  return kind;
}

TEST(CutGrid, KeepsOrderAndValuesBitForBit) {
  Grid grid = inParts(sampleGrid(parseCrs("EPSG:4326"), {12.3, 45.6}, 0.01, 12));
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) grid.piece_of.push_back(t % 5);
  for (const Point& p : grid.nodes) grid.size_m.push_back(100.0 * p.x);
  grid.notes = {"NETA is wrong"};
  const Grid whole = grid;
  const CutReport report = cutGrid(grid, inBox(grid, 12.33, 45.62, 12.5, 45.7));
  ASSERT_LT(grid.triangles.size(), whole.triangles.size() / 2);
  ASSERT_EQ(report.nodes.size(), grid.nodes.size());
  ASSERT_EQ(report.triangles.size(), grid.triangles.size());
  EXPECT_EQ(report.nodes_before, whole.nodes.size());
  EXPECT_EQ(report.triangles_before, whole.triangles.size());
  EXPECT_TRUE(std::ranges::is_sorted(report.nodes));
  EXPECT_TRUE(std::ranges::is_sorted(report.triangles));
  for (std::size_t n = 0; n < grid.nodes.size(); ++n) {
    EXPECT_EQ(grid.nodes[n], whole.nodes[report.nodes[n]]);
    EXPECT_EQ(grid.z[n], whole.z[report.nodes[n]]);
    EXPECT_EQ(grid.size_m[n], whole.size_m[report.nodes[n]]);
  }
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    const std::uint32_t source = report.triangles[t];
    for (unsigned i = 0; i < 3; ++i) EXPECT_EQ(report.nodes[grid.triangles[t][i]], whole.triangles[source][i]);
    EXPECT_EQ(grid.min_angle_deg[t], whole.min_angle_deg[source]);
    EXPECT_EQ(grid.area_m2[t], whole.area_m2[source]);
    EXPECT_EQ(grid.piece_of[t], whole.piece_of[source]);
    EXPECT_EQ(grid.features[grid.feature_of[t]].fid, whole.features[whole.feature_of[source]].fid);
  }
  EXPECT_EQ(grid.title, whole.title);
  EXPECT_TRUE(sameCrs(grid.crs, whole.crs));
  EXPECT_TRUE(report.partition_dropped);
  EXPECT_THAT(grid.part_of, IsEmpty());
  EXPECT_THAT(grid.node_part_of, IsEmpty());
  EXPECT_THAT(grid.notes, IsEmpty());
  requireConsistent(grid);
}

TEST(CutGrid, DropsFeaturesWithoutTriangles) {
  Grid grid = sampleGrid(Crs{}, {0.0, 0.0}, 10.0, 6);
  cutGrid(grid, inBox(grid, 68.0, -10.0, 200.0, 200.0));
  ASSERT_EQ(grid.features.size(), 1u);
  EXPECT_EQ(grid.features[0].fid, 41);
}

TEST(CutGrid, LinesEndAtTheCut) {
  Grid grid = gridOf(lattice(8, 3, [](int, int) { return true; }));
  GridLine line{LineKind::Weir, "dam", false, {}};
  for (std::uint32_t i = 0; i <= 8; ++i) line.nodes.push_back(9 + i);
  grid.lines = {line};
  const CutReport report = cutGrid(grid, inBox(grid, 2, 0, 6, 3));
  ASSERT_EQ(grid.lines.size(), 1u);
  EXPECT_EQ(grid.lines[0].name, "dam");
  EXPECT_EQ(grid.lines[0].nodes.size(), 5u);
  EXPECT_EQ(report.nodes[grid.lines[0].nodes[0]], 11u);
  requireConsistent(grid);
}

// The types of all boundaries, found anew edge by edge, for random cuts of water with islands.
TEST(CutGrid, EveryEdgeOfTheBoundaryKeepsItsTypeOrIsOfTheCut) {
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const auto below = [&](std::uint64_t n) { return static_cast<int>(random() % n); };
    std::set<std::pair<int, int>> dry;
    for (int k = 0; k < 6; ++k) dry.insert({1 + below(10), 1 + below(10)});
    Grid grid = gridOf(lattice(12, 12, [&](int i, int j) { return !dry.contains({i, j}); }));
    // The outer shore in pieces of several kinds, islands of a type.
    const std::array kinds{BoundaryKind{BoundaryRole::Open}, BoundaryKind{BoundaryRole::Land},
                           BoundaryKind{BoundaryRole::River}, BoundaryKind{BoundaryRole::Land, 10}};
    std::vector<Boundary> boundaries;
    for (Boundary& boundary : grid.boundaries) {
      if (boundary.role == BoundaryRole::Island || boundary.nodes.size() < 20) {
        boundary.ibtype = random() % 2 == 0 ? 11 : -1;
        boundaries.push_back(boundary);
        continue;
      }
      std::size_t number = random() % 4, from = 0;
      const std::size_t n = boundary.nodes.size();
      while (from < n) {
        const std::size_t to = std::min(from + 1 + static_cast<std::size_t>(below(9)), n);
        const BoundaryKind& kind = kinds[number++ % 4];
        Boundary part{kind.role, false, {}, kind.ibtype};
        for (std::size_t k = from; k <= to; ++k) part.nodes.push_back(boundary.nodes[k % n]);
        boundaries.push_back(part);
        from = to;
      }
    }
    grid.boundaries = boundaries;
    const Grid whole = grid;
    Flags taken(grid.triangles.size());
    const int west = below(8), south = below(8);
    Flags box = inBox(grid, west, south, west + 3 + below(8), south + 3 + below(8));
    for (std::size_t t = 0; t < taken.size(); ++t) taken[t] = box[t] != 0 && random() % 12 != 0;
    if (std::ranges::find(taken, 1) == taken.end()) continue;
    const BoundaryRole cut_role = random() % 2 == 0 ? BoundaryRole::Open : BoundaryRole::Land;
    Grid again = grid;
    const CutReport report = cutGrid(grid, taken, {.cut_role = cut_role});
    requireConsistent(grid);
    const std::size_t beyond = static_cast<std::size_t>(
        std::ranges::count_if(report.triangles, [&](std::uint32_t t) { return taken[t] == 0; }));
    EXPECT_LE(beyond, report.evened.taken_in);

    const auto before = kindsOf(whole), after = kindsOf(grid);
    const std::set<NodePair> ends = endsOfMesh(grid), whole_ends = endsOfMesh(whole);
    EXPECT_EQ(after.size(), ends.size());
    for (const NodePair& edge : ends) {
      const NodePair source{report.nodes[edge[0]], report.nodes[edge[1]]};
      ASSERT_TRUE(after.contains(edge));
      const BoundaryKind kind = asPart(after.at(edge));
      if (whole_ends.contains(source)) {
        EXPECT_EQ(kind, asPart(before.at(source)));
      } else {
        EXPECT_EQ(kind.role, cut_role);
      }
    }
    // Islands are whole, and no node holds parts together alone unless it did before.
    for (const Boundary& boundary : grid.boundaries)
      EXPECT_TRUE(boundary.role != BoundaryRole::Island || boundary.closed);
    std::set<Point, decltype(&lexLess)> pinched(&lexLess);
    for (const TargetDefect& defect : checkTarget(whole, Target::Adcirc))
      if (defect.kind == TargetDefectKind::PinchedNode) pinched.insert(defect.place);
    for (const TargetDefect& defect : checkTarget(grid, Target::Adcirc))
      EXPECT_TRUE(defect.kind != TargetDefectKind::PinchedNode || pinched.contains(defect.place));
    // The same with another order of the work.
    const CutReport backwards = cutGrid(again, taken, {.cut_role = cut_role}, testing::backwards);
    EXPECT_EQ(backwards.nodes, report.nodes);
    ASSERT_EQ(again.boundaries.size(), grid.boundaries.size());
    for (std::size_t b = 0; b < grid.boundaries.size(); ++b)
      EXPECT_EQ(again.boundaries[b].nodes, grid.boundaries[b].nodes);
  }
}

TEST(CutGrid, BoundariesKeepTheirOrderAndDirectionAndThoseOfTheCutComeLast) {
  Grid grid = gridOf(lattice(6, 2, [](int, int) { return true; }));
  const auto at = [](std::uint32_t i, std::uint32_t j) { return 7 * j + i; };
  // Against the direction of the mesh, as files may have it.
  const Boundary river{BoundaryRole::River, false, {at(0, 2), at(0, 1), at(0, 0)}, 52};
  Boundary south{BoundaryRole::Land, false, {}, 0}, rest{BoundaryRole::Land, false, {at(6, 0), at(6, 1)}};
  for (std::uint32_t i = 7; i > 0; --i) south.nodes.push_back(at(i - 1, 0));
  for (std::uint32_t i = 7; i > 0; --i) rest.nodes.push_back(at(i - 1, 2));
  grid.boundaries = {south, river, rest};
  const CutReport report = cutGrid(grid, inBox(grid, 0, 0, 3, 2));
  EXPECT_EQ(report.boundaries_kept, 3u);
  EXPECT_EQ(report.boundaries_cut, 1u);
  ASSERT_EQ(grid.boundaries.size(), 4u);
  EXPECT_THAT(grid.boundaries[0].nodes, ElementsAre(3, 2, 1, 0));
  EXPECT_EQ(grid.boundaries[0].ibtype, 0);
  EXPECT_THAT(grid.boundaries[1].nodes, ElementsAre(8, 4, 0));
  EXPECT_EQ(grid.boundaries[1].ibtype, 52);
  EXPECT_EQ(grid.boundaries[3].role, BoundaryRole::Open);
  EXPECT_THAT(grid.boundaries[3].nodes, ElementsAre(3, 7, 11));
}

TEST(CutGrid, ALoopIsDividedAwayFromItsFirstNode) {
  Grid grid = gridOf(lattice(6, 2, [](int, int) { return true; }));
  ASSERT_EQ(grid.boundaries.size(), 1u);
  ASSERT_EQ(grid.nodes[grid.boundaries[0].nodes[0]], (Point{0, 0}));
  cutGrid(grid, inBox(grid, 0, 0, 3, 2));
  ASSERT_EQ(grid.boundaries.size(), 2u);  // not divided where the loop began
  EXPECT_EQ(grid.boundaries[0].nodes.size(), 9u);
  EXPECT_FALSE(grid.boundaries[0].closed);
}

TEST(CutGrid, ACutAllAroundIsALoop) {
  const Grid whole = gridOf(lattice(9, 9, [](int, int) { return true; }));
  Grid inside = whole, outside = whole;
  Flags box = inBox(whole, 3, 3, 6, 6);
  cutGrid(inside, box, {.cut_role = BoundaryRole::Land});
  ASSERT_EQ(inside.boundaries.size(), 1u);
  EXPECT_TRUE(inside.boundaries[0].closed);
  EXPECT_EQ(inside.boundaries[0].role, BoundaryRole::Land);
  for (std::uint8_t& flag : box) flag = flag == 0;
  cutGrid(outside, box, {.cut_role = BoundaryRole::Land});
  ASSERT_EQ(outside.boundaries.size(), 2u);
  EXPECT_TRUE(outside.boundaries[1].closed);
  EXPECT_EQ(outside.boundaries[1].role, BoundaryRole::Island);
}

// Two waters with a weir between them, from x = 2 to 3.
Grid weirGrid() {
  Grid grid = gridOf(lattice(5, 6, [](int i, int) { return i != 2; }));
  const auto at = [](std::uint32_t i, std::uint32_t j) { return 6 * j + i; };
  Boundary weir{BoundaryRole::Land, false, {}, 24};
  Boundary west{BoundaryRole::Land, false, {}}, east = west;
  for (std::uint32_t j = 0; j <= 6; ++j) {
    weir.nodes.push_back(at(2, j));
    weir.back_nodes.push_back(at(3, j));
    weir.weir.insert(weir.weir.end(), {1.0 + j, 0.5, 0.25});
  }
  west.nodes = {at(2, 6), at(1, 6), at(0, 6)};
  for (std::uint32_t j = 6; j > 0; --j) west.nodes.push_back(at(0, j - 1));
  west.nodes.insert(west.nodes.end(), {at(1, 0), at(2, 0)});
  east.nodes = {at(3, 0), at(4, 0)};
  for (std::uint32_t j = 0; j <= 6; ++j) east.nodes.push_back(at(5, j));
  east.nodes.insert(east.nodes.end(), {at(4, 6), at(3, 6)});
  grid.boundaries = {west, weir, east};
  return grid;
}

TEST(CutGrid, WeirsKeepWhatBothShoresAreLeftOf) {
  Grid grid = weirGrid();
  // The west from y = 0 to 5, the east from 2 to 6.
  Flags taken = inBox(grid, 0, 0, 2, 5), east = inBox(grid, 3, 2, 5, 6);
  for (std::size_t t = 0; t < taken.size(); ++t) taken[t] |= east[t];
  const CutReport report = cutGrid(grid, taken);
  const auto isWeir = [](const Boundary& boundary) { return !boundary.weir.empty(); };
  ASSERT_EQ(std::ranges::count_if(grid.boundaries, isWeir), 1);
  const Boundary& weir = *std::ranges::find_if(grid.boundaries, isWeir);
  EXPECT_EQ(weir.ibtype, 24);
  ASSERT_EQ(weir.nodes.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(grid.nodes[weir.nodes[i]], (Point{2, 2.0 + double(i)}));
    EXPECT_EQ(grid.nodes[weir.back_nodes[i]], (Point{3, 2.0 + double(i)}));
    EXPECT_EQ(weir.weir[3 * i], 3.0 + double(i));
  }
  EXPECT_EQ(weir.weir.size(), 12u);
  // Edges of each shore are alone now: land, with the mesh to its left.
  EXPECT_EQ(report.walls, 2u);
  const std::set<NodePair> ends = endsOfMesh(grid);
  std::size_t walls = 0;
  for (const Boundary& boundary : grid.boundaries) {
    for (const auto& [a, b] : edgesOf(boundary)) {
      EXPECT_TRUE(ends.contains({a, b}));
      const bool west_wall = grid.nodes[a].x == 2.0 && grid.nodes[b].x == 2.0 && grid.nodes[b].y <= 2.0;
      const bool east_wall = grid.nodes[a] == Point{3, 6} && grid.nodes[b] == Point{3, 5};
      if (!west_wall && !east_wall) continue;
      ++walls;
      EXPECT_EQ(boundary.role, BoundaryRole::Land);
      EXPECT_EQ(boundary.ibtype, -1);
    }
  }
  EXPECT_EQ(walls, 3u);
}

TEST(CutGrid, AWeirThatIsWholeStaysAsItIs) {
  Grid grid = weirGrid();
  const Grid whole = grid;
  const CutReport report = cutGrid(grid, Flags(grid.triangles.size(), 1));
  EXPECT_EQ(report.walls, 0u);
  EXPECT_EQ(report.boundaries_cut, 0u);
  ASSERT_EQ(grid.boundaries.size(), whole.boundaries.size());
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_EQ(grid.boundaries[b].nodes.size(), whole.boundaries[b].nodes.size());
    EXPECT_EQ(grid.boundaries[b].weir, whole.boundaries[b].weir);
  }
}

TEST(CutGrid, BoundariesOffTheMeshAreLeftOutAndCounted) {
  Grid grid = gridOf(lattice(6, 3, [](int, int) { return true; }));
  grid.boundaries.push_back({BoundaryRole::Open, false, {7, 8, 9}});  // inside
  EXPECT_EQ(cutGrid(grid, inBox(grid, 0, 0, 4, 3)).stray_edges, 2u);
  EXPECT_EQ(std::ranges::count(grid.boundaries, BoundaryRole::Open, &Boundary::role), 1);  // the cut's
}

TEST(CutGrid, OfSeveralWatersTheLargestByAreaIsKeptOnRequest) {
  // The right water is one square, but larger on the ground than the five to the left.
  const Grid whole = gridOf(lattice(
      8, 1, [](int, int) { return true; },
      [](int i, int j) {
        return Point{i < 7 ? double(i) : double(10 * i), 10.0 * j};
      }));
  Flags taken(whole.triangles.size(), 1);
  for (const std::size_t t : {10u, 11u, 12u, 13u}) taken[t] = 0;
  Grid all = whole, one = whole;
  EXPECT_EQ(cutGrid(all, taken).waters, 2u);
  EXPECT_EQ(all.triangles.size(), 12u);
  const CutReport report = cutGrid(one, taken, {.largest_water = true});
  EXPECT_EQ(report.waters, 2u);
  EXPECT_EQ(report.left_out, 1u);
  EXPECT_GT(one.nodes[0].x, 50.0);
}

TEST(TidyCut, TrianglesThatOnlyANodeConnectsAreLeftOut) {
  // Nine squares, and four that touch them at a corner: the one there goes.
  Grid grid = gridOf(lattice(6, 6, [](int, int) { return true; }));
  Flags taken = inBox(grid, 0, 0, 3, 3), other = inBox(grid, 3, 3, 5, 5);
  for (std::size_t t = 0; t < taken.size(); ++t) taken[t] |= other[t];
  EXPECT_EQ(tidyCut(linkGrid(grid).mesh, {}, taken).loose, 2u);
  EXPECT_EQ(cutGrid(grid, taken).waters, 2u);
  for (const TargetDefect& defect : checkTarget(grid, Target::Adcirc))
    EXPECT_NE(defect.kind, TargetDefectKind::PinchedNode);
}

TEST(TidyCut, APinchedNodeOfTheMeshStays) {
  // Two waters that touch in a node; the cut runs through both, but not through the node.
  Grid grid = gridOf(lattice(6, 6, [](int i, int j) { return (i < 3) == (j < 3); }));
  const CutReport report = cutGrid(grid, inBox(grid, 1, 1, 5, 5));
  EXPECT_EQ(report.tidied.loose, 0u);
  EXPECT_EQ(report.waters, 2u);
  EXPECT_EQ(grid.triangles.size(), 16u);
}

TEST(TidyCut, TrianglesThatStickOutAreLeftOutOnce) {
  const Grid whole = gridOf(lattice(6, 3, [](int, int) { return true; }));
  // Nine squares, and one triangle beside them.
  Flags taken = inBox(whole, 0, 0, 3, 3);
  const auto beside =
      static_cast<std::size_t>(std::ranges::find(whole.triangles, GridCorners{10, 18, 17}) - whole.triangles.begin());
  ASSERT_LT(beside, taken.size());
  taken[beside] = 1;
  const TriMesh mesh = linkGrid(whole).mesh;
  EXPECT_EQ(tidyCut(mesh, {}, taken).teeth, 1u);
  EXPECT_EQ(std::ranges::count(taken, 1), 18);
  // Of two triangles alone neither goes.
  Flags two = inBox(whole, 2, 1, 3, 2);
  EXPECT_EQ(tidyCut(mesh, {}, two).teeth, 0u);
  EXPECT_EQ(std::ranges::count(two, 1), 2);
  // Nor does a single one.
  Flags single(whole.triangles.size(), 0);
  single[5] = 1;
  Grid one = whole;
  cutGrid(one, single);
  EXPECT_EQ(one.triangles.size(), 1u);
  // Of three in a row, apart from others, two stick out, which leaves one alone.
  Flags row = inBox(whole, 0, 0, 2, 3);
  const Flags square = inBox(whole, 4, 1, 5, 2), next = inBox(whole, 5, 1, 6, 2);
  for (std::size_t t = 0; t < row.size(); ++t) {
    const auto on_side = std::ranges::count_if(whole.triangles[t], [&](std::uint32_t n) {
      return whole.nodes[n] == Point{5, 1} || whole.nodes[n] == Point{5, 2};
    });
    if (square[t] != 0 || (next[t] != 0 && on_side == 2)) row[t] = 1;
  }
  EXPECT_EQ(tidyCut(mesh, {}, row).teeth, 3u);
  EXPECT_EQ(std::ranges::count(row, 1), 12);
  // A river one element wide stays.
  Grid river = gridOf(lattice(12, 1, [](int, int) { return true; }));
  cutGrid(river, inBox(river, 2, 0, 9, 1));
  EXPECT_EQ(river.triangles.size(), 14u);
}

// Whatever part is cut out, no half of a quadrilateral is left alone, and what models would reject is left out.
TEST(CutGrid, QuadrilateralsAreTakenWhole) {
  std::mt19937 random(20261128);
  for (int trial = 0; trial < 200; ++trial) {
    Grid grid = coastmesh::testing::mixedGrid(8, 6, [&](int, int) { return random() % 2 == 0; });
    const std::size_t quads = quadsOf(grid).size();
    Flags taken;
    for (std::size_t t = 0; t < grid.triangles.size(); ++t) taken.push_back(random() % 4 != 0 ? 1 : 0);
    const CutReport report = cutGrid(grid, taken, {});
    EXPECT_EQ(std::ranges::count_if(grid.quad_of, [](std::uint32_t quad) { return quad != kNone; }),
              2 * static_cast<std::ptrdiff_t>(quadsOf(grid).size()));
    EXPECT_LE(quadsOf(grid).size(), quads);
    requireConsistent(grid);
    const std::vector<std::uint32_t> other = otherHalves(grid);
    const TriMesh mesh = linkGrid(grid).mesh;
    for (TriId t = 0; t < grid.triangles.size() && report.waters == 1; ++t)
      EXPECT_LT(std::ranges::count(mesh.triangles[t].adj, kNone), 3) << trial;
  }
}

// A quadrilateral with two sides along the cut is no tooth, one with three is.
TEST(CutGrid, TeethOfQuadrilaterals) {
  const auto row = [](int columns, int rows) {
    return coastmesh::testing::mixedGrid(columns, rows, [](int, int) { return true; });
  };
  Grid grid = row(4, 3);
  Flags taken(grid.triangles.size(), 0);
  const auto take = [&](double west, double south, double east, double north) {
    for (const Quad& quad : quadsOf(grid)) {
      Point middle{};
      for (const std::uint32_t node : quad.nodes)
        middle = {middle.x + grid.nodes[node].x / 4, middle.y + grid.nodes[node].y / 4};
      if (middle.x < west || middle.x > east || middle.y < south || middle.y > north) continue;
      for (const std::uint32_t t : quad.halves) taken[t] = 1;
    }
  };
  take(0, 0, 4, 2);  // two by two
  take(4, 1, 6, 2);  // and one more beside them
  EXPECT_EQ(tidyCut(linkGrid(grid).mesh, otherHalves(grid), taken).teeth, 1u);
  EXPECT_EQ(std::ranges::count(taken, 1), 8);
}

}  // namespace
}  // namespace coastmesh
