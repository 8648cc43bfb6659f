#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

// A square sea of 10 km in a plane, and rivers from the east.
class Rivers : public ProgramTest {
 protected:
  Rivers() {
    write("sea.poly", "4 2 0 0\n1 0 0\n2 10000 0\n3 10000 10000\n4 0 10000\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
    write("bed.asc", "ncols 2\nnrows 2\nxllcorner -10000\nyllcorner -10000\ncellsize 20000\n-9 -9\n-9 -9\n");
    const ProgramRun run = runProgram(
        {"mesh", file("sea.poly"), "-o", sea(), "--size-max", "1000", "--bathymetry", file("bed.asc"), "--quiet"});
    EXPECT_EQ(run.code, 0) << run.errors;
  }

  std::string sea() const { return file("sea.nc"); }
  // The path of a file of lines. Each row: the corners, the width, the depth, the name.
  std::string lines(const std::string& name, const std::vector<std::string>& rows) const {
    std::string text = "WKT,width,depth,name\n";
    for (const std::string& row : rows) text += row + "\n";
    return write(name, text);
  }
  std::string twoRivers() const { return lines("rivers.csv", {kMain, kBranch}); }
  Json infoOf(const std::string& name) const {
    const ProgramRun run = runProgram({"info", file(name), "--json"});
    EXPECT_EQ(run.code, 0) << run.errors;
    return Json::parse(run.output);
  }

  static constexpr const char* kMain = "\"LINESTRING (9800 5000, 13000 5000, 20000 5000)\",200,4,Main";
  static constexpr const char* kBranch = "\"LINESTRING (13000 5000, 15000 9000)\",100,2,Branch";
  static constexpr const char* kApart = "\"LINESTRING (40000 5000, 50000 5000)\",100,2,Apart";
};

// Counts of rows by item, and of those without a number before.
struct NumberTable {
  std::map<std::string, std::size_t> rows, new_ones;

  explicit NumberTable(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "item,number,source");
    while (std::getline(lines, line)) {
      const std::string item = line.substr(0, line.find(','));
      ++rows[item];
      if (line.back() == ',') ++new_ones[item];
    }
  }
};

TEST_F(Rivers, TwoThatMeetAreAddedToASea) {
  const ProgramRun run = runProgram(
      {"rivers", sea(), twoRivers(), "-o", file("both.nc"), "-o", file("both.gr3"), "--numbers", file("numbers.csv")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("rivers: 3 reaches, "));
  EXPECT_THAT(run.output, HasSubstr(" at 1 junction, 2 river boundaries\n"));
  EXPECT_THAT(run.errors, Not(HasSubstr("left out")));
  EXPECT_EQ(runProgram({"check", file("both.gr3"), "--target", "schism"}).code, 0);
  const ProgramRun check = runProgram({"check", file("both.nc"), "--target", "schism"});
  EXPECT_EQ(check.code, 0) << check.output;

  // Two across and three times as long as wide: 10 km of 100 m by 300 m, and 4.5 km of 50 m by 150 m.
  const Json info = infoOf("both.nc"), before = infoOf("sea.nc");
  const std::size_t quads = info["quadrilaterals"]["count"];
  EXPECT_GT(quads, 100u);
  EXPECT_LT(quads, 140u);
  EXPECT_EQ(info["pieces"], 1);
  EXPECT_EQ(info["boundaries"]["river"], 2);
  EXPECT_FALSE(info["boundaries"].contains("open"));

  const NumberTable table(readText(file("numbers.csv")));
  EXPECT_EQ(table.rows.at("node"), info["nodes"].get<std::size_t>());
  EXPECT_EQ(table.rows.at("triangle"), info["triangles"].get<std::size_t>());
  EXPECT_EQ(table.rows.at("quadrilateral"), quads);
  EXPECT_EQ(table.new_ones.at("quadrilateral"), quads);
  const std::size_t kept = table.rows.at("triangle") - table.new_ones.at("triangle");
  EXPECT_GT(kept, before["triangles"].get<std::size_t>() / 2);
  EXPECT_LT(kept, before["triangles"].get<std::size_t>());
}

// In files, also after repairs, and in the summary, by which inflows are assigned to boundaries.
TEST_F(Rivers, NamesOfRiversAreThoseOfTheirBoundaries) {
  const ProgramRun run = runProgram({"rivers", sea(), twoRivers(), "-o", file("both.nc"), "-o", file("both.gr3"),
                                     "--target", "schism", "--aspect", "1.5"});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("river boundaries, by number among all boundaries"));
  EXPECT_THAT(run.output, HasSubstr("'Main', 3 nodes, near (20000, 5000)\n"));
  EXPECT_THAT(run.output, HasSubstr("'Branch', 3 nodes, near (15000, 9000)\n"));
  EXPECT_THAT(readText(file("both.gr3")), HasSubstr("3 = number of nodes of open boundary 1: "));
  EXPECT_THAT(readText(file("both.gr3")), HasSubstr(": Main\n"));
  EXPECT_THAT(run.errors, Not(HasSubstr("both.nc' cannot hold")));

  ASSERT_EQ(runProgram({"convert", file("both.nc"), "-o", file("again.geojson")}).code, 0);
  std::set<std::string> names;
  const Json boundaries = Json::parse(readText(file("again_boundaries.geojson")));
  for (const Json& feature : boundaries["features"])
    if (feature["properties"]["role"] == "river") names.insert(feature["properties"]["name"]);
  EXPECT_EQ(names, (std::set<std::string>{"Branch", "Main"}));
  names.clear();
  const Json triangles = Json::parse(readText(file("again.geojson")));
  for (const Json& feature : triangles["features"]) {
    if (feature["properties"]["name"].is_string()) names.insert(feature["properties"]["name"]);
    EXPECT_GT(feature["properties"]["area_m2"], 0.0);
    EXPECT_GT(feature["properties"]["min_angle"], 15.0);
  }
  EXPECT_EQ(names, (std::set<std::string>{"Branch", "Main"}));
}

// A river at the other side of the Earth is named where its file has it, not a turn from there.
TEST_F(Rivers, ThatAreFarAwayAreNamedWhereTheyAre) {
  ASSERT_EQ(runProgram({"mesh", inputFile("lines/lake.geojson"), "-o", file("lake.nc"), "--size-max", "4000"}).code, 0);
  const std::string far = lines("far.csv", {"\"LINESTRING (95.1 17.2, 95.2 17.4)\",500,2,Irrawaddy"});
  const ProgramRun run = runProgram({"rivers", file("lake.nc"), far, "-o", file("x.nc")});
  EXPECT_EQ(run.code, 3);
  EXPECT_THAT(run.errors, HasSubstr("'Irrawaddy' near (95.1"));
}

TEST_F(Rivers, HaveTheDepthsOfTheirLines) {
  ASSERT_EQ(runProgram({"rivers", sea(), twoRivers(), "-o", file("both.nc"), "--quiet"}).code, 0);
  const Json z = infoOf("both.nc")["z"];
  EXPECT_NEAR(z[0], -9.0, 1e-9);
  EXPECT_EQ(z[1], -2.0);
}

TEST_F(Rivers, OptionsSayHowTheRowsAre) {
  const auto quadsWith = [&](const std::vector<std::string>& options) {
    std::vector<std::string> all{"rivers", sea(), lines("main.csv", {kMain}), "-o", file("x.nc"), "--overwrite"};
    all.insert(all.end(), options.begin(), options.end());
    const ProgramRun run = runProgram(all);
    EXPECT_EQ(run.code, 0) << run.errors;
    EXPECT_EQ(runProgram({"check", file("x.nc")}).code, 0);
    return infoOf("x.nc")["quadrilaterals"]["count"].get<double>();
  };
  const double usual = quadsWith({});
  // Half as wide and three times as long as that: twice as many along, twice as many across.
  EXPECT_NEAR(quadsWith({"--elements", "4"}) / usual, 4.0, 0.5);
  EXPECT_NEAR(quadsWith({"--max-cell-width", "50"}) / usual, 4.0, 0.5);
  EXPECT_NEAR(quadsWith({"--aspect", "1.5"}) / usual, 2.0, 0.25);
  EXPECT_EQ(quadsWith({"--width", "50"}), usual);  // all have one of their own
  EXPECT_GT(quadsWith({"--width-column", "depth"}), 20.0 * usual);
}

// The depths of the nodes of a file in gr3, by their places.
struct DepthAt {
  double x, y, depth;
};
std::vector<DepthAt> depthsOf(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::size_t elements = 0, nodes = 0, number = 0;
  std::getline(lines, line);
  lines >> elements >> nodes;
  std::vector<DepthAt> all(nodes);
  for (DepthAt& node : all) lines >> number >> node.x >> node.y >> node.depth;
  return all;
}

TEST_F(Rivers, AreAsWideAsTheWaterBetweenTheirBanks) {
  const std::string line = write("main.csv", "WKT,name\n\"LINESTRING (9800 5020, 20000 5020)\",Main\n");
  // Two tiles, from 200 m to 400 m wide.
  const std::string banks =
      write("banks.csv",
            "WKT,n\n\"POLYGON ((10000 4900, 15000 4850, 15000 5150, 10000 5100, 10000 4900))\",1\n"
            "\"POLYGON ((15000 4850, 20000 4800, 20000 5200, 15000 5150, 15000 4850))\",2\n");
  const ProgramRun without = runProgram({"rivers", sea(), line, "-o", file("x.nc")});
  EXPECT_EQ(without.code, 3);
  EXPECT_THAT(without.errors, HasSubstr("has no attribute 'width'"));
  const ProgramRun run = runProgram({"rivers", sea(), line, "--banks", banks, "-o", file("x.gr3")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("widths from banks along 9,9"));
  EXPECT_THAT(run.output, HasSubstr(" of 10,200, from 20"));
  double south = 5000.0, north = 5000.0;
  for (const DepthAt& node : depthsOf(readText(file("x.gr3")))) {
    if (node.x < 10200.0) continue;  // beside the sea
    EXPECT_LE(std::abs(node.y - 5000.0), 100.0 + 0.01 * (node.x - 10000.0) + 4.0) << node.x;
    south = std::min(south, node.y), north = std::max(north, node.y);
  }
  EXPECT_NEAR(south, 4800.0, 6.0);
  EXPECT_NEAR(north, 5200.0, 6.0);

  const ProgramRun apart = runProgram(
      {"rivers", sea(), line, "--banks",
       write("away.csv", "WKT,n\n\"POLYGON ((0 20000, 9000 20000, 9000 21000, 0 20000))\",1\n"), "-o", file("y.nc")});
  EXPECT_EQ(apart.code, 3);
  EXPECT_THAT(apart.errors, HasSubstr("'Main' has no width, and no part of it is between banks"));
  EXPECT_FALSE(std::filesystem::exists(file("y.nc")));
}

TEST_F(Rivers, InTheWaterOfTheMeshWithExtentAll) {
  const std::string inside = lines("channel.csv", {"\"LINESTRING (2000 5000, 8000 5000)\",200,12,Channel"});
  const ProgramRun outside = runProgram({"rivers", sea(), inside, "-o", file("x.nc")});
  EXPECT_EQ(outside.code, 3);
  EXPECT_THAT(outside.errors, HasSubstr("'Channel'"));
  EXPECT_THAT(outside.errors, HasSubstr("--extent all"));
  EXPECT_FALSE(std::filesystem::exists(file("x.nc")));
  const ProgramRun all = runProgram({"rivers", sea(), inside, "--extent", "all", "-o", file("x.nc")});
  ASSERT_EQ(all.code, 0) << all.errors;
  EXPECT_EQ(runProgram({"check", file("x.nc"), "--target", "schism"}).code, 0);
  const Json info = infoOf("x.nc");
  EXPECT_GE(info["quadrilaterals"]["count"], 2 * 19);
  EXPECT_FALSE(info["boundaries"].contains("river"));
  EXPECT_EQ(info["z"][0], -12.0);
}

TEST_F(Rivers, DigNothingBesideThem) {
  write("plain.asc", "ncols 2\nnrows 2\nxllcorner -10000\nyllcorner -10000\ncellsize 20000\n5 5\n5 5\n");
  ASSERT_EQ(runProgram({"mesh", file("sea.poly"), "-o", file("plain.nc"), "--size-max", "1000", "--bathymetry",
                        file("plain.asc"), "--quiet"})
                .code,
            0);
  const std::string inside = lines("inside.csv", {"\"LINESTRING (500 5000, 9500 6000)\",100,3,River"});
  const ProgramRun run =
      runProgram({"rivers", file("plain.nc"), inside, "--extent", "all", "-o", file("x.gr3"), "--quiet"});
  ASSERT_EQ(run.code, 0) << run.errors;
  std::size_t bed = 0;
  for (const DepthAt& node : depthsOf(readText(file("x.gr3")))) {
    EXPECT_TRUE(std::abs(node.depth - 3.0) < 1e-6 || std::abs(node.depth + 5.0) < 1e-6) << node.depth;
    if (node.depth > 0.0) ++bed;
  }
  EXPECT_GT(bed, 100u);
}

TEST_F(Rivers, AreNoSillsInDeeperWater) {
  ASSERT_EQ(runProgram({"rivers", sea(), twoRivers(), "-o", file("x.gr3"), "--quiet"}).code, 0);
  for (const DepthAt& node : depthsOf(readText(file("x.gr3")))) {
    if (node.x < 9999.0) {
      EXPECT_NEAR(node.depth, 9.0, 1e-6);
    }
  }
}

TEST_F(Rivers, OneThatIsApartIsNamed) {
  const ProgramRun run =
      runProgram({"rivers", sea(), lines("three.csv", {kMain, kApart, kBranch}), "-o", file("x.nc")});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("warning: 1 reach is left out, not connected with the water of the mesh"));
  EXPECT_THAT(run.errors, HasSubstr(": 'Apart' near (45000, 5000)"));
  EXPECT_THAT(run.output, HasSubstr("2 river boundaries"));
}

TEST_F(Rivers, RefusesAndWritesNothing) {
  const auto refused = [&](const std::vector<std::string>& arguments, int code, const std::vector<std::string>& texts) {
    std::vector<std::string> all{"rivers", sea()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    all.insert(all.end(), {"-o", file("x.nc")});
    const ProgramRun run = runProgram(all);
    EXPECT_EQ(run.code, code) << run.errors;
    for (const std::string& text : texts) EXPECT_THAT(run.errors, HasSubstr(text));
    EXPECT_FALSE(std::filesystem::exists(file("x.nc")));
  };
  const std::string good = twoRivers(), line = "\"LINESTRING (9800 5000, 13000 5000)\",";
  refused({}, 2, {"LINES"});
  refused({file("none.gpkg")}, 3, {"none.gpkg"});
  refused({lines("far.csv", {kApart})}, 3, {"no river can be added to", "sea.nc'", "not connected", "'Apart'"});
  refused({good, "--width-column", "breadth"}, 3,
          {"rivers.csv'", "no attribute 'breadth'", "--width-column", "--width"});
  refused({lines("lacking.csv", {kMain, line + ",2,a"})}, 3, {"lacking.csv', feature 2", "'width'"});
  refused({lines("zero.csv", {line + "0,2,a"})}, 3, {"zero.csv', feature 1", "'width'"});
  refused({lines("text.csv", {kMain, line + "broad,2,a"})}, 3, {"text.csv', feature 2", "is broad, not a number"});
  refused({lines("area.csv", {"\"POLYGON ((9800 5000, 13000 5000, 13000 6000, 9800 5000))\",200,4,a"})}, 3,
          {"area.csv', feature 1", "is a polygon, not the centre line of a river"});
  refused({lines("point.csv", {"POINT (9800 5000),200,4,a"})}, 3, {"point.csv', feature 1", "is a point"});
  refused({lines("empty.csv", {})}, 3, {"empty.csv'", "no feature in it is a line"});
  refused({good, "--depth-column", "dpt"}, 3, {"rivers.csv'", "no attribute 'dpt'"});
  refused({good, "--name-column", "called"}, 3, {"rivers.csv'", "no attribute 'called'"});
  refused({lines("degrees.csv", {"\"LINESTRING (-3.1 51.4, -3.2 51.5)\",200,4,a"})}, 3,
          {"sea.nc' has no CRS", "in degrees", "--assume-crs"});
  refused({good, "--elements", "0"}, 2, {"--elements"});
  refused({good, "--extent", "some"}, 2, {"--extent"});
  refused({good, "--numbers", file("n.csv"), "--target", "schism"}, 2, {"--numbers"});
  ASSERT_EQ(runProgram({"mesh", file("sea.poly"), "-o", file("bare.nc"), "--size-max", "2000", "--quiet"}).code, 0);
  const ProgramRun bare =
      runProgram({"rivers", file("bare.nc"), good, "--bathymetry", file("bed.asc"), "-o", file("x.nc")});
  EXPECT_EQ(bare.code, 3);
  EXPECT_THAT(bare.errors, HasSubstr("bare.nc' has no depths"));
  EXPECT_THAT(bare.errors, HasSubstr("convert --bathymetry"));
  const ProgramRun over = runProgram({"rivers", sea(), good, "-o", sea(), "--overwrite"});
  EXPECT_EQ(over.code, 2) << over.errors;
}

}  // namespace

}  // namespace coastmesh::test
