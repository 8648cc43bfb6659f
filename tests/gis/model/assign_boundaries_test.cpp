// Boundary types from polygons, lines and depths.
#include "gis/model/assign_boundaries.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gis/error.hpp"
#include "gis/repair/repair_target.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::HasSubstr;
using testing::lattice;
using testing::TemporaryFolder;

// A square from (10, 50) to (20, 60), squares of one degree, with an island of one square.
Grid sea() {
  const TriMesh mesh = lattice(
      10, 10, [](int i, int j) { return i != 4 || j != 4; },
      [](int i, int j) {
        return Point{10.0 + i, 50.0 + j};
      });
  Grid grid;
  grid.crs = wgs84();
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  grid.boundaries = findBoundaries(mesh);
  return grid;
}

std::size_t edgesOfRole(const Grid& grid, BoundaryRole role) {
  std::size_t count = 0;
  for (const Boundary& boundary : grid.boundaries)
    if (boundary.role == role) count += edgesOf(boundary).size();
  return count;
}

// The boundaries contain every edge of the mesh's boundary exactly once.
void expectWholeBoundary(const Grid& grid) {
  std::vector<NodePair> told, edges;
  for (const Boundary& boundary : grid.boundaries)
    for (const NodePair& edge : edgesOf(boundary)) told.push_back(edge);
  for (const auto& loop : boundaryLoops(grid))
    for (std::size_t i = 0; i < loop.size(); ++i) edges.push_back({loop[i], loop[(i + 1) % loop.size()]});
  std::ranges::sort(told);
  std::ranges::sort(edges);
  EXPECT_EQ(told, edges);
}

class AssignBoundaries : public ::testing::Test {
 protected:
  std::string put(const std::string& name, const std::string& features) {
    std::ofstream(folder_ / name) << R"({"type":"FeatureCollection","features":[)" << features << "]}";
    return folder_ / name;
  }
  static std::string feature(const std::string& type, const std::string& geometry, const std::string& coordinates) {
    return R"({"type":"Feature","properties":{"type":)" + type + R"(},"geometry":{"type":")" + geometry +
           R"(","coordinates":)" + coordinates + "}}";
  }

  TemporaryFolder folder_;
};

TEST_F(AssignBoundaries, PolygonsTellWhatLiesInThem) {
  Grid grid = sea();
  const auto file =
      put("types.geojson", feature("\"Ocean\"", "Polygon", "[[[9,52.5],[11,52.5],[11,57.5],[9,57.5],[9,52.5]]]") + "," +
                               feature("\"22\"", "Polygon", "[[[19,53],[21,53],[21,55],[19,55],[19,53]]]"));
  BoundaryOptions options;
  options.files = {file};
  const BoundaryReport report = assignBoundaries(grid, options);
  // Middles at 53.5, 54.5, 55.5 and 56.5; those at 52.5 and 57.5 are on the polygon's boundary, and may count or not.
  EXPECT_GE(edgesOfRole(grid, BoundaryRole::Open), 4u);
  EXPECT_LE(edgesOfRole(grid, BoundaryRole::Open), 6u);
  EXPECT_EQ(edgesOfRole(grid, BoundaryRole::River), 2u);
  EXPECT_EQ(edgesOfRole(grid, BoundaryRole::Island), 4u);
  EXPECT_EQ(report.edges_by_file, edgesOfRole(grid, BoundaryRole::Open) + 2);
  expectWholeBoundary(grid);
}

TEST_F(AssignBoundaries, LinesTellWhatRunsAlongThem) {
  Grid grid = sea();
  // Along half of the southern side, not quite on it; the other side at the corner does not count.
  const auto file = put("types.geojson", feature("\"open\"", "LineString", "[[10,50.01],[13,49.98],[15,50]]"));
  BoundaryOptions options;
  options.files = {file};
  assignBoundaries(grid, options);
  EXPECT_EQ(edgesOfRole(grid, BoundaryRole::Open), 5u);
  expectWholeBoundary(grid);
}

TEST_F(AssignBoundaries, AFileThatSaysNothingOfTheBoundaryIsWarnedOf) {
  Grid grid = sea();
  const auto near = put("near.geojson", feature("\"open\"", "LineString", "[[10,50],[10,60]]"));
  const auto far = put("far.geojson", feature("\"open\"", "LineString", "[[8.9,50],[8.9,60]]"));
  BoundaryOptions options;
  options.files = {near};
  EXPECT_TRUE(assignBoundaries(grid, options).warnings.empty());
  options.files = {near, far};
  const BoundaryReport report = assignBoundaries(grid, options);
  EXPECT_EQ(report.edges_by_file, 10u);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_THAT(report.warnings[0], HasSubstr("far.geojson': says nothing of the mesh's boundary"));
}

// One of several rivers may be missing for the model alone.
TEST_F(AssignBoundaries, AFeatureThatSaysNothingOfTheBoundaryIsNamed) {
  Grid grid = sea();
  BoundaryOptions options;
  options.files = {put("rivers.geojson", feature("\"river\"", "LineString", "[[10,51],[10,53]]") + "," +
                                             feature("\"river\"", "LineString", "[[12.5,53],[12.5,57]]") + "," +
                                             feature("\"river\"", "LineString", "[[30,50],[40,50]]"))};
  const BoundaryReport report = assignBoundaries(grid, options);
  EXPECT_TRUE(report.warnings.empty());
  ASSERT_EQ(report.missed.size(), 1u);
  const std::vector<std::string> warnings = missedWarnings(report.missed[0]);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("rivers.geojson': these openings or rivers are not in the mesh"));
  EXPECT_THAT(warnings[0], HasSubstr("feature 1 at (12.5, 55)"));
  EXPECT_THAT(warnings[0], ::testing::Not(HasSubstr("feature 2")));
}

// Where the water ends before its frame does.
TEST_F(AssignBoundaries, AFeatureInTheFrameIsNamedThoughTheMeshEndsBefore) {
  const std::string river =
      feature("\"river\",\"name\":\"Meghna\"", "Polygon", "[[[14,60.5],[15,60.5],[15,60.8],[14,60.8],[14,60.5]]]");
  BoundaryOptions options;
  options.files = {put("rivers.geojson", feature("\"river\"", "LineString", "[[10,51],[10,53]]") + "," + river)};
  const auto warnings = [&] {
    Grid grid = sea();
    std::string all;
    for (const MissedOfFile& file : assignBoundaries(grid, options).missed)
      for (const std::string& warning : missedWarnings(file)) all += warning;
    return all;
  };
  EXPECT_EQ(warnings(), "");
  for (const Box& frame : {Box{9.0, 49.0, 21.0, 61.0}, Box{369.0, 49.0, 381.0, 61.0}, Box{9.0, 49.0, 21.0, 60.6},
                           Box{9.0, 49.0, -179.0, 61.0}}) {
    options.frame = frame;
    EXPECT_THAT(warnings(), HasSubstr("feature 1 'Meghna' at (14.5, 60.65)"));
  }
  for (const Box& frame : {Box{9.0, 49.0, 21.0, 60.4}, Box{9.0, 49.0, 13.9, 61.0}, Box{15.1, 49.0, 13.9, 61.0}}) {
    options.frame = frame;
    EXPECT_EQ(warnings(), "");
  }
}

TEST_F(AssignBoundaries, AShortRiverOfAFileIsNotMergedAway) {
  Grid grid = sea();
  for (const Point& node : grid.nodes) grid.z.push_back(node.x > 19.5 && node.y < 52.5 ? -100.0 : -1.0);
  BoundaryOptions options;
  // Two edges of the west each, with one between.
  options.files = {put("river.geojson", feature("\"river\"", "LineString", "[[10,54],[10,56]]") + "," +
                                            feature("\"open\"", "MultiPolygon",
                                                    "[[[[9,50.9],[11,50.9],[11,53.1],[9,53.1],[9,50.9]]]]"))};
  options.open_deeper_m = 50.0;  // two edges of the east
  options.least_length_m = 500'000.0;
  const BoundaryReport report = assignBoundaries(grid, options);
  EXPECT_EQ(edgesOfRole(grid, BoundaryRole::River) + edgesOfRole(grid, BoundaryRole::Open), 5u);
  EXPECT_GE(edgesOfRole(grid, BoundaryRole::River), 2u);
  EXPECT_GE(edgesOfRole(grid, BoundaryRole::Open), 2u);
  EXPECT_EQ(report.merged, 2u);  // the shore between, and what depths open
  expectWholeBoundary(grid);
}

TEST_F(AssignBoundaries, LinesOpenIslands) {
  Grid grid = sea();
  BoundaryOptions options;
  options.files = {
      put("island.geojson", feature("\"open\"", "LineString", "[[14,54],[15,54],[15,55],[14,55],[14,54]]"))};
  assignBoundaries(grid, options);
  EXPECT_EQ(edgesOfRole(grid, BoundaryRole::Open), 4u);
  EXPECT_EQ(edgesOfRole(grid, BoundaryRole::Island), 0u);
}

TEST_F(AssignBoundaries, TheLastFeatureCounts) {
  Grid grid = sea();
  const std::string square = "[[[9,49],[21,49],[21,61],[9,61],[9,49]]]";
  BoundaryOptions options;
  options.files = {put("a.geojson", feature("\"open\"", "Polygon", square)),
                   put("b.geojson", feature("\"10\"", "Polygon", "[[[9,59.5],[21,59.5],[21,61],[9,61],[9,59.5]]]"))};
  assignBoundaries(grid, options);
  std::size_t no_slip = 0;
  for (const Boundary& boundary : grid.boundaries)
    if (boundary.ibtype == 10) no_slip += edgesOf(boundary).size();
  EXPECT_GE(no_slip, 10u);  // the north, and possibly an edge at either end, whose middle is on the polygon's boundary
  EXPECT_LE(no_slip, 12u);
  EXPECT_EQ(edgesOfRole(grid, BoundaryRole::Open), 40u - no_slip);
  EXPECT_EQ(edgesOfRole(grid, BoundaryRole::Island), 4u);  // islands inside the polygon stay closed
  expectWholeBoundary(grid);
}

TEST_F(AssignBoundaries, LayersOfAnyCrsAndOtherTurns) {
  Grid grid = sea();
  BoundaryOptions options;
  options.files = {
      put("turn.geojson", feature("\"open\"", "Polygon", "[[[369,49],[371,49],[371,61],[369,61],[369,49]]]"))};
  assignBoundaries(grid, options);
  EXPECT_EQ(edgesOfRole(grid, BoundaryRole::Open), 12u);  // the west, and an edge at each of its ends
}

TEST_F(AssignBoundaries, DepthOpensOuterLoopsOnly) {
  Grid grid = sea();
  for (const Point& node : grid.nodes) grid.z.push_back(-10.0 * (node.x - 10.0));
  BoundaryOptions options;
  options.open_deeper_m = 25.0;
  EXPECT_TRUE(assignBoundaries(grid, options).warnings.empty());
  EXPECT_EQ(edgesOfRole(grid, BoundaryRole::Open), 7u + 10u + 7u);
  EXPECT_EQ(edgesOfRole(grid, BoundaryRole::Island), 4u);
  expectWholeBoundary(grid);
  options.open_deeper_m = 1000.0;
  const BoundaryReport none = assignBoundaries(grid, options);
  ASSERT_EQ(none.warnings.size(), 1u);
  EXPECT_EQ(none.warnings[0].find("--open-deeper 1000 opens no boundary: its deepest edge is at "), 0u);
  grid.z.clear();
  EXPECT_THROW(assignBoundaries(grid, options), OptionError);
}

TEST_F(AssignBoundaries, ACoastThatDepthOpensIsWarnedOf) {
  Grid grid = sea();
  // The south winds, and is shallow in its middle.
  for (Point& node : grid.nodes) {
    grid.z.push_back(node.y == 50.0 && node.x != 14.0 ? -100.0 : -1.0);
    if (node.y == 50.0) node.y -= static_cast<int>(node.x) % 2 == 0 ? 0.3 : 0.0;
  }
  BoundaryOptions options;
  options.open_deeper_m = 50.0;
  const BoundaryReport report = assignBoundaries(grid, options);
  EXPECT_EQ(report.edges_by_depth, 8u);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_THAT(report.warnings[0], HasSubstr("--open-deeper 50 opens a winding line"));
  EXPECT_THAT(report.warnings[0], HasSubstr(" in 2 parts, the longest of 39"));  // five edges of some 78 km
  EXPECT_THAT(report.warnings[0], HasSubstr(" km, at (17, 50"));
}

TEST_F(AssignBoundaries, OpeningsOfOneEdgeAreCounted) {
  Grid grid = sea();
  EXPECT_EQ(loneOpenings(grid).count, 0u);
  grid.boundaries = cutLoops(grid, boundaryLoops(grid), [&](std::uint32_t a, std::uint32_t b) {
    const double x = std::min(grid.nodes[a].x, grid.nodes[b].x), y = std::max(grid.nodes[a].y, grid.nodes[b].y);
    const bool lone = y == 50.0 && x == 12.0, both = std::min(grid.nodes[a].y, grid.nodes[b].y) == 60.0 && x < 12.0;
    return BoundaryKind{lone || both ? BoundaryRole::Open : BoundaryRole::Land};
  });
  const LoneOpenings lone = loneOpenings(grid);
  EXPECT_EQ(lone.count, 1u);
  EXPECT_NEAR(lone.longest_m, 71'700.0, 100.0);
  EXPECT_NEAR(lone.place.x, 12.5, 1e-9);
  EXPECT_NEAR(lone.place.y, 50.0, 0.01);
}

// Programs count open boundaries: one for each forcing.
TEST_F(AssignBoundaries, AdjacentOpenBoundariesStayApart) {
  Grid grid = sea();
  const auto loops = boundaryLoops(grid);
  grid.boundaries = cutLoops(grid, loops, [&](std::uint32_t a, std::uint32_t b) {
    const bool south = grid.nodes[a].y == 50.0 && grid.nodes[b].y == 50.0;
    const bool east = grid.nodes[a].x == 20.0 && grid.nodes[b].x == 20.0;
    return BoundaryKind{south || east ? BoundaryRole::Open : BoundaryRole::Land, -1, east ? 1u : 0u};
  });
  const auto open = [&] {
    return std::ranges::count_if(grid.boundaries, [](const Boundary& b) { return b.role == BoundaryRole::Open; });
  };
  ASSERT_EQ(open(), 2);
  BoundaryOptions options;
  options.least_length_m = 1.0;
  assignBoundaries(grid, options);
  EXPECT_EQ(open(), 2);
  grid.nodes.push_back({30.0, 50.0});  // an unused node, which repairs remove
  EXPECT_FALSE(repairForTargets(grid, std::array{Target::Adcirc}).repairs.empty());
  EXPECT_EQ(open(), 2);
  expectWholeBoundary(grid);
}

TEST_F(AssignBoundaries, ShortOnesBecomePartOfLongerOnes) {
  Grid grid = sea();
  for (const Point& node : grid.nodes) {
    const bool shallow = node.y == 50.0 && (node.x == 14.0 || node.x == 17.0);  // divide the southern side in three
    grid.z.push_back(shallow || node.y > 50.0 ? -1.0 : -100.0);
  }
  BoundaryOptions options;
  options.open_deeper_m = 50.0;
  assignBoundaries(grid, options);
  EXPECT_EQ(grid.boundaries.size(), 7u);  // three open, three of land between and around them, the island
  grid.boundaries.clear();
  options.least_length_m = 100'000.0;  // an edge there is 71 km, two are 143
  const BoundaryReport report = assignBoundaries(grid, options);
  EXPECT_GT(report.merged, 0u);
  for (const Boundary& boundary : grid.boundaries) {
    if (!boundary.closed) {
      EXPECT_GE(boundary.nodes.size(), 3u);
    }
  }
  expectWholeBoundary(grid);
}

TEST_F(AssignBoundaries, TellsWhichFeatureHasNoType) {
  Grid grid = sea();
  BoundaryOptions options;
  options.files = {put("bad.geojson", feature("\"moon\"", "Polygon", "[[[9,49],[21,49],[21,61],[9,49]]]"))};
  try {
    assignBoundaries(grid, options);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("moon"));
    EXPECT_THAT(error.what(), HasSubstr("bad.geojson"));
  }
}

}  // namespace
}  // namespace coastmesh
