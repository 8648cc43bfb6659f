#include <gtest/gtest.h>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

class ExitCodes : public ProgramTest {
 protected:
  // Expects that the program refuses the input and leaves the folder as it was.
  void expectRefused(const std::string& input, int code) {
    const std::set<std::string> before = names();
    const ProgramRun run = runProgram({"mesh", input, "-o", file("out.2dm")});
    EXPECT_EQ(run.code, code) << run.errors;
    EXPECT_TRUE(isOneErrorLine(run.errors));
    EXPECT_EQ(run.output, "");
    EXPECT_EQ(names(), before);
  }
};

TEST_F(ExitCodes, InputThatDoesNotExist) { expectRefused(file("nowhere.gpkg"), 3); }

TEST_F(ExitCodes, PolyThatDoesNotExist) { expectRefused(file("nowhere.poly"), 3); }

TEST_F(ExitCodes, EmptyInput) { expectRefused(write("empty.geojson", ""), 3); }

TEST_F(ExitCodes, NoVectorFile) { expectRefused(write("letter.gpkg", "Dear reader,\nall is well.\n"), 3); }

TEST_F(ExitCodes, OnlyPoints) {
  expectRefused(write("points.geojson", R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},
      "geometry":{"type":"Point","coordinates":[1,2]}}]})"),
                3);
}

TEST_F(ExitCodes, NoFeature) {
  expectRefused(write("none.geojson", R"({"type":"FeatureCollection","features":[]})"), 3);
}

TEST_F(ExitCodes, OnlyNotANumber) {
  expectRefused(write("nan.csv", "WKT,name\n\"POLYGON ((nan nan, nan nan, nan nan, nan nan))\",a\n"), 3);
}

TEST_F(ExitCodes, PolygonWithoutArea) {
  expectRefused(write("flat.geojson", geoJsonPolygons({{{{0, 0}, {1, 0}, {2, 0}}}})), 3);
}

TEST_F(ExitCodes, FolderThatDoesNotExist) {
  const ProgramRun run = runProgram({"mesh", lake(), "-o", file("nowhere/out.2dm")});
  EXPECT_EQ(run.code, 4);
  EXPECT_TRUE(isOneErrorLine(run.errors));
}

TEST_F(ExitCodes, EndingThatNoFormatHas) {
  const ProgramRun run = runProgram({"mesh", lake(), "-o", file("out.xyzzy")});
  EXPECT_EQ(run.code, 4);
  EXPECT_TRUE(isOneErrorLine(run.errors));
}

TEST_F(ExitCodes, ExistingOutputIsKept) {
  const std::string out = write("out.2dm", "precious");
  const std::string input = lake();
  const ProgramRun refused = runProgram({"mesh", input, "-o", out});
  EXPECT_EQ(refused.code, 4);
  EXPECT_TRUE(isOneErrorLine(refused.errors));
  EXPECT_NE(refused.errors.find("--overwrite"), std::string::npos);
  EXPECT_EQ(readText(out), "precious");

  EXPECT_EQ(runProgram({"mesh", input, "-o", out, "--overwrite"}).code, 0);
  EXPECT_TRUE(readText(out).starts_with("MESH2D"));
}

TEST_F(ExitCodes, ExistingOutputIsKeptWhenTheInputIsRefused) {
  const std::string out = write("out.2dm", "precious");
  EXPECT_EQ(runProgram({"mesh", write("empty.geojson", ""), "-o", out, "--overwrite"}).code, 3);
  EXPECT_EQ(readText(out), "precious");
}

TEST_F(ExitCodes, WrongUsage) {
  const std::string input = lake();
  const std::string out = file("out.2dm");
  const std::vector<std::vector<std::string>> wrong{
      {},
      {"knit"},
      {"mesh"},
      {"mesh", input},
      {"mesh", "-o", out},
      {"mesh", input, "-o", out, "--no-such-option"},
      {"mesh", input, "-o", out, "--min-angle", "46"},
      {"mesh", input, "-o", out, "--min-angle", "-1"},
      {"mesh", input, "-o", out, "--min-angle", "nan"},
      {"mesh", input, "-o", out, "--min-angle", "many"},
      {"mesh", input, "-o", out, "--max-angle", "59"},
      {"mesh", input, "-o", out, "--size-max", "0"},
      {"mesh", input, "-o", out, "--max-vertices", "-5"},
      {"mesh", input, "-o", out, "--algorithm", "guess"},
      {"mesh", input, "-o", out, "--progress", "loud"},
      {"mesh", input, "-o", out, "-o", out},
      {"mesh", input, "-o", input, "--overwrite"},
      {"mesh", input, "-o", out, "-o", file("out.msh"), "--format", "2dm"},
      {"mesh", input, "-o", out, "--crs", "rubbish"},
      {"mesh", input, file("graph.poly"), "-o", out},
      {"mesh", file("graph.poly"), "-o", out, "--crs", "EPSG:3067"},
      {"plot", input, "-o", file("map.png"), "--bbox", "1,2,3"},
      {"mesh", input, "-o", out, "--bbox", "0,1,1,0"},
      {"mesh", input, "-o", out, "--bbox", "0,0,1,0"},
      {"clean", input, "-o", out, "--bbox", "1,0,1,1"},
  };
  for (const std::vector<std::string>& arguments : wrong) {
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 2) << testing::PrintToString(arguments) << run.errors;
    EXPECT_TRUE(isOneErrorLine(run.errors));
  }
  EXPECT_EQ(names(), std::set<std::string>{"lake.geojson"});
}

TEST_F(ExitCodes, SwitchesWithAValueThatIsNoTruthValue) {
  const std::string input = lake();
  const std::string out = file("out.2dm");
  const std::vector<std::vector<std::string>> wrong{{"mesh", input, "-o", out, "--coarsen=maybe"},
                                                    {"mesh", input, "-o", out, "--coarsen=3.5"},
                                                    {"mesh", input, "-o", out, "--overwrite=2"},
                                                    {"check", input, "--delaunay=foo"},
                                                    {"info", input, "--json=foo"}};
  for (const std::vector<std::string>& arguments : wrong) {
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 2) << testing::PrintToString(arguments) << run.errors;
    EXPECT_NE(run.errors.find(arguments.back() + " is a switch: say true or false"), std::string::npos) << run.errors;
  }
  EXPECT_EQ(names(), std::set<std::string>{"lake.geojson"});
}

// For example from an unset shell variable.
TEST_F(ExitCodes, EmptyValues) {
  const std::string input = lake();
  for (const std::string option : {"--checkpoint", "--clip", "--report", "--edits", "--shard", "--bbox", "--where",
                                   "--format", "--size", "--config", "-o"}) {
    const ProgramRun run = runProgram({"mesh", input, "-o", file("out.2dm"), option, ""});
    EXPECT_EQ(run.code, 2) << option << run.errors;
    EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
    EXPECT_NE(run.errors.find("is an empty text; leave it out"), std::string::npos) << run.errors;
  }
  const ProgramRun joined = runProgram({"mesh", input, "-o", file("out.2dm"), "--checkpoint=", "--quiet"});
  EXPECT_EQ(joined.code, 2) << joined.errors;
  EXPECT_EQ(names(), std::set<std::string>{"lake.geojson"});
}

TEST_F(ExitCodes, AnArgumentMayBeCalledAsACommandIs) {
  const std::string there = "cd '" + file("") + "' && ";
  write("check", readText(lake()));
  const ProgramRun alone = runShell(there + "\"$0\" mesh check -o out.nc --report - && \"$0\" info check");
  EXPECT_EQ(alone.code, 0) << alone.errors;
  EXPECT_NE(alone.output.find("\"check\""), std::string::npos) << alone.output;
  const ProgramRun last = runShell(there + "\"$0\" mesh -o no.nc lake.geojson nowhere check");
  EXPECT_EQ(last.code, 3) << last.errors;
  EXPECT_NE(last.errors.find("nowhere"), std::string::npos) << last.errors;
  const ProgramRun two = runShell(there + "\"$0\" mesh lake.geojson -o z.nc check z.nc --min-angle 30");
  EXPECT_EQ(two.code, 2) << two.errors;
  const ProgramRun many = runShell(there + "\"$0\" info lake.geojson check");
  EXPECT_EQ(many.code, 2) << many.errors;
}

// The file is not opened, so its content does not matter.
TEST_F(ExitCodes, ABoxUpsideDownIsWrongUsageThatNamesTheSides) {
  const ProgramRun run = runProgram({"mesh", file("none.geojson"), "-o", file("out.2dm"), "--bbox", "-87,42.5,-86,41"});
  EXPECT_EQ(run.code, 2) << run.errors;
  EXPECT_NE(run.errors.find("'-87,42.5,-86,41' is not W,S,E,N with S below N"), std::string::npos) << run.errors;
}

// An option that an error asks for makes no warning that another has no effect.
TEST_F(ExitCodes, WaterWithoutALimitIsAnErrorAlone) {
  const ProgramRun run = runProgram({"mesh", lake(), "-o", file("out.2dm"), "--domain", "outside"});
  EXPECT_EQ(run.code, 2) << run.errors;
  EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
}

TEST_F(ExitCodes, DepthsThatAreMissingAreWrongUsage) {
  const ProgramRun run = runProgram({"mesh", lake(), "-o", file("out.2dm"), "--open-deeper", "200"});
  EXPECT_EQ(run.code, 2) << run.errors;
  EXPECT_NE(run.errors.find("--open-deeper needs depths"), std::string::npos) << run.errors;
}

TEST_F(ExitCodes, OptionsGivenMoreThanOnce) {
  const ProgramRun run = runProgram({"mesh", lake(), "-o", file("out.2dm"), "--size", "9", "--size", "8"});
  EXPECT_EQ(run.code, 2);
  EXPECT_TRUE(isOneErrorLine(run.errors));
  EXPECT_NE(run.errors.find("--size is given more than once"), std::string::npos) << run.errors;
}

TEST_F(ExitCodes, VertexBudgetGivesAMeshAndExitOne) {
  const ProgramRun run =
      runProgram({"mesh", lake(), "-o", file("out.2dm"), "--size-max", "20", "--max-vertices", "200"});
  EXPECT_EQ(run.code, 1) << run.errors;
  EXPECT_NE(run.output.find("a requirement (at least 33 degrees, --size-max 20), the first at (-8"), std::string::npos)
      << run.output;
  EXPECT_EQ(runProgram({"check", file("out.2dm"), "--assume-crs", "EPSG:4326"}).code, 0);
}

TEST_F(ExitCodes, WhatCannotBeMeshedIsLeftOutAndTheRestMeshed) {
  const std::string input =
      write("parts.geojson", geoJsonPolygons({{{{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}}}, {{{5, 5}, {6, 5}, {7, 5}}}}));
  const ProgramRun run = runProgram({"mesh", input, "-o", file("out.2dm")});
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.errors.find("feature 1"), std::string::npos) << run.errors;
  EXPECT_TRUE(readText(file("out.2dm")).starts_with("MESH2D"));
}

}  // namespace

}  // namespace coastmesh::test
