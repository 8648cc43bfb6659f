// Seas in a frame: positions and depths of their open boundaries.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

class Frame : public ProgramTest {
 protected:
  std::string island() const {
    return write("island.geojson", geoJsonPolygons({{{{1, 61}, {2, 61}, {2.2, 61.4}, {1.4, 61.6}, {1, 61}}}}));
  }
  // A fort.14 file: x, y, depth of its nodes, and the nodes of each open boundary, counted from 0.
  struct Fort14 {
    std::vector<std::array<double, 3>> nodes;
    std::vector<std::vector<std::size_t>> open;
  };
  Fort14 read(const std::string& path) const {
    std::istringstream text(readText(path));
    std::string line;
    std::getline(text, line);
    std::size_t triangles = 0, nodes = 0, number = 0;
    text >> triangles >> nodes;
    Fort14 grid;
    grid.nodes.resize(nodes);
    for (auto& [x, y, depth] : grid.nodes) text >> number >> x >> y >> depth;
    for (std::size_t t = 0; t <= triangles; ++t) std::getline(text, line);
    std::size_t boundaries = 0;
    text >> boundaries;
    std::getline(text, line);
    std::getline(text, line);
    for (std::size_t b = 0; b < boundaries; ++b) {
      std::size_t count = 0;
      text >> count;
      std::getline(text, line);
      for (grid.open.emplace_back().resize(count); std::size_t & node : grid.open.back()) {
        text >> node;
        --node;
      }
    }
    return grid;
  }
};

// A box with west and east swapped is valid, but spans most of the Earth.
TEST_F(Frame, ABoxRoundMostOfTheEarthIsTold) {
  const std::vector<std::string> common{"mesh",    island(), "--domain",    "outside", "--size",      "300000",
                                        "--coast", "follow", "--overwrite", "-o",      file("sea.nc")};
  const auto outputOf = [&](const std::string& box) {
    std::vector<std::string> arguments = common;
    arguments.push_back("--bbox=" + box);
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 0) << run.errors;
    return run.output;
  };
  EXPECT_THAT(outputOf("3,58,0,64"), HasSubstr("reaches over 357 degrees across the antimeridian"));
  EXPECT_THAT(outputOf("0,58,3,64"), Not(HasSubstr("antimeridian")));
}

TEST_F(Frame, APlaneThatIsCutInTheBoxIsWarnedOf) {
  const LonLatRing shore{{-179.5, -17.0}, {-179.0, -17.0}, {-179.0, -16.0}};
  const std::string land = write("land.geojson", geoJsonPolygons({{shore}}));
  const auto errorsOf = [&](const std::string& plane) {
    const ProgramRun run = runProgram({"mesh", land, "--domain", "outside", "--bbox=178,-18,-178,-15", "--crs", plane,
                                       "--size", "30000", "-o", file("sea.nc"), "--overwrite"});
    EXPECT_EQ(run.code, 0) << run.errors;
    return run.errors;
  };
  EXPECT_THAT(errorsOf("EPSG:3395"), HasSubstr("is cut at the antimeridian, which --bbox crosses"));
  EXPECT_THAT(errorsOf("EPSG:3832"), Not(HasSubstr("is cut at")));
}

// The tip of a bay of a lake lies beyond the south of the box.
TEST_F(Frame, OpeningsOfOneEdgeAreWarnedOf) {
  const LonLatRing shore{{5.0, 60.05}, {5.1, 60.05}, {5.15, 59.98}, {5.2, 60.05},
                         {5.3, 60.05}, {5.3, 60.2},  {5.0, 60.2}};
  std::vector<std::string> arguments{"mesh",
                                     write("lake.geojson", geoJsonPolygons({{shore}})),
                                     "--bbox=4.9,60,5.4,60.3",
                                     "--size",
                                     "2000",
                                     "--coast",
                                     "follow",
                                     "-o",
                                     file("lake.14"),
                                     "--overwrite"};
  const ProgramRun run = runProgram(arguments);
  ASSERT_EQ(run.code, 0) << run.errors;
  ASSERT_EQ(read(file("lake.14")).open.size(), 1u);
  const std::string text = "1 open boundary is a single edge between shores, at (5.15, 60.0000",
                    option = "--min-boundary ";
  EXPECT_THAT(run.errors, HasSubstr(text));
  const std::size_t at = run.errors.find(option);
  ASSERT_NE(at, std::string::npos);
  const std::size_t number = at + option.size();
  arguments.insert(arguments.end(),
                   {"--min-boundary", run.errors.substr(number, run.errors.find(' ', number) - number)});
  const ProgramRun closed = runProgram(arguments);
  ASSERT_EQ(closed.code, 0) << closed.errors;
  EXPECT_TRUE(read(file("lake.14")).open.empty());
  EXPECT_THAT(closed.errors, Not(HasSubstr("single edge")));
}

TEST_F(Frame, NothingReachesPastTheBox) {
  const ProgramRun run = runProgram({"mesh", island(), "--domain", "outside", "--bbox=-9,58,9,64", "--size-shore",
                                     "10000", "--size-max", "90000", "--coast", "follow", "-o", file("sea.14")});
  ASSERT_EQ(run.code, 0) << run.errors;
  double north = 0.0;
  for (const auto& [x, y, depth] : read(file("sea.14")).nodes) {
    EXPECT_TRUE(x >= -9.0 && x <= 9.0 && y >= 58.0 && y <= 64.0) << x << " " << y;
    north = std::max(north, y);
  }
  EXPECT_EQ(north, 64.0);
}

// A corner of the lake reaches over the southern side along less than half an element, too little for an opening.
TEST_F(Frame, AShoreThatTheBoxGrazesStaysInIt) {
  const LonLatRing shore{{5.16, 60.0391},   {5.1635, 60.0459}, {5.1638, 60.0533}, {5.1574, 60.0599}, {5.1412, 60.062},
                         {5.125, 60.0608},  {5.1071, 60.0501}, {5.1021, 60.0492}, {5.0969, 60.0537}, {5.0861, 60.0605},
                         {5.0702, 60.0649}, {5.0575, 60.0627}, {5.042, 60.0602},  {5.0312, 60.0544}, {5.0417, 60.0453},
                         {5.0619, 60.0391}, {5.0741, 60.0363}, {5.087, 60.0362},  {5.0841, 60.0333}, {5.0751, 60.0253},
                         {5.0701, 60.0132}, {5.0811, 60.0099}, {5.0917, 59.9995}, {5.1076, 60.0028}, {5.1196, 60.009},
                         {5.1255, 60.017},  {5.116, 60.0302},  {5.1125, 60.0346}, {5.12, 60.0347},   {5.1326, 60.0356}};
  const ProgramRun run = runProgram({"mesh", write("lake.geojson", geoJsonPolygons({{shore}})), "--bbox=5,60,5.3,60.09",
                                     "--size", "2000", "--coast", "follow", "-o", file("lake.14")});
  ASSERT_EQ(run.code, 0) << run.errors;
  const Fort14 grid = read(file("lake.14"));
  EXPECT_TRUE(grid.open.empty());
  for (const auto& [x, y, depth] : grid.nodes) EXPECT_GE(y, 60.0) << x;
}

// Moving nodes onto the box used to leave an angle of 32.89 degrees, and the report had that of before.
TEST_F(Frame, NodesStayBesideTheBoxWhereAnglesWouldBreakTheBound) {
  const ProgramRun run = runProgram({"mesh", island(), "--domain", "outside", "--bbox=0,60.5,4,61.61", "--size",
                                     "10000", "-o", file("sea.nc"), "--report", file("sea.json")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_EQ(runProgram({"check", file("sea.nc"), "--min-angle", "33"}).code, 0);
  const Json report = Json::parse(readText(file("sea.json")));
  const ProgramRun info = runProgram({"info", file("sea.nc"), "--json"});
  const Json written = Json::parse(info.output);
  EXPECT_NEAR(report["mesh"]["min_angle_deg"].get<double>(), written["min_angle_deg"].get<double>(), 0.01)
      << info.output;
}

// Nodes that were moved onto the box are not missing.
TEST_F(Frame, AMeshInABoxAgreesWithItsInput) {
  LonLatRing shore;
  for (int i = 0; i < 240; ++i) {
    const double angle = 2.0 * M_PI * i / 240, radius = 0.35 + 0.08 * std::sin(9.0 * angle);
    shore.push_back({29.6 + 1.24 * radius * std::cos(angle), 62.35 + radius * std::sin(angle)});
  }
  const std::string lake = write("wavy.geojson", geoJsonPolygons({{shore}}));
  const std::string box = "--bbox=29.3,62.1,29.9,62.6";
  ASSERT_EQ(runProgram({"mesh", lake, box, "-o", file("wavy.nc")}).code, 0);
  const ProgramRun check = runProgram({"check", file("wavy.nc"), "--input", lake, box});
  EXPECT_EQ(check.code, 0) << check.output;
}

// The side of a box bulges beyond its parallel, so that a shore, and nodes beside it, may lie between the two. They are
// moved onto the box too, but lay on no side of it before.
TEST_F(Frame, AMeshBetweenTheBoxAndItsSideAgreesWithItsInput) {
  const std::string box = "--bbox=-1.44,59.9,-1.09,60.073294";
  for (const auto& [tip, foot] : {std::pair{60.0733144, -1.20817}, {60.073313, -1.20748}, {60.0733024, -1.20784}}) {
    const LonLatRing shore{{-1.2084, 60.0737}, {-1.20755, tip}, {foot, 60.0716}, {-1.22, 60.07}, {-1.22, 60.075}};
    const std::string land = write("land.geojson", geoJsonPolygons({{shore}}));
    ASSERT_EQ(runProgram({"mesh", land, "--domain", "outside", box, "-o", file("sea.nc"), "--overwrite"}).code, 0);
    const ProgramRun check = runProgram({"check", file("sea.nc"), "--input", land, "--domain", "outside", box});
    EXPECT_EQ(check.code, 0) << check.output;
  }
}

TEST_F(Frame, ARingOfOpenBoundaryIsSaidToBeTwo) {
  const std::vector<std::string> arguments{"mesh",         island(), "--domain", "outside",     "--bbox=-9,58,9,64",
                                           "--size-shore", "10000",  "-o",       file("sea.14")};
  const ProgramRun run = runProgram(arguments);
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("1 open boundary is a ring, which '" + file("sea.14") + "' holds as two"));
  const Fort14 grid = read(file("sea.14"));
  ASSERT_EQ(grid.open.size(), 2u);
  EXPECT_EQ(grid.open[0].front(), grid.open[1].back());
  EXPECT_EQ(grid.open[0].back(), grid.open[1].front());
}

// The frame cuts through land that the raster has 30 m above the water.
TEST_F(Frame, OpenNodesAreUnderWater) {
  const std::string land = write("land.geojson", geoJsonPolygons({{{{-1, -1}, {5, -1}, {5, 1}, {-1, 1}, {-1, -1}}}}));
  std::string text = "ncols 60\nnrows 60\nxllcorner -1\nyllcorner -1\ncellsize 0.1\n";
  for (int j = 0; j < 60; ++j) {
    const double y = 5.0 - 0.1 * (j + 0.5);
    for (int i = 0; i < 60; ++i)
      text += std::to_string(y < 1.0 ? 30.0 : -20.0 * y) + " ";  // dry at the ends of the coast
    text += "\n";
  }
  const std::vector<std::string> arguments{
      "mesh",         land,           "--domain",           "outside", "--bbox=0,0,4,4", "--size-shore",
      "20000",        "--bathymetry", write("b.asc", text), "-o",      file("sea.14"),   "-o",
      file("sea.nc"), "--overwrite"};
  ASSERT_EQ(runProgram(arguments).code, 0);
  const ProgramRun before = runProgram({"check", file("sea.14"), "--target", "adcirc"});
  EXPECT_EQ(before.code, 1);
  EXPECT_THAT(before.output, HasSubstr("adcirc: dry opening: "));
  std::vector<std::string> mended = arguments;
  mended.insert(mended.end(), {"--target", "adcirc"});
  const ProgramRun run = runProgram(mended);
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("dry opening"));
  const Fort14 grid = read(file("sea.14"));
  for (const auto& nodes : grid.open)
    for (const std::size_t node : nodes) EXPECT_GT(grid.nodes.at(node)[2], 0.0);
  EXPECT_EQ(runProgram({"check", file("sea.14"), "--target", "adcirc"}).code, 0);
}

// Two capes of land reach out of the box in the west, with 20 km of open water between them.
TEST_F(Frame, ShortPiecesOfOpenBoundaryGo) {
  const std::string land =
      write("capes.geojson", geoJsonPolygons({{{{-1, 1}, {0.3, 1}, {0.3, 1.5}, {-1, 1.5}, {-1, 1}}},
                                              {{{-1, 1.68}, {0.3, 1.68}, {0.3, 2.2}, {-1, 2.2}, {-1, 1.68}}}}));
  std::vector<std::string> arguments{"mesh",         land,   "--domain", "outside",      "--bbox=0,0,4,4",
                                     "--size-shore", "5000", "-o",       file("sea.14"), "--overwrite"};
  ASSERT_EQ(runProgram(arguments).code, 0);
  EXPECT_EQ(read(file("sea.14")).open.size(), 2u);
  arguments.insert(arguments.end(), {"--min-boundary", "30000"});
  ASSERT_EQ(runProgram(arguments).code, 0);
  EXPECT_EQ(read(file("sea.14")).open.size(), 1u);
}

// --domain outside agrees with --water-at, inside contradicts it.
TEST_F(Frame, WaterAtAPlaceIsOutsideOfLand) {
  const std::string lake = write("lake.geojson", geoJsonPolygons({{{{1, 61}, {2, 61}, {2, 62}, {1, 62}, {1, 61}}}}));
  const auto errorsWith = [&](const std::string& side) {
    const ProgramRun run = runProgram({"mesh", lake, "--domain", side, "--water-at", "1.5,61.5", "--size", "20000",
                                       "-o", file("a.nc"), "--overwrite"});
    EXPECT_EQ(run.code, 0) << run.errors;
    return run.errors;
  };
  EXPECT_THAT(errorsWith("outside"), Not(HasSubstr("--domain")));
  EXPECT_THAT(errorsWith("inside"), HasSubstr("--domain has no effect with --water-at"));
}

// Five squares side by side, and one elsewhere.
TEST_F(Frame, FeaturesInOtherWaterAreCountedOneByOne) {
  std::vector<std::vector<LonLatRing>> squares;
  for (const double west : {0.0, 1.0, 1.1, 1.2, 1.3, 1.4})
    squares.push_back({{{west, 0}, {west + 0.1, 0}, {west + 0.1, 0.1}, {west, 0.1}}});
  const std::string input = write("squares.geojson", geoJsonPolygons(squares));
  const ProgramRun run =
      runProgram({"mesh", input, "--water-at", "0.05,0.05", "-o", file("s.2dm"), "--report", file("r.json")});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_EQ(Json::parse(readText(file("r.json")))["input"]["beyond_frame"], 5);
}

}  // namespace
}  // namespace coastmesh::test
