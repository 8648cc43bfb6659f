#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/lake_with_depths.hpp"
#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Remesh : public LakeWithDepths {
 protected:
  std::string mesh(const std::string& name) const { return meshOf(name, "120"); }
};

TEST_F(Remesh, KeepsTheRestByteForByte) {
  const std::string whole = mesh("whole.14");
  const ProgramRun run = runProgram({"remesh", whole, box(), "--size", "40", "--assume-crs", "EPSG:4326", "-o",
                                     file("finer.14"), "--numbers", file("numbers.csv")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr(" triangles replaced by "));
  EXPECT_THAT(run.output, HasSubstr("nodes added to boundaries: "));
  const std::vector<std::string> before = linesOf(whole), after = linesOf(file("finer.14"));
  std::size_t nodes_before = 0, triangles_before = 0, nodes = 0, triangles = 0;
  std::istringstream(before[1]) >> triangles_before >> nodes_before;
  std::istringstream(after[1]) >> triangles >> nodes;
  EXPECT_GT(triangles, 2 * triangles_before);
  // All nodes and triangles that stay are the same lines with the same numbers, as no fewer nodes were added than
  // removed.
  std::size_t same_nodes = 0, same_triangles = 0;
  const std::vector<std::string> table = linesOf(file("numbers.csv"));
  ASSERT_EQ(table.size(), 1 + nodes + triangles);
  EXPECT_EQ(table[0], "item,number,source");
  for (std::size_t i = 0; i < nodes + triangles; ++i) {
    std::istringstream row(table[1 + i]);
    std::string item, number, source;
    std::getline(row, item, ',');
    std::getline(row, number, ',');
    std::getline(row, source, ',');
    if (source.empty()) continue;
    const bool is_node = item == "node";
    EXPECT_EQ(number, source);
    const std::size_t n = std::stoul(number) + 1;
    EXPECT_EQ(after[is_node ? n : n + nodes], before[is_node ? n : n + nodes_before]);
    ++(is_node ? same_nodes : same_triangles);
  }
  EXPECT_GT(same_nodes, nodes_before / 4);
  EXPECT_GT(same_triangles, triangles_before / 4);
  const ProgramRun check = runProgram({"check", file("finer.14"), "--target", "adcirc", "--assume-crs", "EPSG:4326"});
  EXPECT_EQ(check.code, 0) << check.output;
}

TEST_F(Remesh, WorksOnEveryFormatAlike) {
  const std::string whole = mesh("whole.nc");
  ASSERT_EQ(runProgram({"remesh", whole, box(), "--size", "50", "-o", file("part.14"), "--quiet"}).code, 0);
  const std::vector<std::string> wanted = linesOf(file("part.14"));
  for (const std::string name : {"a.gpkg", "a.14", "a.gr3", "a.2dm", "a.vtu"}) {
    ASSERT_EQ(runProgram({"convert", whole, "-o", file(name), "--quiet"}).code, 0) << name;
    const ProgramRun run = runProgram({"remesh", file(name), box(), "--size", "50", "--assume-crs", "EPSG:4326", "-o",
                                       file("other.14"), "--overwrite"});
    ASSERT_EQ(run.code, 0) << name << run.errors;
    const std::vector<std::string> lines = linesOf(file("other.14"));
    ASSERT_GT(lines.size(), 3u);
    EXPECT_EQ(lines[1], wanted[1]) << name;  // the numbers of triangles and nodes
    EXPECT_EQ(lines[2], wanted[2]) << name;
  }
}

TEST_F(Remesh, IsWhatModelsAccept) {
  const std::string whole = mesh("whole.nc");
  for (const std::string target : {"adcirc", "schism", "fvcom", "telemac"}) {
    const ProgramRun made = runProgram({"remesh", whole, box(), "--size-shore", "20", "--size-max", "300", "-o",
                                        file("part.nc"), "--target", target, "--overwrite"});
    ASSERT_EQ(made.code, 0) << made.errors;
    const ProgramRun run = runProgram({"check", file("part.nc"), "--target", target});
    EXPECT_EQ(run.code, 0) << target << run.output;
  }
}

TEST_F(Remesh, DepthsOfNewNodesFromARaster) {
  const std::string whole = mesh("whole.nc");
  std::string raster = "ncols 40\nnrows 40\nxllcorner -87.52\nyllcorner 41.58\ncellsize 0.0015\n";
  for (int i = 0; i < 1600; ++i) raster += "-77 ";
  write("other.asc", raster);
  const ProgramRun run = runProgram({"remesh", whole, box(), "--size", "50", "--bathymetry", file("other.asc"), "-o",
                                     file("part.14"), "--numbers", file("numbers.csv")});
  ASSERT_EQ(run.code, 0) << run.errors;
  const std::vector<std::string> table = linesOf(file("numbers.csv")), grid = linesOf(file("part.14"));
  std::size_t added = 0;
  for (std::size_t i = 1; i < table.size() && table[i].starts_with("node,"); ++i) {
    std::istringstream row(grid[1 + i]);
    double number = 0.0, x = 0.0, y = 0.0, depth = 0.0;
    row >> number >> x >> y >> depth;
    if (table[i].ends_with(',')) {
      EXPECT_EQ(depth, 77.0);
      ++added;
    } else {
      EXPECT_LT(depth, 10.0);
    }
  }
  EXPECT_GT(added, 100u);
}

TEST_F(Remesh, SaysWhatItReplacesBesideThePart) {
  // A polygon round the middle of one triangle within the part.
  const std::string whole = mesh("whole.14");
  const std::vector<std::string> lines = linesOf(whole);
  std::size_t triangles = 0, nodes = 0, number = 0, corners = 0, corner = 0;
  std::istringstream(lines[1]) >> triangles >> nodes;
  double nearest = 1e9, middle_x = 0.0, middle_y = 0.0;
  for (std::size_t t = 0; t < triangles; ++t) {
    std::istringstream row(lines[2 + nodes + t]);
    row >> number >> corners;
    double x = 0.0, y = 0.0, node_x = 0.0, node_y = 0.0;
    while (row >> corner) {
      std::istringstream(lines[1 + corner]) >> number >> node_x >> node_y;
      x += node_x / 3.0;
      y += node_y / 3.0;
    }
    if (std::hypot(x + 87.492, y - 41.614) > nearest) continue;
    nearest = std::hypot(x + 87.492, y - 41.614);
    middle_x = x;
    middle_y = y;
  }
  const auto place = [&](double east, double north) {
    return "[" + std::to_string(middle_x + east) + "," + std::to_string(middle_y + north) + "]";
  };
  const double d = 2e-5;
  write("one.geojson", R"({"type":"Polygon","coordinates":[[)" + place(-d, -d) + "," + place(d, -d) + "," +
                           place(0.0, d) + "," + place(-d, -d) + "]]}");
  const ProgramRun run = runProgram({"remesh", whole, box(), "--outside", file("one.geojson"), "--size", "40",
                                     "--assume-crs", "EPSG:4326", "-o", file("part.14")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("replaced beside the part: 1 triangle, within it or for the sake of angles\n"));
}

TEST_F(Remesh, SaysHowFarTheTransitionReaches) {
  const std::string whole = mesh("whole.nc");
  const ProgramRun run =
      runProgram({"remesh", whole, "--bbox=-87.492,41.612,-87.485,41.616", "--size", "2", "-o", file("part.nc")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("a larger part or a larger --grade leaves more room"));
  EXPECT_THAT(run.output, HasSubstr("sizes change from those around to those asked for over up to "));
}

TEST_F(Remesh, RefusesWhatMakesNoSense) {
  const std::string whole = mesh("whole.nc");
  const auto expect = [&](const std::vector<std::string>& options, int code, const std::string& message) {
    std::vector<std::string> words{"remesh", whole, "-o", file("none.nc")};
    words.insert(words.end(), options.begin(), options.end());
    const ProgramRun run = runProgram(words);
    EXPECT_EQ(run.code, code) << run.errors;
    EXPECT_THAT(run.errors, HasSubstr(message));
  };
  expect({"--size", "50"}, 2, "nothing says which part");
  expect({box()}, 2, "nothing says how large");
  expect({box(), "--size-min", "10"}, 2, "nothing says how large");
  expect({box(), "--size-min", "10", "--size-max", "5"}, 2, "--size-min is more than --size-max");
  expect({box(), "--wave-elements", "100"}, 2, "need depths");
  expect({box(), "--size", "50", "--numbers", file("n.csv"), "--target", "adcirc"}, 2, "--numbers");
  expect({"--bbox=10,10,11,11", "--size", "50"}, 3, "no triangle");
  expect({box(), "--size", "0.0001"}, 3, "vertices");
}

}  // namespace

}  // namespace coastmesh::test
