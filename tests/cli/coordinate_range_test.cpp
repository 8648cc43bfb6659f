#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using Json = nlohmann::json;

class CoordinateRange : public ProgramTest {
 protected:
  // A square with sides of length `side`.
  std::string squarePoly(const std::string& side) const {
    return write("square.poly", "4 2 0 0\n1 0 0\n2 " + side + " 0\n3 " + side + " " + side + "\n4 0 " + side +
                                    "\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
  }
  std::string squareGeoJson(const std::string& side) const {
    return write("square.geojson", R"({"type":"Polygon","coordinates":[[[0,0],[)" + side + ",0],[" + side + "," + side +
                                       "],[0," + side + "],[0,0]]]}");
  }
};

// Simplification used to bring edges of overlapping polygons within rounding of each other: triangles turned over.
TEST_F(CoordinateRange, SimplifiedPolygonsThatOverlapMakeASoundMesh) {
  const std::string input = inputFile("simplify/overlapping_polygons.geojson");
  const std::vector<std::vector<std::string>> variants{{},
                                                       {"--size-max", "2220", "--min-angle", "36"},
                                                       {"--crs", "EPSG:32630"},
                                                       {"--snap", "0"},
                                                       {"--size", "3000", "--coast", "follow"},
                                                       {"--pinches", "open"}};
  for (const auto& options : variants) {
    SCOPED_TRACE(testing::PrintToString(options));
    std::vector<std::string> arguments{"mesh",       input,         "--simplify", "222",         "-o",
                                       file("a.nc"), "--overwrite", "--report",   file("a.json")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 0) << run.errors;
    const ProgramRun checked = runProgram({"check", file("a.nc")});
    EXPECT_EQ(checked.code, 0) << checked.output;
    EXPECT_GT(Json::parse(readText(file("a.json")))["mesh"]["min_angle_deg"], 0.05);
  }
}

TEST_F(CoordinateRange, BeyondTheRangeAnInputIsUnusable) {
  for (const std::string side : {"1e71", "1e160", "-1e308"}) {
    SCOPED_TRACE(side);
    for (const std::string& input : {squarePoly(side), squareGeoJson(side)}) {
      const ProgramRun run = runProgram({"mesh", input, "--crs", "plane", "-o", file("a.nc")});
      EXPECT_EQ(run.code, 3);
      EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
      EXPECT_NE(run.errors.find(input), std::string::npos) << run.errors;
    }
  }
}

TEST_F(CoordinateRange, TooSmallForLengthsAnInputIsUnusable) {
  for (const std::string side : {"1e-71", "1e-160", "5e-324"}) {
    SCOPED_TRACE(side);
    for (const std::string& input : {squarePoly(side), squareGeoJson(side)}) {
      const ProgramRun run = runProgram({"mesh", input, "--crs", "plane", "-o", file("a.nc")});
      EXPECT_EQ(run.code, 3) << run.errors;
      EXPECT_NE(run.errors.find(input), std::string::npos) << run.errors;
    }
  }
}

TEST_F(CoordinateRange, WithinTheRangeTheMeshIsTheSameAtAnyScale) {
  for (const std::string side : {"1", "1e69", "1e-69"}) {
    SCOPED_TRACE(side);
    for (const std::string& input : {squarePoly(side), squareGeoJson(side)}) {
      const ProgramRun run = runProgram({"mesh", input, "--crs", "plane", "-o", file("a.node"), "--overwrite"});
      EXPECT_EQ(run.code, 0) << run.errors;
      EXPECT_TRUE(readText(file("a.ele")).starts_with("2 3 ")) << readText(file("a.ele"));
    }
  }
}

TEST_F(CoordinateRange, SegmentsThatCrossAreBothNamed) {
  const std::string poly =
      write("crossing.poly", "4 2 0 0\n1 0 0\n2 1 1\n3 1 0\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
  const ProgramRun run = runProgram({"mesh", poly, "-o", file("a.nc")});
  EXPECT_EQ(run.code, 3);
  EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
  EXPECT_TRUE(run.errors.find("segments 3 and 1") != std::string::npos ||
              run.errors.find("segments 1 and 3") != std::string::npos)
      << run.errors;
}

// The boundary of a .poly follows the sizes as the coast of a layer does.
TEST_F(CoordinateRange, CoastFollowsInAPoly) {
  std::ostringstream text;
  constexpr int kPoints = 720;
  text.precision(17);
  text << kPoints << " 2 0 0\n";
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * 3.141592653589793 * i / kPoints, r = 1000 * (i % 2 ? 1.0 : 1.003);
    text << i + 1 << ' ' << r * std::cos(angle) << ' ' << r * std::sin(angle) << '\n';
  }
  text << kPoints << " 0\n";
  for (int i = 0; i < kPoints; ++i) text << i + 1 << ' ' << i + 1 << ' ' << (i + 1) % kPoints + 1 << '\n';
  const std::string poly = write("round.poly", text.str() + "0\n");
  const auto vertices = [&](const std::string& coast) {
    const ProgramRun run = runProgram({"mesh", poly, "--size", "200", "--coast", coast, "-o", file("a.nc"),
                                       "--overwrite", "--report", file("a.json")});
    EXPECT_EQ(run.code, 0) << run.errors;
    EXPECT_EQ(run.errors, "");
    return Json::parse(readText(file("a.json")))["mesh"]["vertices"].get<int>();
  };
  EXPECT_GT(vertices("keep"), 720);
  EXPECT_LT(vertices("follow"), 300);
}

}  // namespace

}  // namespace coastmesh::test
