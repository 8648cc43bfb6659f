// Meshes of the sea with the low land beside it, and frames whose sides cross land.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Land from longitude 0.1 on, in a frame from (0, 50) to (0.2, 50.1), with heights in pixels of 0.002 degrees.
class FloodPlainRun : public ProgramTest {
 protected:
  FloodPlainRun() { write("land.geojson", geoJsonPolygons({{{{0.1, 49.5}, {0.9, 49.5}, {0.9, 50.5}, {0.1, 50.5}}}})); }

  using Height = std::function<double(double lon, double lat)>;
  std::string dem(const Height& height) const {
    std::ostringstream raster;
    raster << "ncols 110\nnrows 60\nxllcorner -0.01\nyllcorner 49.99\ncellsize 0.002\nNODATA_value -9999\n";
    for (int row = 0; row < 60; ++row)
      for (int column = 0; column < 110; ++column)
        raster << height(-0.01 + 0.002 * (column + 0.5), 50.11 - 0.002 * (row + 0.5)) << (column < 109 ? ' ' : '\n');
    write("dem.asc", raster.str());
    return file("dem.asc");
  }
  ProgramRun mesh(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"mesh", file("land.geojson"), "--domain",   "outside", "--bbox", "0,50,0.2,50.1",
                                       "-o",   file("fort.14"),      "--overwrite"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram(arguments);
  }

  struct Node {
    double lon = 0.0, lat = 0.0, depth = 0.0;
    bool open = false;
  };
  std::vector<Node> nodes(const std::string& name = "fort.14") const {
    std::istringstream text(readText(file(name)));
    std::string title, rest;
    std::getline(text, title);
    std::size_t elements = 0, count = 0, number = 0, segments = 0, open = 0;
    text >> elements >> count;
    std::vector<Node> all(count);
    for (Node& node : all) text >> number >> node.lon >> node.lat >> node.depth;
    std::getline(text, rest);
    for (std::size_t i = 0; i < elements; ++i) std::getline(text, rest);
    text >> segments;
    std::getline(text, rest);
    text >> open;
    std::getline(text, rest);
    for (std::size_t s = 0; s < segments; ++s) {
      std::size_t length = 0;
      text >> length;
      std::getline(text, rest);
      for (std::size_t i = 0; i < length; ++i) {
        text >> number;
        all.at(number - 1).open = true;
      }
    }
    EXPECT_TRUE(text.good());
    return all;
  }
};

// Water 20 m deep in the west; land that rises from the coast at 0.1 to 10 m at 0.15, and on.
double slope(double lon, double) { return lon < 0.1 ? -20.0 : 200.0 * (lon - 0.1); }

TEST_F(FloodPlainRun, TheMeshReachesTheContour) {
  const ProgramRun run = mesh({"--bathymetry", dem(slope), "--flood-height", "10", "--size-shore", "400", "--size-max",
                               "1500", "--coast", "follow", "--target", "adcirc"});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output + run.errors, HasSubstr("of the land is meshed besides the water"));
  double east = 0.0;
  std::size_t near_coast = 0, dry = 0, open = 0;
  for (const Node& node : nodes()) {
    east = std::max(east, node.lon);
    near_coast += std::abs(node.lon - 0.1) < 0.002;
    open += node.open;
    if (node.open) {
      EXPECT_GT(node.depth, 0.0) << node.lon << " " << node.lat;
    }
    if (node.lon < 0.102) continue;
    ++dry;
    EXPECT_NEAR(node.depth, -slope(node.lon, node.lat), 0.3);
  }
  EXPECT_NEAR(east, 0.15, 0.001);
  EXPECT_GE(near_coast, 15u);  // 11 km with edges of 400 m, though the coast is no line of the mesh
  EXPECT_GT(dry, 100u);
  EXPECT_GT(open, 10u);
}

// An attribute that no user gave is worth no warning; of edits it is.
TEST_F(FloodPlainRun, FormatsWithoutAttributesLoseThePlain) {
  const ProgramRun made = mesh(
      {"--bathymetry", dem(slope), "--flood-height", "5", "--size", "800", "-o", file("a.2dm"), "-o", file("a.nc")});
  ASSERT_EQ(made.code, 0) << made.errors;
  EXPECT_THAT(made.errors, Not(HasSubstr("flood_plain")));
  const ProgramRun converted = runProgram({"convert", file("a.nc"), "-o", file("b.2dm")});
  EXPECT_THAT(converted.errors, HasSubstr("the nodal attribute flood_plain"));
}

// Fine triangles on land that lies just above the still water, coarse ones in the water.
TEST_F(FloodPlainRun, CheckAdvisesOnTheStepOfTheFlood) {
  const std::string heights = dem([](double lon, double) { return lon < 0.1 ? -1.0 : 8.0 * (lon - 0.1) / 0.1; });
  ASSERT_EQ(mesh({"--bathymetry", heights, "--flood-height", "7", "--size", "500", "--target", "adcirc"}).code, 0);
  const std::string info = runProgram({"info", file("fort.14"), "--json"}).output;
  const auto step = nlohmann::json::parse(info)["step"];
  const double still_s = step["time_step_s"], flooded_s = step["flooded"]["time_step_s"];
  ASSERT_LT(flooded_s, 0.9 * still_s);
  const auto advice = [&](double step_s) {
    const ProgramRun run =
        runProgram({"check", file("fort.14"), "--target", "adcirc", "--time-step", std::to_string(step_s)});
    EXPECT_EQ(run.code, 0) << run.output;
    return run.output.find("advice, courant when flooded: 1") != std::string::npos;
  };
  EXPECT_FALSE(advice(0.99 * flooded_s));
  EXPECT_TRUE(advice(0.5 * (flooded_s + still_s)));
}

TEST_F(FloodPlainRun, ACoastThatIsKeptStaysALine) {
  const auto onCoast = [this] {
    const std::vector<Node> all = nodes();
    return std::ranges::count_if(all, [](const Node& node) { return std::abs(node.lon - 0.1) < 1e-6; });
  };
  std::vector<std::string> options{"--bathymetry", dem(slope),   "--flood-height", "10",      "--size-shore",
                                   "400",          "--size-max", "1500",           "--coast", "follow"};
  ASSERT_EQ(mesh(options).code, 0);
  EXPECT_LT(onCoast(), 5);
  options.back() = "keep";
  ASSERT_EQ(mesh(options).code, 0);
  EXPECT_GE(onCoast(), 15);
}

TEST_F(FloodPlainRun, AMinimumDepthIsForTheWater) {
  const std::string heights = dem([](double lon, double) { return lon < 0.1 ? -1.0 : 4.0; });
  ASSERT_EQ(mesh({"--bathymetry", heights, "--flood-height", "10", "--min-depth", "3", "--size", "1000"}).code, 0);
  for (const Node& node : nodes()) {
    if (node.lon < 0.097) {
      EXPECT_DOUBLE_EQ(node.depth, 3.0);
    }
    if (node.lon > 0.103) {
      EXPECT_DOUBLE_EQ(node.depth, -4.0);
    }
  }
}

// A dike of 4 m from the coast at 0.1 to 0.115; behind it a polder 1 m below the still water, which rises from 0.16 on.
double polder(double lon, double) {
  return lon < 0.1 ? -20.0 : lon < 0.115 ? 4.0 : lon < 0.16 ? -1.0 : 200.0 * (lon - 0.165);
}

class PolderRun : public FloodPlainRun {
 protected:
  ProgramRun meshPolder(const std::string& coast, const std::vector<std::string>& more) const {
    std::vector<std::string> options{"--bathymetry", dem(polder), "--depth-method", "average", "--flood-height", "5",
                                     "--size-shore", "400",       "--size-max",     "800",     "--coast",        coast,
                                     "--min-depth",  "3"};
    options.insert(options.end(), more.begin(), more.end());
    return mesh(options);
  }
  // The nodes of a fort.13 that do not have the default of an attribute, which is 0.
  std::set<std::size_t> nodesWith(const std::string& attribute, const std::string& name = "fort.13") const {
    std::istringstream text(readText(file(name)));
    std::string line;
    for (int found = 0; found < 2 && std::getline(text, line);) found += line == attribute;
    EXPECT_EQ(line, attribute);
    std::size_t count = 0, number = 0;
    text >> count;
    std::set<std::size_t> nodes;
    double value = 0.0;
    while (nodes.size() < count && text >> number >> value) {
      EXPECT_EQ(value, 1.0);
      nodes.insert(number);
    }
    return nodes;
  }
  std::set<std::size_t> startDry(const std::string& name = "fort.13") const {
    return nodesWith("surface_submergence_state", name);
  }
  // In the middle of the polder, off the rivers of `RiversAreWaterInAPlain`.
  std::vector<double> polderDepths(const std::string& name) const {
    std::vector<double> depths;
    for (const Node& node : nodes(name))
      if (node.lon > 0.122 && node.lon < 0.147 && (node.lat < 50.045 || node.lat > 50.055))
        depths.push_back(node.depth);
    return depths;
  }
};

TEST_F(PolderRun, APolderIsLand) {
  for (const std::string coast : {"follow", "keep"}) {
    const ProgramRun run = meshPolder(coast, {"--target", "adcirc"});
    ASSERT_EQ(run.code, 0) << run.errors;
    const std::string all = run.output + run.errors;
    EXPECT_THAT(all, Not(HasSubstr("dry opening")));
    EXPECT_THAT(all, HasSubstr("nodes of the flood plain lie below the still water without a connection to it, the "
                               "lowest by 1 m at "));
    EXPECT_THAT(all, HasSubstr("surface_submergence_state is 1 there"));
    const std::vector<Node> found = nodes();
    std::size_t in_polder = 0, open = 0;
    std::set<std::size_t> low;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Node& node = found[i];
      open += node.open;
      if (node.lon > 0.104) {
        EXPECT_FALSE(node.open) << node.lon << " " << node.lat;
        if (node.depth > 0.0) low.insert(i + 1);
      }
      if (node.lon > 0.122 && node.lon < 0.147) {
        ++in_polder;
        EXPECT_NEAR(node.depth, 1.0, 1e-6) << node.lon << " " << node.lat;
      }
      if (node.lon > 0.106 && node.lon < 0.109) {
        EXPECT_LT(node.depth, 0.0) << "the dike at " << node.lat;
      }
      if (node.open) {
        EXPECT_GE(node.depth, 3.0);
      }
    }
    EXPECT_GT(in_polder, 30u);
    EXPECT_GT(open, 10u);
    EXPECT_EQ(startDry(), low);
    const std::set<std::size_t> plain = nodesWith("flood_plain");
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found[i].lon > 0.104 || found[i].lon < 0.097) {
        EXPECT_EQ(plain.contains(i + 1), found[i].lon > 0.1);
      }
    }
  }
}

constexpr double kPolderDepth = 1.0, kLeastDepth = 3.0;

// Files of the mesh tell land from water.
TEST_F(PolderRun, EditsLeaveIt) {
  ASSERT_EQ(meshPolder("follow", {}).code, 0);
  const std::vector<std::string> deeper{"--bathymetry", dem(polder), "--depth-method", "average", "--min-depth", "3"};
  const auto edited = [&](std::vector<std::string> arguments, const std::string& name) {
    arguments.insert(arguments.end(), deeper.begin(), deeper.end());
    arguments.insert(arguments.end(), {"-o", file(name), "--quiet"});
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 0) << run.errors;
    return polderDepths(name);
  };
  const auto isNear = ::testing::Each(::testing::DoubleNear(kPolderDepth, 1e-6));
  const std::size_t before = polderDepths("fort.14").size();
  EXPECT_THAT(edited({"convert", file("fort.14")}, "converted.14"),
              ::testing::AllOf(::testing::SizeIs(before), isNear));
  const std::vector<std::string> part{"--bbox=0.08,50.02,0.15,50.08", "--size", "250"};
  const std::vector<double> finer = edited({"remesh", file("fort.14"), part[0], part[1], part[2]}, "finer.14");
  EXPECT_GT(finer.size(), before + 15);
  EXPECT_THAT(finer, isNear);
  for (const Node& node : nodes("finer.14")) {
    if (node.lon < 0.097) {
      EXPECT_GE(node.depth, kLeastDepth);
    }
  }
  EXPECT_GT(nodesWith("flood_plain", "finer.13").size(), nodesWith("flood_plain").size() + 20);
  // And again, through other formats.
  for (const char* const name : {"finer.nc", "finer.gr3"}) {
    ASSERT_EQ(runProgram({"convert", file("finer.14"), "-o", file(name), "--quiet"}).code, 0);
    EXPECT_THAT(edited({"remesh", file(name), part[0], part[1], "400", "--overwrite"}, "again.14"), isNear);
  }
  // What the file does not tell is water.
  std::filesystem::remove(file("fort.13"));
  EXPECT_THAT(edited({"remesh", file("fort.14"), part[0], part[1], part[2]}, "drowned.14"),
              ::testing::Contains(kLeastDepth));
  // A raster of the land tells it.
  std::string land = "ncols 2\nnrows 1\nxllcorner -0.3\nyllcorner 49.9\ncellsize 0.4\n0 1\n";
  write("land.asc", land);
  EXPECT_THAT(edited({"convert", file("fort.14"), "--attribute", "flood_plain=" + file("land.asc")}, "told.14"),
              isNear);
  EXPECT_THAT(edited({"remesh", file("told.14"), part[0], part[1], part[2]}, "finer2.14"), isNear);
}

TEST_F(PolderRun, NestsAndRiversLeaveIt) {
  ASSERT_EQ(meshPolder("follow", {"-o", file("outer.nc")}).code, 0);
  const std::vector<std::string> deeper{"--bathymetry", dem(polder), "--min-depth", "3", "--quiet"};
  const auto edited = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), deeper.begin(), deeper.end());
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 0) << run.errors;
    return run;
  };
  const auto isNear = ::testing::Each(::testing::DoubleNear(kPolderDepth, 1e-6));
  edited({"mesh", file("land.geojson"), "--domain", "outside", "--bbox", "0.06,50.03,0.135,50.07", "--flood-height",
          "5", "--size-shore", "200", "--size-max", "400", "--coast", "follow", "-o", file("nest.nc")});
  const ProgramRun merged = edited({"merge", file("outer.nc"), file("nest.nc"), "-o", file("both.14")});
  EXPECT_THAT(merged.errors, Not(HasSubstr("stay closed")));  // though its sides lie below the water
  const std::vector<double> both = polderDepths("both.14");
  EXPECT_GT(both.size(), polderDepths("fort.14").size() + 20);
  EXPECT_THAT(both, isNear);
  // A river from the polder to the sea, 100 m wide.
  write("river.geojson", R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry":
    {"type": "LineString", "coordinates": [[0.14, 50.05], [0.12, 50.05], [0.095, 50.05]]}}]})");
  edited(
      {"rivers", file("outer.nc"), file("river.geojson"), "--width", "100", "--extent", "all", "-o", file("river.14")});
  EXPECT_THAT(polderDepths("river.14"), isNear);
  std::size_t in_river = 0;
  for (const Node& node : nodes("river.14"))
    in_river +=
        node.lon > 0.122 && node.lon < 0.138 && std::abs(node.lat - 50.05) < 0.0006 && node.depth == kLeastDepth;
  EXPECT_GT(in_river, 10u);
}

TEST_F(PolderRun, RemeshingKeepsWhatStartsDry) {
  ASSERT_EQ(meshPolder("follow", {"--target", "adcirc"}).code, 0);
  const std::size_t before = startDry().size();
  const ProgramRun run = runProgram({"remesh", file("fort.14"), "--bbox", "0.11,50.02,0.15,50.08", "--size", "250",
                                     "--target", "adcirc", "-o", file("finer.14")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_GT(startDry("finer.13").size(), before + 20);
}

TEST_F(PolderRun, DepthsOpenNoBoundaryOnLand) {
  ASSERT_EQ(meshPolder("follow", {"--open-deeper", "0.5"}).code, 0);
  for (const Node& node : nodes())
    if (node.lon > 0.104) {
      EXPECT_FALSE(node.open) << node.lon << " " << node.lat;
    }
}

TEST_F(PolderRun, OnlyAdcircIsToldWhatStartsDry) {
  const ProgramRun run = meshPolder("follow", {"--target", "schism"});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output + run.errors, HasSubstr("models start them wet"));
  EXPECT_THAT(readText(file("fort.13")), Not(HasSubstr("surface_submergence_state")));
}

TEST_F(PolderRun, TheUsersAttributeIsKept) {
  const ProgramRun run = meshPolder("follow", {"--target", "adcirc", "--attribute", "surface_submergence_state=0"});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output + run.errors, HasSubstr("models start them wet"));
  EXPECT_TRUE(startDry().empty());
}

TEST_F(FloodPlainRun, SidesOfAFrameAcrossLandAreLand) {
  // The polygon is land and water.
  write("land.geojson", geoJsonPolygons({{{{-1, 49}, {1, 49}, {1, 51}, {-1, 51}}}}));
  const std::string heights = dem(slope);
  const ProgramRun run =
      runProgram({"mesh", file("land.geojson"), "--domain", "inside", "--bbox", "0,50,0.2,50.1", "--bathymetry",
                  heights, "--size", "800", "--target", "adcirc", "-o", file("fort.14")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output + run.errors, HasSubstr("lie on land and are no open boundary"));
  std::size_t open = 0;
  for (const Node& node : nodes()) {
    open += node.open;
    if (node.lon > 0.102) {
      EXPECT_FALSE(node.open) << node.lon << " " << node.lat;
      EXPECT_NEAR(node.depth, -slope(node.lon, node.lat), 0.1);
    } else if (node.lon < 0.097 && (node.lon == 0.0 || node.lat == 50.0 || node.lat == 50.1)) {
      EXPECT_TRUE(node.open) << node.lon << " " << node.lat;
    }
  }
  EXPECT_GT(open, 20u);
}

// Meshes with the plain: one of all, and a part of it.
class Nest : public FloodPlainRun {
 protected:
  Nest() {
    const std::string heights = dem(slope);
    const auto make = [&](const std::string& name, const std::string& box, const std::string& shore,
                          const std::string& most) {
      const ProgramRun run = runProgram({"mesh", file("land.geojson"), "--domain", "outside", "--bbox", box,
                                         "--bathymetry", heights, "--flood-height", "10", "--size-shore", shore,
                                         "--size-max", most, "--coast", "follow", "-o", file(name), "--quiet"});
      EXPECT_EQ(run.code, 0) << run.errors;
    };
    make("outer.nc", "0,50,0.2,50.1", "400", "1500");
    make("nest.nc", "0.06,50.03,0.13,50.07", "150", "500");
  }
  double areaOf(const std::string& name) const {
    return nlohmann::json::parse(runProgram({"info", file(name), "--json"}).output).at("area_m2").get<double>();
  }
};

TEST_F(Nest, IsJoinedAcrossThePlainToo) {
  const ProgramRun run = runProgram(
      {"merge", file("outer.nc"), file("nest.nc"), "-o", file("both.nc"), "-o", file("both.14"), "--target", "adcirc"});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr(" of them sides of its frame across land\n"));
  EXPECT_THAT(run.errors, Not(HasSubstr("stay closed")));
  EXPECT_NEAR(areaOf("both.nc") / areaOf("outer.nc"), 1.0, 1e-4);
}

TEST_F(Nest, SidesThatStayClosedAreNamed) {
  // The outer mesh's depths say that all of it is water.
  const std::string deep = dem([](double, double) { return -20.0; });
  ASSERT_EQ(runProgram({"convert", file("outer.nc"), "--bathymetry", deep, "--attribute", "flood_plain=0", "-o",
                        file("deep.nc"), "--quiet"})
                .code,
            0);
  const ProgramRun run = runProgram({"merge", file("deep.nc"), file("nest.nc"), "-o", file("both.nc")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output, Not(HasSubstr("across land")));
  EXPECT_THAT(run.errors, HasSubstr(" m of its land boundary run through triangles of the other mesh, such as at ("));
  EXPECT_THAT(run.errors, HasSubstr("): they stay closed; if they are sides of its frame, convert --boundaries"));
  EXPECT_LT(areaOf("both.nc") / areaOf("outer.nc"), 0.99);
}

TEST_F(Nest, LandOfAMeshIsNoMistake) {
  const std::string deep = dem([](double, double) { return -20.0; });
  ASSERT_EQ(runProgram({"convert", file("outer.nc"), "--bathymetry", deep, "-o", file("deep.nc"), "--quiet"}).code, 0);
  const std::string heights = dem(slope);
  const auto warningsOf = [&](const std::string& mesh) {
    const ProgramRun run = runProgram({"remesh", file(mesh), "--bbox=0.11,50.02,0.14,50.08", "--size", "200",
                                       "--bathymetry", heights, "-o", file("finer.nc"), "--overwrite"});
    EXPECT_EQ(run.code, 0) << run.errors;
    return run.errors;
  };
  EXPECT_THAT(warningsOf("outer.nc"), Not(HasSubstr("--depth-sign")));
  EXPECT_THAT(warningsOf("deep.nc"), HasSubstr("--depth-sign"));
}

TEST_F(Nest, AMinimumDepthOfNewNodesIsForTheWater) {
  const ProgramRun run =
      runProgram({"remesh", file("outer.nc"), "--bbox=0.08,50.02,0.14,50.08", "--size", "200", "--bathymetry",
                  dem(slope), "--min-depth", "30", "-o", file("fort.14"), "--quiet"});
  ASSERT_EQ(run.code, 0) << run.errors;
  std::size_t lowered = 0;
  for (const Node& node : nodes()) {
    lowered += node.depth == 30.0;
    if (node.lon > 0.108) {  // an edge of the mesh before from the coast
      EXPECT_LT(node.depth, 0.0) << node.lon << " " << node.lat;
    }
  }
  EXPECT_GT(lowered, 20u);
}

// From the frame of the nest to the next pairs of nodes of the other mesh, on both sides.
TEST_F(FloodPlainRun, WeirsOfANestGoOnAcrossItsFrame) {
  write("levee.geojson",
        R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"height": 8}, "geometry": )"
        R"({"type": "LineString", "coordinates": [[0.13, 50.01], [0.13, 50.09]]}}]})");
  const auto meshed = [&](const std::string& box, const std::string& size, const std::string& name) {
    const ProgramRun run = runProgram({"mesh",
                                       file("land.geojson"),
                                       "--domain",
                                       "outside",
                                       "--bbox",
                                       box,
                                       "--bathymetry",
                                       dem(slope),
                                       "--flood-height",
                                       "10",
                                       "--size-shore",
                                       size,
                                       "--size-max",
                                       "1500",
                                       "--coast",
                                       "follow",
                                       "--weirs",
                                       file("levee.geojson"),
                                       "--target",
                                       "adcirc",
                                       "-o",
                                       file(name)});
    EXPECT_EQ(run.code, 0) << run.errors;
    return file(name);
  };
  const ProgramRun run =
      runProgram({"merge", meshed("0,50,0.2,50.1", "600", "outer.14"),
                  meshed("0.05,50.03,0.18,50.07", "300", "nest.14"), "-o", file("both.14"), "--target", "adcirc"});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.errors, Not(HasSubstr("leaves a gap")));
  EXPECT_THAT(run.errors, Not(HasSubstr("leaves gaps")));
  EXPECT_EQ(runProgram({"check", file("both.14"), "--target", "adcirc"}).code, 0);
}

TEST_F(FloodPlainRun, WhatCannotBeMeant) {
  const std::string heights = dem(slope);
  const auto errorOf = [&](const std::vector<std::string>& more) {
    const ProgramRun run = mesh(more);
    EXPECT_NE(run.code, 0);
    EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
    return run.errors;
  };
  EXPECT_THAT(errorOf({"--flood-height", "10"}), HasSubstr("give a raster with --bathymetry"));
  EXPECT_THAT(errorOf({"--flood-height", "0", "--bathymetry", heights}), HasSubstr("--flood-height"));
  const ProgramRun globe = runProgram({"mesh", file("land.geojson"), "--domain", "globe", "--size", "500000",
                                       "--bathymetry", heights, "--flood-height", "10", "-o", file("globe.nc")});
  EXPECT_EQ(globe.code, 2);
  EXPECT_THAT(globe.errors, HasSubstr("--flood-height is not for --domain globe"));
}

}  // namespace
}  // namespace coastmesh::test
