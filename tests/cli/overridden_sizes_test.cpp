// The program reports sizes that other options override, or that have no effect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class OverriddenSizes : public ProgramTest {
 protected:
  ProgramRun mesh(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments{"mesh", lake(), "-o", file("a.2dm"), "--overwrite"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    ProgramRun run = runProgram(arguments);
    EXPECT_LE(run.code, 1) << run.errors;
    return run;
  }
  // A raster of constant depth around the lake.
  std::string depths(double depth_m) const {
    std::ostringstream text;
    text << "ncols 20\nnrows 20\nxllcorner -87.51\nyllcorner 41.595\ncellsize 0.0025\n";
    for (int row = 0; row < 20; ++row)
      for (int column = 0; column < 20; ++column) text << -depth_m << (column < 19 ? ' ' : '\n');
    return write("depths.asc", text.str());
  }
};

TEST_F(OverriddenSizes, ContradictionsOfOptionsAreNoted) {
  EXPECT_THAT(mesh({"--size-shore", "300", "--size-max", "200"}).output,
              HasSubstr("--size-shore 300 is more than --size-max 200, which overrides it"));
  EXPECT_THAT(mesh({"--size-shore", "300", "--size-min", "400"}).output,
              HasSubstr("--size-shore 300 is less than --size-min 400, which overrides it"));
  EXPECT_THAT(mesh({"--size", "300", "--size-min", "400"}).output,
              HasSubstr("--size 300 is less than --size-min 400, which overrides it"));
  EXPECT_THAT(mesh({"--size", "300", "--size-shore", "400"}).output,
              HasSubstr("--size-shore 400 is more than --size 300, which overrides it"));
  EXPECT_THAT(mesh({"--size-shore", "300", "--shore-rate", "0.3", "--grade", "0.05"}).output,
              HasSubstr("--shore-rate 0.3 is more than --grade 0.05, which overrides it"));
  EXPECT_THAT(
      mesh({"--size", "400", "--bathymetry", depths(50), "--depth-band", "0,100,300", "--size-min", "350"}).output,
      HasSubstr("--depth-band 0,100,300 is less than --size-min 350, which overrides it"));
  EXPECT_THAT(mesh({"--size-shore", "300", "--grade", "0.05", "--size-min", "300", "--size-max", "300"}).output,
              Not(HasSubstr("overrides")));
}

// Waves travel at 31 m/s: edges must be at least 5/3 of their way in a time step.
TEST_F(OverriddenSizes, ATimeStepThatTheShoreIsTooFineForIsNoted) {
  const auto output = [&](const std::string& step) {
    return mesh({"--bathymetry", depths(100), "--size-shore", "200", "--time-step", step}).output;
  };
  EXPECT_THAT(output("8"),
              HasSubstr("--time-step asks for more than --size-shore along 100 % of the shore, up to 418 m"));
  EXPECT_THAT(output("3"), Not(HasSubstr("--time-step asks for more")));
}

TEST_F(OverriddenSizes, BandsThatNoDepthIsInAreWarnedOf) {
  const auto errors = [&](const std::string& band, const std::vector<std::string>& more) {
    std::vector<std::string> options{"--bathymetry", depths(50), "--size", "400", "--depth-band", band};
    options.insert(options.end(), more.begin(), more.end());
    return mesh(options).errors;
  };
  const std::string said = "no depth of the mesh lies in --depth-band ";
  EXPECT_THAT(errors("5000,6000,100", {}),
              HasSubstr(said + "5000,6000,100: at most it has an effect beside pixels outside the water"));
  EXPECT_THAT(errors("40,60,200", {}), Not(HasSubstr(said)));
  // --min-depth lowers nodes to 80 m, but bands apply to depths of the raster.
  EXPECT_THAT(errors("40,60,200", {"--min-depth", "80"}), Not(HasSubstr(said)));
  EXPECT_THAT(errors("90,95,200", {"--min-depth", "80"}), HasSubstr(said));
}

}  // namespace
}  // namespace coastmesh::test
