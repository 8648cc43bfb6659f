// `check` on meshes of other programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Check : public ProgramTest {
 protected:
  std::string contentOf(const std::string& path) const {
    std::ifstream stream(path);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  // A fort.14 without boundaries: 4 by 4 squares of 1 km at each of `origins`, in metres.
  std::string sheets(const std::string& name, const std::vector<std::pair<double, double>>& origins,
                     double depth) const {
    constexpr int kSide = 4, kNodes = (kSide + 1) * (kSide + 1);
    std::string nodes, triangles;
    int node = 0, triangle = 0;
    for (std::size_t sheet = 0; sheet < origins.size(); ++sheet) {
      char line[100];
      for (int j = 0; j <= kSide; ++j) {
        for (int i = 0; i <= kSide; ++i) {
          std::snprintf(line, sizeof line, "%d %.1f %.1f %g\n", ++node, origins[sheet].first + 1000.0 * i,
                        origins[sheet].second + 1000.0 * j, depth);
          nodes += line;
        }
      }
      for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
          const int a = static_cast<int>(sheet) * kNodes + j * (kSide + 1) + i + 1, d = a + kSide + 1;
          std::snprintf(line, sizeof line, "%d 3 %d %d %d\n", ++triangle, a, a + 1, d + 1);
          triangles += line;
          std::snprintf(line, sizeof line, "%d 3 %d %d %d\n", ++triangle, a, d + 1, d);
          triangles += line;
        }
      }
    }
    return write(name, "sheets\n" + std::to_string(triangle) + " " + std::to_string(node) + "\n" + nodes + triangles +
                           "0\n0\n0\n0\n");
  }
};

TEST_F(Check, SheetsOverOneAnother) {
  const std::string one = sheets("one.14", {{0, 0}}, 10.0), two = sheets("two.14", {{0, 0}, {1500, 1500}}, 10.0);
  EXPECT_EQ(runProgram({"check", one}).code, 0);
  const ProgramRun plain = runProgram({"check", two});
  EXPECT_EQ(plain.code, 1);
  EXPECT_THAT(plain.output, AllOf(HasSubstr("overlapping triangles: "), HasSubstr(", with triangle ")));
  EXPECT_EQ(runProgram({"convert", two, "-o", file("out.14"), "--target", "adcirc"}).code, 1);
}

TEST_F(Check, NodesThatDoNotHangTogether) {
  const ProgramRun hanging = runProgram({"check", sheets("hanging.14", {{0, 0}, {4000, 500}}, 10.0)});
  EXPECT_EQ(hanging.code, 1);
  EXPECT_THAT(hanging.output, HasSubstr("hanging node: 8"));
  const ProgramRun seam = runProgram({"check", sheets("seam.14", {{0, 0}, {4000, 0}}, 10.0)});
  EXPECT_EQ(seam.code, 1);
  EXPECT_THAT(seam.output, HasSubstr("repeated node: 5"));
}

// The sheet's corners have the numbers 1, 5, 25 and 21.
TEST_F(Check, BoundariesThatAreNotTheMeshs) {
  const std::string bare = contentOf(sheets("bare.14", {{0, 0}}, 10.0));
  const std::string unbounded = bare.substr(0, bare.size() - std::string("0\n0\n0\n0\n").size());
  const std::string south = "1 2 3 4 5", rest = "5 10 15 20 25 24 23 22 21 16 11 6 1";
  const auto withBoundaries = [&](const std::string& open, const std::string& land) {
    const auto count = [](const std::string& nodes) { return std::to_string(std::ranges::count(nodes, ' ') + 1); };
    const auto lines = [](std::string nodes) {
      std::ranges::replace(nodes, ' ', '\n');
      return nodes + "\n";
    };
    return write("bounded.14", unbounded + "1\n" + count(open) + "\n" + count(open) + "\n" + lines(open) + "1\n" +
                                   count(land) + "\n" + count(land) + " 0\n" + lines(land));
  };
  EXPECT_EQ(runProgram({"check", withBoundaries(south, rest)}).code, 0);
  const ProgramRun short_cut = runProgram({"check", withBoundaries(south, "5 10 15 20 25 21 16 11 6 1")});
  EXPECT_EQ(short_cut.code, 1);
  EXPECT_THAT(short_cut.output, AllOf(HasSubstr("stray boundary: 1"), HasSubstr("no boundary: 4")));
  const ProgramRun twice = runProgram({"check", withBoundaries(south, "4 " + rest)});
  EXPECT_EQ(twice.code, 1);
  EXPECT_THAT(twice.output, HasSubstr("boundary twice: 1"));
}

TEST_F(Check, NodesWithoutTrianglesAreAdvice) {
  std::string text = contentOf(sheets("all.14", {{0, 0}}, 10.0));
  text.replace(text.find("32 25"), 5, "31 25");
  text.erase(text.find("32 3 "), text.find("0\n0\n0\n0\n") - text.find("32 3 "));
  text.replace(text.find("31 3 "), text.find("0\n0\n0\n0\n") - text.find("31 3 "), "31 3 1 2 7\n");
  const ProgramRun run = runProgram({"check", write("fewer.14", text)});
  EXPECT_THAT(run.output, HasSubstr("advice, unused node: 1"));
}

// A depth that was edited in the table of a layer; no model reads layers.
TEST_F(Check, WhatLayersContradictEachOtherInIsNoDefect) {
  const std::string sheet = sheets("sheet.14", {{0, 0}}, 10.0);
  ASSERT_EQ(runProgram({"convert", sheet, "-o", file("m.geojson")}).code, 0);
  std::string nodes = contentOf(file("m_nodes.geojson"));
  const std::string depth = "\"z\":-10";
  ASSERT_NE(nodes.find(depth), nodes.npos) << nodes;
  nodes.replace(nodes.find(depth), depth.size(), "\"z\":-7");
  write("m_nodes.geojson", nodes);
  const ProgramRun checked = runProgram({"check", file("m.geojson"), "--target", "adcirc"});
  EXPECT_EQ(checked.code, 0) << checked.output;
  EXPECT_THAT(checked.errors, HasSubstr("m.geojson': 1 node has another depth in the column z than its point has"));
  const ProgramRun made = runProgram({"convert", file("m.geojson"), "--target", "adcirc", "-o", file("m.14")});
  EXPECT_EQ(made.code, 0);
  EXPECT_EQ(made.output, "");
  EXPECT_THAT(contentOf(file("m.14")), AllOf(HasSubstr(" 7\n"), HasSubstr(" 10\n")));
}

TEST_F(Check, DepthsThatEarthDoesNotHaveAreWarnedOf) {
  const ProgramRun run = runProgram({"check", sheets("deep.14", {{0, 0}}, -99999.0)});
  EXPECT_EQ(run.code, 0);
  EXPECT_THAT(run.errors, HasSubstr("25 of 25 nodes have depths that do not occur on Earth, such as -99999 m"));
  EXPECT_EQ(runProgram({"check", sheets("sea.14", {{0, 0}}, 10900.0)}).errors, "");
}

TEST_F(Check, TimeStepsNeedDepths) {
  for (const double depth : {0.0, -3.0}) {
    const ProgramRun run = runProgram({"check", sheets("dry.14", {{0, 0}}, depth), "--time-step", "10"});
    EXPECT_EQ(run.code, 3);
    EXPECT_TRUE(isOneErrorLine(run.errors));
    EXPECT_THAT(run.errors, AllOf(HasSubstr("--time-step needs depths"), HasSubstr("dry.14")));
  }
  EXPECT_EQ(runProgram({"check", sheets("wet.14", {{0, 0}}, 10.0), "--time-step", "10"}).code, 0);
}

// A run that misses its bounds reports it even with --quiet.
TEST_F(Check, QuietMeshesSayThatTheyFallShort) {
  const std::vector<std::string> command{"mesh",    lake(),           "-o", file("m.nc"), "--min-angle", "40",
                                         "--quiet", "--max-vertices", "14"};
  const ProgramRun run = runProgram(command);
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.output, "");
  EXPECT_THAT(run.errors, HasSubstr("short of what was asked: "));
  EXPECT_THAT(run.errors, HasSubstr(" the bounds on angles or lengths, the first at (-87."));
}

}  // namespace
}  // namespace coastmesh::test
