#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "gis/crs/crs.hpp"
#include "gis/elements/elements.hpp"
#include "gis/elements/quads.hpp"
#include "gis/format/grid_losses.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "tests/gis/format/read_grid.hpp"

namespace coastmesh {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Mike : public ReadGrid {
 protected:
  std::string written(const Grid& grid) {
    const std::string path = folder_ / "a.mesh";
    StagedOutput output(path, gridFormatFor(path), true);
    output.write(grid);
    output.commit();
    std::ifstream file(path);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }
};

// A square of two triangles, sides of which are open or a river.
//   3 --- 2
//   |   / |
//   | /   |
//   0 --- 1
Grid square(const std::map<std::pair<int, int>, BoundaryKind>& openings) {
  Grid grid;
  for (const Point& p : {Point{0, 0}, Point{1000, 0}, Point{1000, 1000}, Point{0, 1000}}) grid.nodes.push_back(p);
  grid.z = {-10.0, -20.5, 1.25, -3.0};
  grid.triangles.push_back({0, 1, 2});
  grid.triangles.push_back({0, 2, 3});
  grid.boundaries = cutLoops(grid, boundaryLoops(grid), [&](std::uint32_t from, std::uint32_t to) {
    const auto found = openings.find({static_cast<int>(from), static_cast<int>(to)});
    return found == openings.end() ? BoundaryKind{} : found->second;
  });
  return grid;
}

BoundaryKind open(std::uint32_t segment) { return {.role = BoundaryRole::Open, .segment = segment}; }

std::map<std::pair<std::uint32_t, std::uint32_t>, BoundaryRole> rolesIn(const Grid& grid) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, BoundaryRole> roles;
  for (const Boundary& boundary : grid.boundaries)
    for (const auto& [from, to] : edgesOf(boundary)) roles[{from, to}] = boundary.role;
  return roles;
}

std::vector<std::vector<std::uint32_t>> openChains(const Grid& grid) {
  std::vector<std::vector<std::uint32_t>> chains;
  for (const Boundary& boundary : grid.boundaries)
    if (boundary.role == BoundaryRole::Open) chains.push_back(boundary.nodes);
  return chains;
}

TEST_F(Mike, FileOfASquare) {
  Grid grid = square({{{1, 2}, open(0)}});
  EXPECT_EQ(written(grid),
            "100079 1000 4 NON-UTM\n1 0 0 -10 1\n2 1000 0 -20.5 2\n3 1000 1000 1.25 2\n4 0 1000 -3 1\n"
            "2 3 21\n1 1 2 3\n2 1 3 4\n");
  grid.crs = parseCrs("EPSG:32605");
  EXPECT_THAT(written(grid), StartsWith("100079 1000 4 UTM-5\n"));
  grid.crs = wgs84();
  for (Point& p : grid.nodes) p = {1e-3 * p.x, 1e-3 * p.y};
  EXPECT_THAT(written(grid), StartsWith("100079 1000 4 LONG/LAT\n"));
  grid.z.clear();
  EXPECT_THAT(written(grid), HasSubstr("\n2 1 0 0 2\n"));
}

TEST_F(Mike, OtherCrssAreWktInTheFirstLine) {
  Grid grid = square({});
  for (const char* const code : {"EPSG:32733", "EPSG:27700", "EPSG:4258"}) {
    grid.crs = parseCrs(code);
    if (grid.crs.geographic)
      for (Point& p : grid.nodes) p = {1e-3 * p.x, 1e-3 * p.y};
    const std::string text = written(grid);
    EXPECT_THAT(text, StartsWith(grid.crs.geographic ? "100079 1000 4 GEOGCS[" : "100079 1000 4 PROJCS["));
    EXPECT_TRUE(sameCrs(readGrid(folder_ / "a.mesh").crs, grid.crs)) << code;
  }
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"a.mesh"});
}

TEST_F(Mike, DatumShiftsAreLostAndNamed) {
  Grid grid = square({});
  const GridFormat& format = gridFormatFor("a.mesh");
  grid.crs = parseCrs("+proj=utm +zone=33 +ellps=bessel +towgs84=598.1,73.7,418.2 +type=crs");
  EXPECT_THAT(lossesIn(grid, format, LossesOf::Grid), HasSubstr("the datum shift of the CRS: readers of the file"));
  grid.crs = parseCrs("EPSG:32633");
  EXPECT_THAT(lossesIn(grid, format, LossesOf::Grid), Not(HasSubstr("datum")));
}

// A node has one code: where two openings meet it is that of the first, and the next edge has the code of its end.
TEST_F(Mike, OpeningsThatMeetStayTwo) {
  const Grid grid = square({{{0, 1}, open(0)}, {{1, 2}, open(1)}});
  ASSERT_EQ(openChains(grid).size(), 2u);
  written(grid);
  const Grid got = readGrid(folder_ / "a.mesh");
  EXPECT_EQ(openChains(got), openChains(grid));
  EXPECT_EQ(rolesIn(got), rolesIn(grid));
}

TEST_F(Mike, RiversAreOpenings) {
  Grid grid = square({{{0, 1}, {.role = BoundaryRole::River, .name = "Elbe"}}, {{2, 3}, open(0)}});
  EXPECT_THAT(written(grid), AllOf(HasSubstr("\n2 1000 0 -20.5 2\n"), HasSubstr("\n3 1000 1000 1.25 3\n")));
  const GridFormat& format = gridFormatFor("a.mesh");
  EXPECT_THAT(openingsIn(grid, "a.mesh", format),
              AllOf(StartsWith("codes of open boundaries in 'a.mesh': "), HasSubstr("'Elbe' near")));
  // Both ends of the other two sides have codes of openings.
  EXPECT_THAT(lossesIn(grid, format, LossesOf::Grid), HasSubstr("2 edges between open nodes are shore"));
}

// Models refer to boundaries by their codes.
TEST_F(Mike, CodesStayAsTheyWere) {
  const std::string text =
      "100079 1000 6 NON-UTM\n1 0 0 -1 7\n2 1000 0 -1 7\n3 2000 0 -1 1\n4 2000 1000 -1 2\n5 1000 1000 -1 2\n"
      "6 0 1000 -1 1\n4 3 21\n1 1 2 5\n2 1 5 6\n3 2 3 4\n4 2 4 5\n";
  Grid grid = readGrid(put("codes.mesh", text));
  EXPECT_EQ(openChains(grid).size(), 2u);
  EXPECT_EQ(written(grid), text);
  // A new opening gets a code that no opening has had.
  const auto rename = [&](const char* from, const char* to) {
    std::ranges::find(grid.boundaries, from, &Boundary::name)->name = to;
  };
  rename("code 2", "inlet");
  EXPECT_THAT(written(grid), AllOf(HasSubstr("\n1 0 0 -1 7\n"), HasSubstr("\n4 2000 1000 -1 8\n")));
  EXPECT_THAT(openingsIn(grid, "a.mesh", gridFormatFor("a.mesh")),
              AllOf(HasSubstr("8 'inlet' near"), HasSubstr("7 open near")));
  // A name of land's code is none of an opening.
  rename("code 7", "code 1");
  EXPECT_THAT(written(grid), AllOf(HasSubstr("-1 2\n"), HasSubstr("-1 3\n"), Not(HasSubstr("-1 7\n"))));
}

TEST_F(Mike, ReadsFilesFromBefore2012) {
  const Grid grid =
      readGrid(put("old.mesh",
                   "4  UTM-33\n1 359862.97 6206313.71 -1.5 1 \n2 359962.97 6206313.71 -2 2 \n"
                   "3 359962.97 6206413.71 -2 2 \n9 359862.97 6206413.71 -1 1 \n2 3 21\n7 1 2 3 \n8 1 3 9 \n"));
  EXPECT_EQ(grid.crs.authority, "EPSG:32633");
  EXPECT_THAT(grid.triangles,
              ElementsAre(std::array<std::uint32_t, 3>{0, 1, 2}, std::array<std::uint32_t, 3>{0, 2, 3}));
  EXPECT_THAT(grid.z, ElementsAre(-1.5, -2.0, -2.0, -1.0));
  EXPECT_THAT(openChains(grid), ElementsAre(std::vector<std::uint32_t>{1, 2}));
}

TEST_F(Mike, ReadsQuadrilateralsAndFeet) {
  const Grid grid =
      readGrid(put("mixed.mesh",
                   "100079 1003 5 NON-UTM\n1 0 0 -10 1\n2 1 0 -10 0\n3 1 1 -10 1\n4 0 1 -10 1\n5 2 0.5 -10 1\n"
                   "2 4 25\n1 1 2 3 4\n2 2 5 3 0\n"));
  EXPECT_EQ(Elements(grid).quads(), 1u);
  EXPECT_EQ(Elements(grid).size(), 2u);
  EXPECT_THAT(grid.z, ::testing::Each(-3.048));
  // A node of the boundary without a code is land.
  EXPECT_TRUE(openChains(grid).empty());
  EXPECT_THAT(written(grid), AllOf(HasSubstr("\n2 4 25\n"), HasSubstr("\n2 2 5 3 0\n")));
}

// As DHI's own programs write it: the geographic part has no name that others know.
TEST_F(Mike, ReadsItsOwnWkt) {
  const std::string wkt =
      R"(PROJCS["UTM-17",GEOGCS["Unused",DATUM["UTM Projections",SPHEROID["WGS 1984",6378137,298.257223563]],)"
      R"(PRIMEM["Greenwich",0],UNIT["Degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],)"
      R"(PARAMETER["False_Easting",500000],PARAMETER["False_Northing",0],PARAMETER["Central_Meridian",-81],)"
      R"(PARAMETER["Scale_Factor",0.9996],PARAMETER["Latitude_Of_Origin",0],UNIT["Meter",1]])";
  const Grid grid =
      readGrid(put("wkt.mesh", "100079 1000 3 " + wkt + "\n1 0 0 -1 1\n2 1 0 -1 1\n3 1 1 -1 1\n1 3 21\n1 1 2 3\n"));
  EXPECT_FALSE(grid.crs.isPlane());
  EXPECT_FALSE(grid.crs.geographic);
  EXPECT_EQ(metresPerUnit(grid.crs), 1.0);
}

TEST_F(Mike, UnknownProjectionsAreWhatTheUserSays) {
  const std::string path =
      put("own.mesh", "100079 1000 3 GAUSS 7\n1 0 0 -1 1\n2 1 0 -1 1\n3 1 1 -1 1\n1 3 21\n1 1 2 3\n");
  EXPECT_THAT(errorOf(path), AllOf(HasSubstr("own.mesh"), HasSubstr("'GAUSS 7'"), HasSubstr("--assume-crs")));
  EXPECT_EQ(readGrid(path, parseCrs("EPSG:31467")).crs.authority, "EPSG:31467");
  const std::string plane = put("plane.mesh", "3 NON-UTM\n1 0 0 -1 1\n2 1 0 -1 1\n3 1 1 -1 1\n1 3 21\n1 1 2 3\n");
  EXPECT_TRUE(readGrid(plane).crs.isPlane());
  EXPECT_EQ(readGrid(plane, parseCrs("EPSG:31467")).crs.authority, "EPSG:31467");
}

TEST_F(Mike, ErrorsNameTheLine) {
  const std::string nodes = "1 0 0 -1 1\n2 1 0 -1 1\n3 1 1 -1 1\n";
  EXPECT_THAT(errorIn("m.mesh", "MeshVersionFormatted 2\n"),
              AllOf(HasSubstr("m.mesh"), HasSubstr("starts with numbers")));
  EXPECT_THAT(errorIn("m.mesh", "100079 1002 3 UTM-33\n" + nodes), AllOf(HasSubstr("line 1"), HasSubstr("unit 1002")));
  EXPECT_THAT(errorIn("m.mesh", "100000 1000 3 UTM-33\n" + nodes),
              AllOf(HasSubstr("line 1"), HasSubstr("item 100000")));
  EXPECT_THAT(errorIn("m.mesh", "100079 1000 3 UTM-61\n" + nodes), HasSubstr("'UTM-61'"));
  EXPECT_THAT(errorIn("m.mesh", "3 UTM-33\n" + nodes + "1 3 21\n1 1 2 4\n"),
              AllOf(HasSubstr("line 6"), HasSubstr("names node 4")));
  EXPECT_THAT(errorIn("m.mesh", "3 UTM-33\n" + nodes + "1 3 21\n1 1 2\n"), HasSubstr("has 2 nodes, not 3 or 4"));
  EXPECT_THAT(errorIn("m.mesh", "3 UTM-33\n1 0 0 -1 1\n2 1 0 -1 -1\n"),
              AllOf(HasSubstr("line 3"), HasSubstr("code -1")));
  EXPECT_THAT(errorIn("m.mesh", "4 UTM-33\n" + nodes), HasSubstr("m.mesh"));
}

}  // namespace
}  // namespace coastmesh
