// Lines of weirs with a height, or a raster of heights, in files for ADCIRC.
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

  // A pair of nodes of the only weir.
  struct Pair {
    double lon = 0.0, height = 0.0, coefficient = 0.0;
  };
  static std::vector<Pair> pairsIn(const std::string& path) {
    std::istringstream text(readText(path));
    std::string line;
    std::size_t triangles = 0, nodes = 0;
    std::getline(text, line);
    text >> triangles >> nodes;
    std::vector<double> lon(nodes + 1);
    for (std::size_t i = 0; i < nodes; ++i) {
      std::size_t number = 0;
      double lat = 0.0, depth = 0.0;
      text >> number;
      text >> lon.at(number) >> lat >> depth;
    }
    std::vector<Pair> pairs;
    while (std::getline(text, line) && line.find(" 24 = ") == std::string::npos) continue;
    while (std::getline(text, line)) {
      std::istringstream row(line);
      std::size_t front = 0, back = 0;
      Pair pair;
      if (row >> front >> back >> pair.height >> pair.coefficient) pairs.push_back(pair);
      if (row) pairs.back().lon = 0.5 * (lon.at(front) + lon.at(back));
    }
    return pairs;
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

TEST_F(Weirs, OfAPartThatIsPutBackGoOn) {
  ASSERT_EQ(meshed({"--target", "adcirc", "-o", file("fort.14")}).code, 0);
  const std::size_t pairs = rowsEndingIn(file("fort.14"), " 2.5 0.9 1");
  ASSERT_EQ(runProgram({"cut", file("fort.14"), "--bbox=-88,47,-87.75,48", "-o", file("west.14")}).code, 0);
  const std::size_t west = rowsEndingIn(file("west.14"), " 2.5 0.9 1");
  ASSERT_GE(west, 2u);
  ASSERT_LT(west, pairs);
  const ProgramRun run = runProgram({"merge", file("fort.14"), file("west.14"), "-o", file("again.14")});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.errors, Not(HasSubstr("gap in a weir")));
  // The pair of nodes at the cut ends one part of the weir, and begins the other.
  EXPECT_EQ(rowsEndingIn(file("again.14"), " 2.5 0.9 1"), pairs + 1);
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

// The terrain rises to the east by 10 m for each degree: the crest of a pair is that half-way to the one west of it, to
// the two pixels beside.
TEST_F(Weirs, WithoutAHeightHaveThatOfARaster) {
  write("bare.geojson", weirWith(R"("coef_sub": 0.9)"));
  constexpr double kWest = -88.0, kPixel = 0.002, kRise = 10.0;
  std::string rows;
  for (int row = 0; row < 100; ++row) {
    for (int column = 0; column < 200; ++column) rows += std::to_string(kRise * (column + 0.5) * kPixel) + " ";
    rows += "\n";
  }
  write("crest.asc", "ncols 200\nnrows 100\nxllcorner -88\nyllcorner 47.5\ncellsize 0.002\n" + rows);
  const auto made = [&](const std::string& level) {
    const ProgramRun run = meshed(
        {"--weir-heights", file("crest.asc"), "--target", "adcirc", "--water-level", level, "-o", file("fort.14")},
        "bare.geojson");
    EXPECT_EQ(run.code, 0) << run.errors;
    EXPECT_THAT(run.output, HasSubstr("crests of weirs from rasters: "));
    EXPECT_THAT(run.output, HasSubstr("the highest terrain within 30 m of their lines"));
    return pairsIn(file("fort.14"));
  };
  const std::vector<Pair> pairs = made("0"), lower = made("0.25");
  ASSERT_GE(pairs.size(), 4u);
  ASSERT_EQ(lower.size(), pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(pairs[i].coefficient, 0.9);
    EXPECT_NEAR(lower[i].height, pairs[i].height - 0.25, 1e-9);
    if (i == 0) continue;
    const double half_way = 0.5 * (pairs[i - 1].lon + pairs[i].lon);
    EXPECT_NEAR(pairs[i].height, kRise * (half_way - kWest), 2.0 * kRise * kPixel) << i;
    EXPECT_GT(pairs[i].lon, pairs[i - 1].lon);
  }
}

TEST_F(Weirs, HeightsOfTheirOwnComeBeforeRasters) {
  const ProgramRun run = meshed({"--weir-heights", file("bed.asc"), "--target", "adcirc", "-o", file("fort.14")});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("--weir-heights has no effect: every weir in the mesh has a height of its own"));
  EXPECT_GE(rowsEndingIn(file("fort.14"), " 2.5 0.9 1"), 3u);
}

TEST_F(Weirs, RastersOfHeightsThatCannotServe) {
  write("bare.geojson", weirWith(R"("id": 1)"));
  const auto with = [&](std::vector<std::string> more) {
    for (const char* const each : {"--target", "adcirc", "-o"}) more.emplace_back(each);
    more.push_back(file("fort.14"));
    return meshed(more, "bare.geojson");
  };
  EXPECT_THAT(with({"--weir-heights", file("none.tif")}).errors, HasSubstr("none.tif"));
  const ProgramRun depths = with({"--weir-heights", file("bed.asc"), "--depth-sign", "down"});
  EXPECT_EQ(depths.code, 2);
  EXPECT_THAT(depths.errors, HasSubstr("holds depths, as --depth-sign down says of it"));
  EXPECT_THAT(meshed({"--weir-heights", file("bed.asc"), "-o", file("plain.14")}, "bare.geojson").errors,
              HasSubstr("--weir-heights has no effect without --target adcirc alone"));
  // A raster elsewhere leaves edges, which are named.
  write("far.asc", "ncols 2\nnrows 2\nxllcorner 10\nyllcorner 45\ncellsize 2\n9 9\n9 9\n");
  const ProgramRun far = with({"--weir-heights", file("far.asc")});
  EXPECT_EQ(far.code, 0);
  EXPECT_THAT(far.errors, HasSubstr("weir 'w1' ('" + file("bare.geojson") + "', feature 1) from -87."));
  EXPECT_THAT(far.errors, HasSubstr("no raster of --weir-heights has a value within 30 m of it there"));
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
