#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/lake_with_depths.hpp"
#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class Cut : public LakeWithDepths {
 protected:
  std::string mesh(const std::string& name) const { return meshOf(name, "60"); }
};

TEST_F(Cut, WorksOnEveryFormatAlike) {
  const std::string whole = mesh("whole.nc");
  ASSERT_EQ(runProgram({"cut", whole, box(), "-o", file("part.14"), "--quiet"}).code, 0);
  const std::string expected = readText(file("part.14"));
  EXPECT_THAT(expected, HasSubstr("boundary"));
  for (const std::string name : {"a.gpkg", "a.geojson", "a.14", "a.gr3", "a.slf", "a.msh", "a.2dm", "a.vtu"}) {
    ASSERT_EQ(runProgram({"convert", whole, "-o", file(name), "--quiet"}).code, 0) << name;
    const ProgramRun run =
        runProgram({"cut", file(name), box(), "--assume-crs", "EPSG:4326", "-o", file("other.14"), "--overwrite"});
    ASSERT_EQ(run.code, 0) << name << run.errors;
    EXPECT_THAT(run.output, HasSubstr(" triangles, ")) << name;
    EXPECT_THAT(run.output, HasSubstr("2 along the cut")) << name;
    // All but the title. These two formats divide the shore of the lake, which the cut then keeps divided.
    std::vector<std::string> lines = linesOf(file("other.14")), wanted = linesOf(file("part.14"));
    lines[0] = wanted[0];
    if (name == "a.14" || name == "a.gr3") {
      for (auto* const text : {&lines, &wanted})
        text->erase(std::ranges::find_if(*text, [](const std::string& line) { return line.ends_with("boundaries"); }),
                    text->end());
    }
    EXPECT_EQ(lines, wanted) << name;
  }
}

TEST_F(Cut, IsWhatModelsAccept) {
  const std::string whole = mesh("whole.nc");
  for (const std::string target : {"adcirc", "schism", "fvcom", "telemac", "fesom"}) {
    ASSERT_EQ(
        runProgram({"cut", whole, box(), "-o", file("part.nc"), "--target", target, "--quiet", "--overwrite"}).code, 0);
    const ProgramRun run = runProgram({"check", file("part.nc"), "--target", target});
    EXPECT_EQ(run.code, 0) << target << run.output;
  }
  // The first two also as it is.
  ASSERT_EQ(runProgram({"cut", whole, box(), "-o", file("part.nc"), "--quiet", "--overwrite"}).code, 0);
  EXPECT_EQ(runProgram({"check", file("part.nc"), "--target", "adcirc", "--target", "schism"}).code, 0);
}

TEST_F(Cut, NumbersAreThoseOfTheSource) {
  const std::string whole = mesh("whole.2dm");
  ASSERT_EQ(runProgram({"cut", whole, box(), "-o", file("part.2dm"), "--numbers", file("n.csv"), "--quiet"}).code, 0);
  const auto cards = [&](const std::string& path, const std::string& card) {
    std::map<long, std::vector<std::string>> rows;
    for (const std::string& line : linesOf(path)) {
      std::istringstream words(line);
      std::string word;
      long number = 0;
      words >> word >> number;
      if (word != card) continue;
      for (std::string value; words >> value;) rows[number].push_back(value);
    }
    return rows;
  };
  const auto nodes = cards(file("part.2dm"), "ND"), whole_nodes = cards(whole, "ND");
  const auto triangles = cards(file("part.2dm"), "E3T"), whole_triangles = cards(whole, "E3T");
  ASSERT_LT(nodes.size(), whole_nodes.size());
  std::map<std::string, std::map<long, long>> sources;
  const std::vector<std::string> table = linesOf(file("n.csv"));
  ASSERT_EQ(table.size(), 1 + nodes.size() + triangles.size());
  EXPECT_EQ(table[0], "item,number,source");
  for (std::size_t i = 1; i < table.size(); ++i) {
    std::istringstream words(table[i]);
    std::string item, number, source;
    std::getline(words, item, ',');
    std::getline(words, number, ',');
    std::getline(words, source, ',');
    sources[item][std::stol(number)] = std::stol(source);
  }
  for (const auto& [number, row] : nodes) EXPECT_EQ(row, whole_nodes.at(sources["node"].at(number)));
  for (const auto& [number, row] : triangles) {
    const auto& before = whole_triangles.at(sources["triangle"].at(number));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(sources["node"].at(std::stol(row[i])), std::stol(before[i]));
  }
}

TEST_F(Cut, PolygonsAndTheRestMakeTheWhole) {
  const std::string whole = mesh("whole.nc");
  const std::string half =
      write("half.geojson", geoJsonPolygons({{{{-88, 41}, {-87.4865, 41}, {-87.4865, 42}, {-88, 42}, {-88, 41}}}}));
  ASSERT_EQ(runProgram({"cut", whole, box(), "-o", file("box.14"), "--quiet"}).code, 0);
  ASSERT_EQ(runProgram({"cut", whole, "--within", half, "-o", file("half.14"), "--quiet"}).code, 0);
  EXPECT_EQ(linesOf(file("box.14")), linesOf(file("half.14")));
  const ProgramRun rest =
      runProgram({"cut", whole, "--outside", half, "-o", file("rest.14"), "--cut-boundary", "land"});
  ASSERT_EQ(rest.code, 0) << rest.errors;
  EXPECT_THAT(linesOf(file("rest.14")), Contains("0 = number of open boundaries"));
  EXPECT_THAT(linesOf(file("half.14")), Contains("2 = number of open boundaries"));
}

// Weirs of fort.14: both shores of a levee, of which the cut leaves two thirds.
TEST_F(Cut, WeirsAreDividedWithTheirHeights) {
  std::string nodes, triangles;
  int triangle = 0;
  for (int j = 0; j <= 3; ++j)
    for (int i = 0; i <= 5; ++i)
      nodes += std::to_string(6 * j + i + 1) + " " + std::to_string(1000 * i) + " " + std::to_string(1000 * j) + " 5\n";
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 5; ++i) {
      if (i == 2) continue;
      const int a = 6 * j + i + 1;
      for (const auto& [b, c] : {std::pair{a + 1, a + 7}, std::pair{a + 7, a + 6}})
        triangles += std::to_string(++triangle) + " 3 " + std::to_string(a) + " " + std::to_string(b) + " " +
                     std::to_string(c) + "\n";
    }
  }
  const std::string grid =
      write("levee.14", "levee\n" + std::to_string(triangle) + " 24\n" + nodes + triangles +
                            "0\n0\n1\n8\n4 24\n3 4 1.5 1 1\n9 10 2.5 1 1\n15 16 3.5 1 1\n21 22 4.5 1 1\n");
  const ProgramRun run = runProgram({"cut", grid, "--bbox=0,0,5000,2000", "-o", file("part.14")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.errors, Not(HasSubstr("lost")));
  EXPECT_THAT(readText(file("part.14")), HasSubstr("3 24"));
  EXPECT_THAT(readText(file("part.14")), HasSubstr("15 16 3.5"));
  EXPECT_THAT(readText(file("part.14")), Not(HasSubstr("4.5")));
  const ProgramRun west = runProgram({"cut", grid, "--bbox=0,0,2000,2000", "-o", file("west.14")});
  ASSERT_EQ(west.code, 0) << west.errors;
  EXPECT_THAT(west.errors, HasSubstr("1 shore of a weir has lost the shore across, and is land now"));
}

TEST_F(Cut, WithoutATriangleItSaysWhereTheMeshIsAndWritesNothing) {
  const std::string whole = mesh("whole.nc");
  const ProgramRun run = runProgram(
      {"cut", whole, "--bbox=1,1,2,2", "-o", file("part.nc"), "-o", file("part.14"), "--numbers", file("n.csv")});
  EXPECT_EQ(run.code, 3);
  EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("W,S,E,N"));
  EXPECT_THAT(run.errors, HasSubstr("-87.5"));
  EXPECT_THAT(run.errors, HasSubstr("EPSG:4326"));
  for (const std::string& name : names()) EXPECT_THAT(name, Not(HasSubstr("part")));
  EXPECT_FALSE(names().contains("n.csv"));
}

TEST_F(Cut, RefusesWhatHasNoMeaning) {
  const std::string whole = mesh("whole.nc");
  const auto refused = [&](std::vector<std::string> options, const std::string& why) {
    options.insert(options.begin(), {"cut", whole, "-o", file("part.nc")});
    const ProgramRun run = runProgram(options);
    EXPECT_EQ(run.code, 2) << why;
    EXPECT_THAT(run.errors, HasSubstr(why));
    EXPECT_FALSE(names().contains("part.nc"));
  };
  refused({}, "nothing says which part");
  refused({box(), "--target", "adcirc", "--numbers", file("n.csv")}, "--numbers");
  refused({"--bbox=1,2,3"}, "--bbox");
  EXPECT_EQ(runProgram({"cut", whole, "--within", file("none.gpkg"), "-o", file("part.nc")}).code, 3);
  EXPECT_EQ(runProgram({"cut", whole, box(), "-o", whole, "--overwrite"}).code, 2);
}

}  // namespace

}  // namespace coastmesh::test
