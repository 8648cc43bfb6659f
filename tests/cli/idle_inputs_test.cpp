// The program warns of files for sizes, passages, barriers, constraints, weirs or regions that have nothing where the
// mesh lies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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

TEST_F(IdleInputs, OfLinesAndRegionsOutsideTheWaterAreWarnedOf) {
  const auto line = [&](const std::string& name, const std::string& places) {
    return feature(name, R"({"type":"LineString","coordinates":)" + places + "}");
  };
  const std::string wet = line("wet.geojson", "[[-87.8,47.7],[-87.6,47.7]]");
  const std::string dry = line("dry.geojson", "[[20,50],[21,50]]");
  EXPECT_EQ(warningsWith("--constraints", wet), "");
  EXPECT_THAT(warningsWith("--constraints", dry),
              HasSubstr("--constraints " + dry + ": nothing of it lies in the water; is its CRS right?"));
  EXPECT_EQ(warningsWith("--regions", inputFile("lines/regions.geojson")), "");
  const std::string region =
      feature("far.geojson", R"({"type":"Polygon","coordinates":[[[20,50],[21,50],[21,51],[20,50]]]})");
  EXPECT_THAT(warningsWith("--regions", region),
              HasSubstr("--regions " + region + ": no polygon of it holds any of the mesh; is its CRS right?"));
  // On the island of the lake.
  EXPECT_THAT(warningsWith("--constraints", line("island.geojson", "[[-87.5,47.5],[-87.51,47.51]]")),
              HasSubstr("island.geojson: nothing of it lies in the water"));
}

TEST_F(IdleInputs, PointsOutsideTheWaterAreNamed) {
  const auto gauge = [](const std::string& name, const std::string& place) {
    return R"({"type":"Feature","properties":{"name":")" + name + R"("},"geometry":{"type":"Point","coordinates":)" +
           place + "}}";
  };
  const auto gauges = [&](const std::string& name, const std::vector<std::string>& features) {
    std::string text;
    for (const std::string& one : features) text += (text.empty() ? "" : ",") + one;
    return write(name, R"({"type":"FeatureCollection","features":[)" + text + "]}");
  };
  const std::string wet = gauge("wet", "[-87.7,47.7]"), dry = gauge("on the island", "[-87.505,47.505]"),
                    far = gauge("far", "[20,50]");
  EXPECT_EQ(warningsWith("--constraints", gauges("wet.geojson", {wet})), "");
  for (const std::string& lost : {dry, far})
    EXPECT_THAT(warningsWith("--constraints", gauges("lost.geojson", {lost})),
                HasSubstr("lost.geojson: nothing of it lies in the water; is its CRS right?"));
  EXPECT_THAT(warningsWith("--constraints", gauges("some.geojson", {far, wet, dry})),
              HasSubstr("some.geojson: 2 points lie outside the water, and are no vertices: 'on the island' at "
                        "(-87.505, 47.505), 'far' at (20, 50)"));
  const ProgramRun run =
      runProgram({"mesh", inputFile("lines/lake.geojson"), "--size", "5000", "--constraints", file("some.geojson"),
                  "-o", file("lake.nc"), "--edits", file("edits.geojson"), "--overwrite"});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(readText(file("edits.geojson")), HasSubstr("[ 20.0, 50.0 ]"));
}

// The polygons are in the water and in the right CRS.
TEST_F(IdleInputs, PolygonsAmongLinesAreWarnedOfAsSuch) {
  const std::string polygon =
      R"({"type":"Polygon","coordinates":[[[-87.8,47.7],[-87.6,47.7],[-87.7,47.8],[-87.8,47.7]]]})";
  const std::string line = R"({"type":"LineString","coordinates":[[-87.8,47.65],[-87.6,47.65]]})";
  const std::string both =
      write("both.geojson", R"({"type":"FeatureCollection","features":[)"
                            R"({"type":"Feature","properties":{},"geometry":)" +
                                polygon + R"(},{"type":"Feature","properties":{},"geometry":)" + line + "}]}");
  for (const std::string option : {"--constraints", "--weirs"}) {
    for (const std::string& path : {feature("polygon.geojson", polygon), both}) {
      const std::string text = warningsWith(option, path);
      EXPECT_THAT(text, HasSubstr(option + " " + path + ": its polygons are left out"));
      EXPECT_THAT(text, Not(HasSubstr("CRS")));
    }
  }
}

TEST_F(IdleInputs, OfPassagesAndBarriersElsewhereAreWarnedOf) {
  const std::string near =
      feature("near.geojson", R"({"type":"LineString","coordinates":[[-87.8,47.7],[-87.6,47.7]]})");
  const std::string far = feature("far.geojson", R"({"type":"LineString","coordinates":[[20,50],[21,50]]})");
  for (const std::string option : {"--passages", "--barriers"}) {
    const ProgramRun run = runProgram({"mesh", inputFile("lines/lake.geojson"), "--size", "5000", "--coast", "follow",
                                       option, near, option, far, "-o", file("lake.nc"), "--overwrite"});
    EXPECT_LE(run.code, 1) << run.errors;
    EXPECT_THAT(run.errors, HasSubstr(option + " " + far + ": no line of it lies in the mesh, or near it"));
    EXPECT_THAT(run.errors, Not(HasSubstr("near.geojson: no line")));
  }
}

// A line meets at most one of several lakes.
TEST_F(IdleInputs, ALineThatMeetsNoLakeIsNotedOnce) {
  const auto collection = [](const std::vector<std::string>& features) {
    std::string text = R"({"type":"FeatureCollection","features":[)";
    for (const std::string& feature : features) text += (text.back() == '[' ? "" : ",") + feature;
    return text + "]}";
  };
  const auto featureOf = [](const std::string& name, const std::string& kind, const std::string& places) {
    return R"({"type":"Feature","properties":{"name":")" + name + R"("},"geometry":{"type":")" + kind +
           R"(","coordinates":)" + places + "}}";
  };
  std::vector<std::string> lakes;
  for (const std::string tenth : {"0", "1", "2"}) {
    const std::string west = "[10." + tenth, east = west + "5";
    lakes.push_back(
        featureOf("lake", "Polygon",
                  "[[" + west + ",50]," + east + ",50]," + east + ",50.05]," + west + ",50.05]," + west + ",50]]]"));
  }
  const std::string file_of_lakes = write("lakes.geojson", collection(lakes));
  const std::string lines =
      write("lines.geojson", collection({featureOf("wet", "LineString", "[[10.11,50.01],[10.14,50.04]]"),
                                         featureOf("dry", "LineString", "[[10.06,50.01],[10.09,50.04]]")}));
  const auto run = runProgram(
      {"mesh", file_of_lakes, "-o", file("lakes.nc"), "--size", "500", "--coast", "follow", "--passages", lines});
  EXPECT_EQ(run.code, 0);
  const std::string note = "passage 'dry' meets no water that is meshed";
  const std::string text = run.output + run.errors;
  EXPECT_NE(text.find(note), std::string::npos) << text;
  EXPECT_EQ(text.find(note), text.rfind(note));
  EXPECT_EQ(text.find("passage 'wet' meets"), std::string::npos) << text;
}

// Lines without names, and regions with the same number, count for their own file alone.
TEST_F(IdleInputs, OfSeveralFilesWithoutNamesTheIdleOnesAreWarnedOf) {
  const auto unnamed = [&](const std::string& name, const std::string& geometry) {
    return write(name, R"({"type":"Feature","id":7,"properties":{},"geometry":)" + geometry + "}");
  };
  const std::string line = R"({"type":"LineString","coordinates":)", region = R"({"type":"Polygon","coordinates":)";
  const std::string wet_line = unnamed("wet_line.geojson", line + "[[-87.8,47.7],[-87.6,47.7]]}");
  const std::string dry_line = unnamed("dry_line.geojson", line + "[[20,50],[21,50]]}");
  const std::string wet_region =
      unnamed("wet_region.geojson", region + "[[[-87.8,47.6],[-87.6,47.6],[-87.6,47.8],[-87.8,47.6]]]}");
  const std::string dry_region = unnamed("dry_region.geojson", region + "[[[20,50],[21,50],[21,51],[20,50]]]}");
  for (const auto& [option, wet, dry] :
       {std::tuple("--constraints", wet_line, dry_line), std::tuple("--weirs", wet_line, dry_line),
        std::tuple("--regions", wet_region, dry_region)}) {
    const ProgramRun run = runProgram({"mesh", inputFile("lines/lake.geojson"), "--size", "5000", option, wet, option,
                                       dry, "-o", file("lake.nc"), "--overwrite"});
    EXPECT_EQ(run.code, 0) << run.errors;
    EXPECT_THAT(run.errors, HasSubstr(std::string(option) + " " + dry + ": no"));
    EXPECT_THAT(run.errors, Not(HasSubstr(wet + ": no")));
  }
}

// Both have the line, so that neither is idle.
TEST_F(IdleInputs, TheSameLinesInTwoFilesAreNotWarnedOf) {
  const std::string line = R"({"type":"Feature","properties":{},"geometry":)"
                           R"({"type":"LineString","coordinates":[[-87.8,47.7],[-87.6,47.7]]}})";
  const ProgramRun run =
      runProgram({"mesh", inputFile("lines/lake.geojson"), "--size", "5000", "--constraints", write("a.geojson", line),
                  "--constraints", write("b.geojson", line), "-o", file("lake.nc")});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_EQ(run.errors, "");
}

TEST_F(IdleInputs, BeyondTheBoxAreWarnedOf) {
  const std::string points = feature("p.geojson", R"({"type":"Point","coordinates":[20,50]})");
  const std::string lines = feature("l.geojson", R"({"type":"LineString","coordinates":[[20,50],[21,50]]})");
  const ProgramRun run = runProgram({"mesh", inputFile("lines/lake.geojson"), "--bbox=-87.9,47.2,-87.6,47.8", "--size",
                                     "5000", "--constraints", points, "--constraints", lines, "-o", file("lake.nc")});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("p.geojson: nothing of it lies in the water"));
  EXPECT_THAT(run.errors, HasSubstr("l.geojson: nothing of it lies in the water"));
}

TEST_F(IdleInputs, OfSeveralFilesTheIdleOnesAreNamed) {
  const auto named = [&](const std::string& name, const std::string& places) {
    return write(name + ".geojson", R"({"type":"Feature","properties":{"name":")" + name +
                                        R"("},"geometry":{"type":"LineString","coordinates":)" + places + "}}");
  };
  const ProgramRun run = runProgram({"mesh", inputFile("lines/lake.geojson"), "--size", "5000", "--weirs",
                                     named("wet", "[[-87.8,47.7],[-87.6,47.7]]"), "--weirs",
                                     named("dry", "[[20,50],[21,50]]"), "-o", file("lake.nc")});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("dry.geojson: no line of it lies in the water"));
  EXPECT_THAT(run.errors, ::testing::Not(HasSubstr("wet.geojson")));
}

TEST_F(IdleInputs, WeirsOnLandAreNamedInTheSummary) {
  const auto line = [](const std::string& name, const std::string& places) {
    return R"({"type":"Feature","properties":{"name":")" + name +
           R"("},"geometry":{"type":"LineString","coordinates":)" + places + "}}";
  };
  const std::string wet = line("wet", "[[-87.8,47.7],[-87.6,47.7]]");
  const std::string island = line("island", "[[-87.5,47.5],[-87.51,47.51],[-87.52,47.51]]");
  const auto summaryOf = [&](const std::string& name, const std::string& features) {
    const std::string path = write(name, R"({"type":"FeatureCollection","features":[)" + features + "]}");
    const ProgramRun run = runProgram({"mesh", inputFile("lines/lake.geojson"), "--size", "5000", "--weirs", path, "-o",
                                       file("lake.nc"), "--overwrite"});
    EXPECT_EQ(run.code, 0) << run.errors;
    return run.output;
  };
  EXPECT_THAT(summaryOf("both.geojson", wet + "," + island),
              HasSubstr("both.geojson: 1 of 2 weirs lies outside of the mesh: 'island' at (-87.51, 47.51)"));
  EXPECT_THAT(summaryOf("wet.geojson", wet), Not(HasSubstr("outside of the mesh")));
}

// What Triangle's files can say besides points, segments and holes is not meshed.
TEST_F(IdleInputs, OfAPlaneGraphAreNamedOnce) {
  const auto warnings = [&](const std::string& attribute, const std::string& marker, const std::string& regions) {
    const std::string end = attribute + "\n";
    const std::string path = write("a.poly", "4 2 " + std::string(attribute.empty() ? "0" : "1") + " 0\n1 0 0" + end +
                                                 "2 90 0" + end + "3 90 90" + end + "4 0 90" + end + "4 1\n1 1 2 " +
                                                 marker + "\n2 2 3 1\n3 3 4 0\n4 4 1 1\n0\n" + regions);
    const ProgramRun run = runProgram({"mesh", path, "-o", file("a.nc"), "--report", file("a.json"), "--overwrite"});
    EXPECT_EQ(run.code, 0) << run.errors;
    if (!run.errors.empty()) {
      EXPECT_THAT(readText(file("a.json")), HasSubstr("a.poly': ignored: "));
    }
    return run.errors;
  };
  EXPECT_EQ(warnings("", "1", ""), "");
  EXPECT_EQ(warnings("", "1", "0\n"), "");
  EXPECT_THAT(warnings("", "1", "1\n1 10 10 4 50\n"), HasSubstr("a.poly': ignored: 1 region with its attribute"));
  EXPECT_THAT(warnings(" 7", "1", ""), HasSubstr("a.poly': ignored: attributes of points\n"));
  EXPECT_THAT(warnings(" 7", "3", ""), HasSubstr("ignored: attributes of points, markers of segments"));
}

}  // namespace
}  // namespace coastmesh::test
