// Files that were given for sizes or weirs and have nothing where the mesh lies are warned of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

using ::testing::HasSubstr;

class IdleInputs : public ProgramTest {
 protected:
  std::string warningsWith(const std::string& option, const std::string& path) const {
    const ProgramRun run = runProgram({"mesh", inputFile("lines/lake.geojson"), "--size", "5000", option, path, "-o",
                                       file("lake.nc"), "--overwrite"});
    EXPECT_EQ(run.code, 0) << run.errors;
    return run.errors;
  }
  std::string feature(const std::string& name, const std::string& geometry) const {
    return write(name, R"({"type":"Feature","properties":{"size":2000},"geometry":)" + geometry + "}");
  }
  std::string raster(const std::string& name, double west, double south) const {
    std::string text = "ncols 20\nnrows 20\nxllcorner " + std::to_string(west) + "\nyllcorner " +
                       std::to_string(south) + "\ncellsize 0.1\n";
    for (int row = 0; row < 20; ++row) {
      for (int column = 0; column < 20; ++column) text += "4000 ";
      text += "\n";
    }
    return write(name, text);
  }
};

TEST_F(IdleInputs, AreWarnedOfByName) {
  // The lake lies round 87.5 W, 47.5 N.
  EXPECT_EQ(warningsWith("--size-raster", raster("near.asc", -88.5, 46.5)), "");
  EXPECT_THAT(warningsWith("--size-raster", raster("far.asc", 46.5, -8.5)),
              HasSubstr("far.asc: no node of the mesh lies in it"));
  EXPECT_EQ(warningsWith("--size-features", feature("near.geojson", R"({"type":"Point","coordinates":[-87.5,47.8]})")),
            "");
  EXPECT_EQ(warningsWith("--size-features", feature("turn.geojson", R"({"type":"Point","coordinates":[272.5,47.8]})")),
            "");
  EXPECT_THAT(warningsWith("--size-features", feature("far.geojson", R"({"type":"Point","coordinates":[47.5,-87.5]})")),
              HasSubstr("far.geojson: none of them lies in the mesh"));
  EXPECT_EQ(warningsWith("--weirs", inputFile("lines/weirs.geojson")), "");
  EXPECT_THAT(
      warningsWith("--weirs", feature("dry.geojson", R"({"type":"LineString","coordinates":[[20,50],[21,50]]})")),
      HasSubstr("dry.geojson: no line of it lies in the water"));
}

}  // namespace
}  // namespace coastmesh::test
