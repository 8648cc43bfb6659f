#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

class CoastFollow : public ProgramTest {
 protected:
  // Meshes the sea of a box of a degree, with land given, and returns the report.
  nlohmann::json sea(const std::vector<std::vector<LonLatRing>>& land, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"mesh",        write("land.geojson", geoJsonPolygons(land)),
                                       "-o",          file("sea.2dm"),
                                       "--overwrite", "--domain",
                                       "outside",     "--bbox=0,0,1,1",
                                       "--coast",     "follow",
                                       "--report",    file("report.json")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    run_ = runProgram(arguments);
    EXPECT_EQ(run_.code, 0) << run_.errors;
    return nlohmann::json::parse(readText(file("report.json")));
  }

  ProgramRun run_;
};

const LonLatRing kCoast{{-0.1, -0.1}, {1.1, -0.1}, {1.1, 0.05}, {-0.1, 0.05}};

TEST_F(CoastFollow, WhatIsDroppedLeavesNoFineElementsBehind) {
  const LonLatRing islet{{0.5, 0.6}, {0.502, 0.6}, {0.502, 0.602}, {0.5, 0.602}};
  const std::vector<std::string> sizes{"--size-shore", "1000", "--shore-rate", "0.2",
                                       "--grade",      "0.2",  "--size-max",   "20000"};
  const auto vertices = [](const nlohmann::json& report) { return report["mesh"]["vertices"].get<int>(); };
  const int without = vertices(sea({{kCoast}}, sizes));
  const nlohmann::json with = sea({{kCoast}, {islet}}, sizes);
  EXPECT_EQ(with["clean"]["small_island"], 1);
  EXPECT_NEAR(vertices(with), without, 0.03 * without);
}

}  // namespace
}  // namespace coastmesh::test
