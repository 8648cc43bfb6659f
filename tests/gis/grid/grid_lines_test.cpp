// Lines, names, regions and types of boundaries: every format returns what it claims to hold, and everything else is
// reported.
#include "gis/grid/grid_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "gis/error.hpp"
#include "gis/format/grid_losses.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid_edit.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::HasSubstr;
using testing::lattice;
using ::testing::Not;
using testing::TemporaryFolder;

using Edges = std::vector<NodePair>;

std::vector<std::uint32_t> nodesOf(const GridLine& line) { return line.nodes; }

TEST(ChainLines, AreOneWhereTheyGoOn) {
  const auto lines = chainLines(Edges{{3, 2}, {7, 3}, {2, 9}, {2, 3}}, LineKind::Weir, "dam");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].kind, LineKind::Weir);
  EXPECT_EQ(lines[0].name, "dam");
  EXPECT_FALSE(lines[0].closed);
  EXPECT_EQ(nodesOf(lines[0]), (std::vector<std::uint32_t>{7, 3, 2, 9}));
}

TEST(ChainLines, EndWhereMoreThanTwoEdgesMeet) {
  const auto lines = chainLines(Edges{{0, 1}, {1, 2}, {1, 3}, {3, 4}}, LineKind::Constraint, "");
  ASSERT_EQ(lines.size(), 3u);
  std::size_t edges = 0;
  for (const GridLine& line : lines) edges += edgesOf(line).size();
  EXPECT_EQ(edges, 4u);
}

TEST(ChainLines, LoopsAreClosed) {
  const auto lines = chainLines(Edges{{5, 4}, {4, 6}, {6, 5}}, LineKind::RegionBorder, "");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_EQ(nodesOf(lines[0]), (std::vector<std::uint32_t>{4, 5, 6}));
  EXPECT_EQ(edgesOf(lines[0]).size(), 3u);
}

// A lake of 6 by 6 cells with an island, in two regions and a rest; an open line and a closed one inside; types of
// boundaries that roles do not express.
Grid namedGrid() {
  const TriMesh mesh = lattice(
      6, 6, [](int i, int j) { return i != 4 || j != 4; },
      [](int i, int j) {
        return Point{10.0 + 0.01 * i, 50.0 + 0.01 * j};
      });
  Grid grid;
  grid.crs = wgs84();
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  grid.features = {{4, "a.shp", {{"name", "Lake"}}, "inner bay"},
                   {4, "a.shp", {{"name", "Lake"}}, "Üfer, west"},
                   {9, "a.shp", {}, ""}};
  for (const auto& corners : grid.triangles) {
    const std::uint32_t least = std::ranges::min(corners);
    grid.feature_of.push_back(least % 7 < 2 ? 0 : least % 7 < 4 ? 1 : 2);
  }
  grid.boundaries = findBoundaries(mesh);
  for (Boundary& boundary : grid.boundaries) {
    const bool is_island = boundary.role == BoundaryRole::Island;
    boundary.ibtype = is_island ? 11 : 10;
    boundary.name = is_island ? "Nès, 2: boundary 3" : "";
  }
  const auto at = [](std::uint32_t i, std::uint32_t j) { return j * 7 + i; };
  grid.lines = {{LineKind::Weir, "Old dam, 1950", false, {at(1, 1), at(2, 1), at(3, 1), at(4, 2)}},
                {LineKind::Constraint, "", false, {at(1, 5), at(2, 5)}},
                {LineKind::RegionBorder, "inner bay", true, {at(1, 2), at(2, 2), at(2, 3), at(1, 3)}},
                {LineKind::Weir, "Old dam, 1950", false, {at(1, 4), at(2, 4)}}};
  return grid;
}

std::string endingOf(const GridFormat& format) { return std::string(format.endings.front()); }

Grid throughFile(const Grid& grid, const GridFormat& format, const TemporaryFolder& folder) {
  const std::string path = folder / ("lake" + endingOf(format));
  StagedOutput output(path, format, true);
  output.write(grid);
  output.commit();
  return readGrid(path);
}

class NamedGrid : public ::testing::TestWithParam<GridFormat> {};

TEST_P(NamedGrid, ComesBackAsTheFormatSays) {
  const GridFormat& format = GetParam();
  const Grid grid = namedGrid();
  const TemporaryFolder folder;
  const Grid got = throughFile(grid, format, folder);
  const std::string losses = lossesIn(grid, format, LossesOf::Grid);

  if (format.holds.has(GridPart::Lines)) {
    EXPECT_THAT(losses, Not(HasSubstr("edges stay")));
    ASSERT_EQ(got.lines.size(), grid.lines.size());
    const bool named = format.holds.has(GridPart::LineNames);
    EXPECT_EQ(losses.find("names of lines") == std::string::npos, named);
    for (std::size_t i = 0; i < grid.lines.size(); ++i) {
      EXPECT_EQ(got.lines[i].kind, grid.lines[i].kind) << i;
      EXPECT_EQ(got.lines[i].name, named ? grid.lines[i].name : "") << i;
      EXPECT_EQ(got.lines[i].closed, grid.lines[i].closed) << i;
      EXPECT_EQ(got.lines[i].nodes, grid.lines[i].nodes) << i;
    }
  } else {
    EXPECT_TRUE(got.lines.empty());
    EXPECT_THAT(losses, HasSubstr("2 weirs and 1 constraint and 1 border of a region, whose edges stay in the mesh"));
  }

  const auto regionsOf = [](const Grid& of) {
    std::vector<std::string> regions;
    for (const std::uint32_t feature : of.feature_of) regions.push_back(of.features[feature].region);
    return regions;
  };
  if (format.holds.has(GridPart::Regions)) {
    EXPECT_THAT(losses, Not(HasSubstr("names of 2 regions")));
    EXPECT_EQ(regionsOf(got), regionsOf(grid));
  } else {
    EXPECT_THAT(losses, HasSubstr("the names of 2 regions"));
    for (const std::string& region : regionsOf(got)) EXPECT_EQ(region, "");
  }

  const auto fidsOf = [](const Grid& of) {
    std::vector<std::int64_t> fids;
    for (const std::uint32_t feature : of.feature_of) fids.push_back(of.features[feature].fid);
    return fids;
  };
  if (format.holds.has(GridPart::Features)) {
    EXPECT_EQ(fidsOf(got), fidsOf(grid));
  } else {
    EXPECT_THAT(losses, HasSubstr("the features that triangles come from"));
    EXPECT_TRUE(got.feature_of.empty());
  }
  EXPECT_EQ(losses.find("names and sources of features") == std::string::npos,
            format.holds.has(GridPart::FeatureNames));
  if (format.holds.has(GridPart::FeatureNames)) {
    for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
      const GridFeature &wanted = grid.features[grid.feature_of[t]], &found = got.features[got.feature_of[t]];
      EXPECT_EQ(found.source, wanted.source) << t;
      EXPECT_EQ(found.attributes, wanted.attributes) << t;
    }
  }

  std::map<NodePair, std::string> names, names_got;
  for (const auto& [of, into] : {std::pair(&grid, &names), std::pair(&got, &names_got)})
    for (const Boundary& boundary : of->boundaries)
      for (const auto& [a, b] : edgesOf(boundary)) (*into)[edgeKey(a, b)] = boundary.name;
  const bool with_boundaries = format.holds.has(GridPart::Rivers) || format.holds.has(GridPart::BoundaryNames);
  EXPECT_EQ(losses.find("the name of 1 boundary") != std::string::npos,
            with_boundaries && !format.holds.has(GridPart::BoundaryNames));
  if (format.holds.has(GridPart::BoundaryNames)) {
    EXPECT_EQ(names_got, names);
  }

  std::map<NodePair, int> types, types_got;
  for (const auto& [of, into] : {std::pair(&grid, &types), std::pair(&got, &types_got)}) {
    for (const Boundary& boundary : of->boundaries)
      for (const NodePair& edge : edgesOf(boundary)) (*into)[edge] = boundary.ibtype;
  }
  if (format.holds.has(GridPart::Ibtypes)) {
    EXPECT_EQ(types_got, types);
  } else {
    EXPECT_THAT(losses, HasSubstr("ADCIRC's types of 2 boundaries (10, 11)"));
    for (const auto& [edge, type] : types_got) EXPECT_EQ(type, -1);
  }
}

// Writing what was read through a file gives the same bytes.
TEST_P(NamedGrid, IsWrittenAgainAsItWasRead) {
  const GridFormat& format = GetParam();
  if (format.places == NodePlaces::Sphere) GTEST_SKIP() << "its places are rounded each time";
  const TemporaryFolder first, second;
  const Grid got = throughFile(namedGrid(), format, first);
  throughFile(got, format, second);
  ASSERT_EQ(first.names(), second.names());
  for (const std::string& name : first.names()) {
    std::ifstream a(first / name, std::ios::binary), b(second / name, std::ios::binary);
    EXPECT_TRUE(std::string(std::istreambuf_iterator<char>(a), {}) ==
                std::string(std::istreambuf_iterator<char>(b), {}))
        << name;
  }
}

// Parts cut through all lines and features, which are whole again after reading.
TEST_P(NamedGrid, KeepsPartsWhereTheFormatDoes) {
  const GridFormat& format = GetParam();
  const Grid grid = testing::inParts(namedGrid());
  const TemporaryFolder first, second;
  const Grid got = throughFile(grid, format, first);
  const std::string losses = lossesIn(grid, format, LossesOf::Grid);
  EXPECT_EQ(losses.find("parts that triangles") == std::string::npos, format.holds.has(GridPart::Partition));
  EXPECT_EQ(losses.find("parts that nodes") == std::string::npos, format.holds.has(GridPart::NodePartition));
  if (!format.holds.has(GridPart::Partition)) {
    EXPECT_TRUE(got.part_of.empty());
    return;
  }
  EXPECT_EQ(got.part_of, grid.part_of);
  EXPECT_EQ(got.triangles, grid.triangles);
  const Grid whole = throughFile(namedGrid(), format, second);
  EXPECT_TRUE(whole.part_of.empty());
  ASSERT_EQ(got.lines.size(), whole.lines.size());
  for (std::size_t i = 0; i < whole.lines.size(); ++i) EXPECT_EQ(got.lines[i].nodes, whole.lines[i].nodes);
  ASSERT_EQ(got.boundaries.size(), whole.boundaries.size());
  for (std::size_t i = 0; i < whole.boundaries.size(); ++i)
    EXPECT_EQ(got.boundaries[i].nodes, whole.boundaries[i].nodes);
}

std::vector<GridFormat> formatsOfGrids() {
  std::vector<GridFormat> formats;
  for (const GridFormat& format : gridFormats())
    if (format.readable) formats.push_back(format);
  return formats;
}

INSTANTIATE_TEST_SUITE_P(Formats, NamedGrid, ::testing::ValuesIn(formatsOfGrids()),
                         [](const auto& instance) { return "to_" + std::string(instance.param.name); });

// A plain mesh loses nothing in any format.
TEST(LossesIn, NothingOfAPlainMesh) {
  Grid grid = namedGrid();
  grid.lines.clear();
  grid.features.clear();
  grid.feature_of.clear();
  for (Boundary& boundary : grid.boundaries) {
    boundary.ibtype = -1;
    boundary.name.clear();
  }
  for (const GridFormat& format : gridFormats()) EXPECT_EQ(lossesIn(grid, format, LossesOf::Grid), "") << format.name;
}

// Data that a run makes itself is not a loss of the user's input.
TEST(LossesIn, OfTheInputAlone) {
  Grid grid = namedGrid();
  grid.size_m.assign(grid.nodes.size(), 100.0);
  const GridFormat& adcirc = gridFormatFor("fort.14");
  EXPECT_THAT(lossesIn(grid, adcirc, LossesOf::Grid), HasSubstr("lengths that edges were to have"));
  const std::string of_input = lossesIn(grid, adcirc, LossesOf::Input);
  EXPECT_THAT(of_input, Not(HasSubstr("lengths")));
  EXPECT_THAT(of_input, HasSubstr("a weir of its own takes nodes across and heights"));
  EXPECT_THAT(of_input, HasSubstr("2 weirs"));
}

// ADCIRC's weirs: formats without room for their heights report that, and type 24 is never written without heights.
TEST(LossesIn, WeirsBetweenShores) {
  Grid grid = namedGrid();
  Boundary& weir = grid.boundaries[0];
  weir.closed = false;
  weir.ibtype = 24;
  weir.back_nodes.assign(weir.nodes.size(), grid.boundaries[1].nodes[0]);
  weir.weir.assign(3 * weir.nodes.size(), 1.5);
  const TemporaryFolder folder;
  for (const GridFormat& format : formatsOfGrids()) {
    const std::string losses = lossesIn(grid, format, LossesOf::Grid);
    EXPECT_EQ(losses.find("heights and nodes across of 1 weir") == std::string::npos, format.name == "adcirc")
        << format.name;
  }
  const Grid bare = throughFile(grid, gridFormatFor("a.nc"), folder);
  const auto isWeir = [](const Boundary& boundary) { return boundary.ibtype == 24; };
  ASSERT_TRUE(std::ranges::any_of(bare.boundaries, isWeir));
  const GridFormat& adcirc = gridFormatFor("fort.14");
  EXPECT_THAT(lossesIn(bare, adcirc, LossesOf::Grid), HasSubstr("1 boundary is a weir (24), whose heights"));
  const Grid again = throughFile(bare, adcirc, folder);
  EXPECT_TRUE(std::ranges::none_of(again.boundaries, isWeir));
}

// ADCIRC closes segments of an island's type, so a part of an island's shore gets the mainland's type.
TEST(LossesIn, IslandsOfWhichAPartIsABoundary) {
  Grid grid = namedGrid();
  const auto island = std::ranges::find(grid.boundaries, BoundaryRole::Island, &Boundary::role);
  ASSERT_NE(island, grid.boundaries.end());
  const GridFormat& adcirc = gridFormatFor("fort.14");
  EXPECT_THAT(lossesIn(grid, adcirc, LossesOf::Input), Not(HasSubstr("mainland")));
  Boundary river = *island;
  river.role = BoundaryRole::River;
  river.ibtype = 22;
  river.closed = island->closed = false;
  river.nodes = {island->nodes[0], island->nodes[1]};
  std::ranges::rotate(island->nodes, island->nodes.begin() + 1);
  island->role = BoundaryRole::Land;
  const std::vector<std::uint32_t> shore = island->nodes;
  grid.boundaries.push_back(river);
  const TemporaryFolder folder;
  for (const int type : {1, 11}) {
    std::ranges::find(grid.boundaries, shore, &Boundary::nodes)->ibtype = type;
    const Grid got = throughFile(grid, adcirc, folder);
    const auto part = std::ranges::find(got.boundaries, shore, &Boundary::nodes);
    ASSERT_NE(part, got.boundaries.end());
    EXPECT_EQ(part->ibtype, type - 1);
    EXPECT_FALSE(part->closed);
    EXPECT_THAT(lossesIn(grid, adcirc, LossesOf::Input),
                HasSubstr("that 1 boundary is an island (" + std::to_string(type) +
                          "): a part of a shore gets the mainland's type"));
    EXPECT_THAT(lossesIn(grid, gridFormatFor("a.nc"), LossesOf::Grid), Not(HasSubstr("mainland")));
  }
}

// Some formats mark open boundaries at nodes, so a single edge of shore between two of them comes back open.
TEST(LossesIn, ShoreBetweenOpenNodes) {
  Grid grid = namedGrid();
  const auto outer = std::ranges::find(grid.boundaries, BoundaryRole::Land, &Boundary::role);
  ASSERT_NE(outer, grid.boundaries.end());
  const std::vector<std::uint32_t> loop = outer->nodes;
  const std::vector<std::uint32_t> lone{loop[3], loop[4]};
  std::vector<std::uint32_t> rest(loop.begin() + 7, loop.end());
  rest.push_back(loop[0]);
  outer->closed = false;
  outer->nodes = lone;
  for (const auto& [role, nodes] : {std::pair(BoundaryRole::Open, std::vector(loop.begin(), loop.begin() + 4)),
                                    std::pair(BoundaryRole::Open, std::vector(loop.begin() + 4, loop.begin() + 8)),
                                    std::pair(BoundaryRole::Land, rest)}) {
    Boundary& boundary = grid.boundaries.emplace_back();
    boundary.role = role;
    boundary.closed = false;
    boundary.nodes = nodes;
  }
  const TemporaryFolder folder;
  for (const GridFormat& format : formatsOfGrids()) {
    const Grid got = throughFile(grid, format, folder);
    if (got.boundaries.empty() || format.name == "fesom") continue;  // FESOM2 has no open boundaries
    const EdgeKinds kinds(got);
    const BoundaryKind* const kind = kinds.find(lone[0], lone[1]);
    const bool opens = kind != nullptr && kind->role == BoundaryRole::Open;
    EXPECT_EQ(lossesIn(grid, format, LossesOf::Input).find("1 edge between open nodes is shore") != std::string::npos,
              opens)
        << format.name;
  }
}

TEST(LossesIn, HeightsAboveTheWater) {
  Grid grid = namedGrid();
  grid.z.assign(grid.nodes.size(), -10.0);
  grid.z[3] = 2.5;
  const TemporaryFolder folder;
  for (const GridFormat& format : formatsOfGrids()) {
    const Grid got = throughFile(grid, format, folder);
    if (got.z.empty()) continue;
    EXPECT_EQ(lossesIn(grid, format, LossesOf::Input).find("heights of 1 node above the water") != std::string::npos,
              got.z[3] != 2.5)
        << format.name;
  }
}

// Node strings and physical curves of other programs are lines if they run inside the mesh.
TEST(ReadLines, OfOtherPrograms) {
  const TemporaryFolder folder;
  std::ofstream(folder / "other.2dm") << "MESH2D\nND 1 0 0 1\nND 2 1 0 1\nND 3 1 1 1\nND 4 0 1 1\n"
                                         "E3T 1 1 2 3 7\nE3T 2 1 3 4 8\nNS 1 -3 2\nNS 1 -2 5\n"
                                         "BEG2DMBC\nMAT 7 \"sand\"\nMAT 8 \"feature 3 in bay\"\nEND2DMBC\n";
  const Grid grid = readGrid(folder / "other.2dm");
  ASSERT_EQ(grid.lines.size(), 1u);
  EXPECT_EQ(grid.lines[0].kind, LineKind::Constraint);
  EXPECT_EQ(grid.lines[0].nodes, (std::vector<std::uint32_t>{0, 2}));
  ASSERT_EQ(grid.boundaries.size(), 1u);
  ASSERT_EQ(grid.features.size(), 2u);
  EXPECT_EQ(grid.features[0].fid, 7);
  ASSERT_EQ(grid.features[0].attributes.size(), 1u);
  EXPECT_EQ(grid.features[0].attributes[0].second, "sand");
  EXPECT_EQ(grid.features[1].fid, 3);
  EXPECT_EQ(grid.features[1].region, "bay");

  std::ofstream(folder / "other.msh") << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
                                         "$PhysicalNames\n2\n1 7 \"Weir of Assuan\"\n1 8 \"gauge\"\n$EndPhysicalNames\n"
                                         "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
                                         "$Elements\n4\n1 1 2 7 1 1 2\n2 1 2 8 2 1 3\n3 2 2 3 1 1 2 3\n"
                                         "4 2 2 3 1 1 3 4\n$EndElements\n";
  const Grid gmsh = readGrid(folder / "other.msh");
  ASSERT_EQ(gmsh.lines.size(), 1u);
  EXPECT_EQ(gmsh.lines[0].name, "gauge");
  ASSERT_EQ(gmsh.boundaries.size(), 1u) << "what lies on the mesh's boundary is one, whatever it is called";
}

// An edge listed in both directions, as for the two sides of a wall, is not a loop of two nodes.
TEST(ReadLines, ThereAndBackAreNoLoop) {
  const TemporaryFolder folder;
  std::ofstream(folder / "wall.msh") << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
                                        "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
                                        "$Elements\n4\n1 1 2 8 2 1 3\n2 1 2 8 2 3 1\n3 2 2 3 1 1 2 3\n"
                                        "4 2 2 3 1 1 3 4\n$EndElements\n";
  const Grid gmsh = readGrid(folder / "wall.msh");
  requireConsistent(gmsh);
  ASSERT_EQ(gmsh.lines.size(), 1u);
  EXPECT_FALSE(gmsh.lines[0].closed);
  EXPECT_EQ(gmsh.lines[0].nodes, (std::vector<std::uint32_t>{0, 2}));

  std::ofstream(folder / "wall.2dm") << "MESH2D\nND 1 0 0 1\nND 2 1 0 1\nND 3 1 1 1\nND 4 0 1 1\n"
                                        "E3T 1 1 2 3 1\nE3T 2 1 3 4 1\nNS 1 3 -1 16\n";
  const Grid sms = readGrid(folder / "wall.2dm");
  requireConsistent(sms);
  ASSERT_EQ(sms.lines.size(), 1u);
  EXPECT_FALSE(sms.lines[0].closed);
}

// A line that leaves the edges between triangles is cut there, and a note of the grid reports it.
TEST(ReadLines, OffTheEdgesAreCut) {
  const TemporaryFolder folder;
  std::ofstream(folder / "cut.2dm") << "MESH2D\nND 1 0 0 1\nND 2 1 0 1\nND 3 1 1 1\nND 4 0 1 1\n"
                                       "E3T 1 1 2 3 1\nE3T 2 1 3 4 1\nNS 1 3 -2 16\n";
  const Grid grid = readGrid(folder / "cut.2dm");
  ASSERT_EQ(grid.lines.size(), 1u);
  EXPECT_EQ(grid.lines[0].nodes, (std::vector<std::uint32_t>{0, 2}));
  ASSERT_EQ(grid.notes.size(), 1u);
  EXPECT_THAT(grid.notes[0], HasSubstr("1 edge of a line does not lie between two triangles and is left out"));
}

}  // namespace
}  // namespace coastmesh
