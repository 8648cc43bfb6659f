// Lines of weirs with a height in files for ADCIRC.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A lake that is 9 m deep, and a weir in it.
class Weirs : public ProgramTest {
 protected:
  Weirs() {
    write("bed.asc", "ncols 2\nnrows 2\nxllcorner -90\nyllcorner 45\ncellsize 2\n-9 -9\n-9 -9\n");
    write("weir.geojson", weirWith(R"("height": 2.5, "coef_sub": 0.9)"));
  }

  static std::string weirWith(const std::string& attributes) {
    return R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"name": "w1", )" +
           attributes +
           R"(}, "geometry": {"type": "LineString", "coordinates": )"
           "[[-87.9, 47.55], [-87.8, 47.6], [-87.65, 47.6]]}}]}";
  }

  ProgramRun meshed(const std::vector<std::string>& more, const std::string& weirs = "weir.geojson") const {
    std::vector<std::string> arguments{"mesh",         inputFile("lines/lake.geojson"),
                                       "--weirs",      file(weirs),
                                       "--size-max",   "4000",
                                       "--bathymetry", file("bed.asc"),
                                       "--overwrite"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram(arguments);
  }

  // Rows that end so: pairs of nodes with their height and coefficients.
  std::size_t rowsEndingIn(const std::string& path, const std::string& end) const {
    std::istringstream text(readText(path));
    std::size_t count = 0;
    for (std::string line; std::getline(text, line);) count += line.ends_with(end) ? 1 : 0;
    return count;
  }
};

TEST_F(Weirs, WithAHeightHavePairsOfNodesForAdcirc) {
  const ProgramRun run = meshed({"--target", "adcirc", "-o", file("fort.14"), "-o", file("lake.nc")});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("1 weir for ADCIRC with "));
  EXPECT_THAT(run.errors, Not(HasSubstr("no line of it lies in the water")));
  EXPECT_THAT(run.errors, Not(HasSubstr("fort.14' cannot hold")));
  EXPECT_THAT(run.errors, HasSubstr("lake.nc' cannot hold heights and nodes across of 1 weir between shores, which a "
                                    ".14 holds"));
  const std::size_t pairs = rowsEndingIn(file("fort.14"), " 2.5 0.9 1");
  EXPECT_GE(pairs, 3u);
  EXPECT_THAT(readText(file("fort.14")), HasSubstr("\n" + std::to_string(pairs) + " 24 = "));
  EXPECT_EQ(runProgram({"check", file("fort.14"), "--target", "adcirc"}).code, 0);
  // Edits keep them.
  const ProgramRun converted = runProgram({"convert", file("fort.14"), "--target", "adcirc", "-o", file("again.14")});
  EXPECT_EQ(converted.code, 0) << converted.errors;
  EXPECT_EQ(rowsEndingIn(file("again.14"), " 2.5 0.9 1"), pairs);
  const ProgramRun remeshed = runProgram({"remesh", file("fort.14"), "--bbox=-87.9,47.5,-87.6,47.7", "--size", "2000",
                                          "--target", "adcirc", "-o", file("fine.14")});
  EXPECT_EQ(remeshed.code, 0) << remeshed.errors;
  EXPECT_EQ(rowsEndingIn(file("fine.14"), " 2.5 0.9 1"), pairs);
  EXPECT_EQ(runProgram({"check", file("fine.14"), "--target", "adcirc"}).code, 0);
}

TEST_F(Weirs, HaveHeightsAboveTheStillWater) {
  EXPECT_EQ(meshed({"--target", "adcirc", "--water-level", "0.5", "-o", file("fort.14")}).code, 0);
  EXPECT_GE(rowsEndingIn(file("fort.14"), " 2 0.9 1"), 3u);
}

TEST_F(Weirs, StayEdgesForOthers) {
  EXPECT_EQ(meshed({"-o", file("plain.14")}).code, 0);
  EXPECT_THAT(readText(file("plain.14")), Not(HasSubstr(" 24 = ")));
  const ProgramRun both = meshed({"--target", "adcirc", "--target", "schism", "-o", file("both.14")});
  EXPECT_EQ(both.code, 0) << both.errors;
  EXPECT_THAT(both.errors, HasSubstr("weirs stay edges of the mesh: it is for other models besides ADCIRC"));
  EXPECT_THAT(readText(file("both.14")), Not(HasSubstr(" 24 = ")));
}

TEST_F(Weirs, WithoutAHeightStayEdgesWithAWarning) {
  write("bare.geojson", weirWith(R"("id": 1)"));
  const ProgramRun run = meshed({"--target", "adcirc", "-o", file("fort.14")}, "bare.geojson");
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("weir 'w1' from "));
  EXPECT_THAT(run.errors, HasSubstr("it has no attribute 'height', in metres, for ADCIRC"));
  EXPECT_THAT(readText(file("fort.14")), Not(HasSubstr(" 24 = ")));
}

TEST_F(Weirs, HeightsThatAreNoNumbersAreErrors) {
  write("bad.geojson", weirWith(R"("height": "high")"));
  const ProgramRun run = meshed({"--target", "adcirc", "-o", file("fort.14")}, "bad.geojson");
  EXPECT_NE(run.code, 0);
  EXPECT_THAT(run.errors, HasSubstr("bad.geojson', feature 0: its attribute 'height' is high, not a number"));
  // Heights are for ADCIRC alone.
  EXPECT_EQ(meshed({"-o", file("plain.nc")}, "bad.geojson").code, 0);
}

}  // namespace

}  // namespace coastmesh::test
