#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;
using Names = std::set<std::string>;

// Squares of a kilometre or more; the first and the second share a side.
class PerFeature : public ProgramTest {
 protected:
  static Json square(double west, double south, double side, const Json& properties) {
    const Json ring = {
        {west, south}, {west + side, south}, {west + side, south + side}, {west, south + side}, {west, south}};
    return {
        {"type", "Feature"}, {"properties", properties}, {"geometry", {{"type", "Polygon"}, {"coordinates", {ring}}}}};
  }
  std::string writeFeatures(const Json& features, const std::string& name = "lakes.geojson") const {
    return write(name, Json{{"type", "FeatureCollection"}, {"features", features}}.dump());
  }
  std::string lakes() const {
    return writeFeatures({square(5, 50, 0.01, {{"name", "West/Lake"}}), square(5.01, 50, 0.01, {{"name", "Müggelsee"}}),
                          square(6, 50, 0.03, {{"name", nullptr}}), square(7, 50, 0.02, {{"name", " .hidden "}})});
  }
  // The third feature is a sliver without area.
  std::string lakesWithOneThatCannotBe() const {
    Json bad = square(6, 50, 0.03, {{"name", "flat"}});
    bad["geometry"]["coordinates"] = {{{6, 50}, {6.1, 50}, {6, 50}, {6, 50}}};
    return writeFeatures({square(5, 50, 0.01, {{"name", "a"}}), square(5.5, 50, 0.01, {{"name", "b"}}), bad,
                          square(7, 50, 0.02, {{"name", "c"}})});
  }
  // A line along the middle of such a square.
  static Json lineIn(double west, double south, double side, const Json& properties = Json::object()) {
    const double middle = south + 0.5 * side;
    return {{"type", "Feature"},
            {"properties", properties},
            {"geometry",
             {{"type", "LineString"}, {"coordinates", {{west + 0.2 * side, middle}, {west + 0.8 * side, middle}}}}}};
  }
  Json infoOf(const std::string& name) const {
    return Json::parse(runProgram({"info", file(name), "--json", "--assume-crs", "EPSG:4326"}).output);
  }
  ProgramRun mesh(const std::string& input, std::vector<std::string> options) const {
    options.insert(options.begin(), {"mesh", input, "--per-feature"});
    return runProgram(options);
  }
  Names made(const std::string& ending) const {
    Names found;
    for (const std::string& name : names())
      if (name.ends_with(ending)) found.insert(name);
    return found;
  }
  void expectRefused(const ProgramRun& run, int code, const std::string& why) const {
    EXPECT_EQ(run.code, code) << run.errors;
    EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
    EXPECT_THAT(run.errors, HasSubstr(why));
  }
};

TEST_F(PerFeature, EachFileIsThatOfTheFeatureAlone) {
  const std::string input = lakes();
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--threads", "1"},
                                                  {"--threads", "4", "--size-max", "300"},
                                                  {"--size", "200", "--target", "fvcom"}}) {
    std::vector<std::string> words{"-o", file("lake-{}.nc"), "-o", file("lake-{}.gpkg"), "--overwrite", "--quiet"};
    words.insert(words.end(), options.begin(), options.end());
    const ProgramRun run = mesh(input, words);
    EXPECT_EQ(run.code, 0) << run.errors;
    EXPECT_EQ(run.output, "");
    for (int fid = 0; fid < 4; ++fid) {
      std::vector<std::string> alone{"mesh",        input,          "--where", "FID = " + std::to_string(fid),
                                     "-o",          file("one.nc"), "-o",      file("one.gpkg"),
                                     "--overwrite", "--quiet"};
      alone.insert(alone.end(), options.begin(), options.end());
      ASSERT_EQ(runProgram(alone).code, 0);
      const std::string name = "lake-" + std::to_string(fid);
      EXPECT_TRUE(readText(file("one.nc")) == readText(file(name + ".nc"))) << name;
      EXPECT_TRUE(readText(file("one.gpkg")) == readText(file(name + ".gpkg"))) << name;
    }
  }
}

TEST_F(PerFeature, NamesAreMadeSafeAndNumbersStandInForThem) {
  const ProgramRun run = mesh(lakes(), {"-o", file("{}.2dm"), "--name-field", "name"});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_EQ(made(".2dm"), (Names{"West_Lake.2dm", "Müggelsee.2dm", "2.2dm", "hidden.2dm"}));
}

TEST_F(PerFeature, NumbersOfSeveralFilesStandAfterTheirNames) {
  const std::string more = writeFeatures(Json::array({square(9, 50, 0.01, {{"name", "x"}})}), "ponds.geojson");
  EXPECT_EQ(mesh(lakes(), {more, "-o", file("{}.2dm")}).code, 0);
  EXPECT_EQ(made(".2dm"), (Names{"lakes-0.2dm", "lakes-1.2dm", "lakes-2.2dm", "lakes-3.2dm", "ponds-0.2dm"}));
}

TEST_F(PerFeature, TwoOfOneNameAreRefusedBeforeAnythingIsMade) {
  const auto twice = [this](const char* first, const char* second) {
    return writeFeatures({square(5, 50, 0.01, {{"name", first}}), square(6, 50, 0.01, {{"name", "other"}}),
                          square(7, 50, 0.01, {{"name", second}})});
  };
  for (const auto& [first, second] :
       {std::pair("Long Lake", "Long Lake"), std::pair("a/b", "a:b"), std::pair("Lake", "LAKE"), std::pair("2", "")}) {
    const ProgramRun run = mesh(twice(first, second), {"-o", file("{}.2dm"), "--name-field", "name"});
    expectRefused(run, 3, "feature 0 of '");
    EXPECT_THAT(run.errors, HasSubstr("feature 2 of '"));
    EXPECT_EQ(names(), Names{"lakes.geojson"});
  }
}

TEST_F(PerFeature, OneThatCannotBeMeshedIsLeftOutAndTheReportSumsUp) {
  const ProgramRun run = mesh(lakesWithOneThatCannotBe(), {"-o", file("{}.2dm"), "--report", file("r.json")});
  EXPECT_EQ(run.code, 1) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("coastmesh: warning: left out: "));
  EXPECT_THAT(run.output, HasSubstr("3 of 4 features meshed, 1 left out"));
  EXPECT_EQ(made(".2dm"), (Names{"0.2dm", "1.2dm", "3.2dm"}));
  const Json report = Json::parse(readText(file("r.json")));
  EXPECT_EQ(report["per_feature"], (Json{{"made", 3}, {"short", 0}, {"skipped", 0}, {"refused", 1}}));
  std::uint64_t vertices = 0, triangles = 0;
  double least = 180.0;
  for (const char* name : {"0.2dm", "1.2dm", "3.2dm"}) {
    const Json info = Json::parse(runProgram({"info", file(name), "--json", "--assume-crs", "EPSG:4326"}).output);
    vertices += info["nodes"].get<std::uint64_t>();
    triangles += info["triangles"].get<std::uint64_t>();
    least = std::min(least, info["min_angle_deg"].get<double>());
  }
  EXPECT_EQ(report["mesh"]["vertices"], vertices);
  EXPECT_EQ(report["mesh"]["triangles"], triangles);
  EXPECT_NEAR(report["mesh"]["min_angle_deg"].get<double>(), least, 0.01);
  const Json& refused = report["features"][2];
  EXPECT_EQ(refused["state"], "refused");
  EXPECT_EQ(refused["fid"], 2);
  EXPECT_FALSE(refused["reason"].get<std::string>().empty());
  EXPECT_TRUE(refused["outputs"].empty());
}

TEST_F(PerFeature, WhereNoneCanBeMeshedItIsTheInputsFault) {
  Json bad = square(6, 50, 0.03, {{"name", "flat"}});
  bad["geometry"]["coordinates"] = {{{6, 50}, {6.1, 50}, {6, 50}, {6, 50}}};
  const ProgramRun run = mesh(writeFeatures({bad, bad}), {"-o", file("{}.2dm")});
  EXPECT_EQ(run.code, 3);
  EXPECT_THAT(run.errors, HasSubstr("none of the 2 features can be meshed"));
  EXPECT_EQ(names(), Names{"lakes.geojson"});
}

TEST_F(PerFeature, WhereAllRequireTooManyVerticesItIsNotTheInputsFault) {
  const ProgramRun run = mesh(lakes(), {"-o", file("{}.2dm"), "--size", "5", "--max-vertices", "100"});
  EXPECT_EQ(run.code, 1) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("--max-vertices allows"));
  EXPECT_EQ(names(), Names{"lakes.geojson"});
}

TEST_F(PerFeature, DepthsThatOpenNothingAreWarnedOf) {
  write("shallow.asc", "ncols 4\nnrows 2\nxllcorner 4\nyllcorner 49\ncellsize 1\n-10 -10 -10 -10\n-10 -10 -10 -10\n");
  const ProgramRun run = mesh(writeFeatures(Json::array({square(5, 50, 0.03, {{"name", "a"}})})),
                              {"-o", file("{}.14"), "--bathymetry", file("shallow.asc"), "--open-deeper", "50"});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("--open-deeper"));
}

TEST_F(PerFeature, LinesWithOtherLongitudesOfTheSamePlaceArePartOfTheMesh) {
  const std::string input = writeFeatures(Json::array({square(-60, 50, 0.03, Json::object())}));
  for (const char* option : {"--constraints", "--weirs"}) {
    std::set<std::uint64_t> nodes;
    for (const double west : {-60.0, 300.0}) {
      const std::string lines = writeFeatures(Json::array({lineIn(west, 50, 0.03)}), "lines.geojson");
      const ProgramRun run = mesh(input, {"-o", file("{}.2dm"), option, lines, "--overwrite"});
      EXPECT_EQ(run.code, 0) << run.errors;
      nodes.insert(infoOf("0.2dm")["nodes"].get<std::uint64_t>());
    }
    EXPECT_EQ(nodes.size(), 1u) << option;
    EXPECT_GT(*nodes.begin(), 4u) << option;
  }
}

// A file may have no effect on one feature and one on another; what has none on any is told once.
// The line lies in the box of the first lake, but not in its water.
TEST_F(PerFeature, OpenLinesBesideALakeDoNotMakeItFallShort) {
  Json corner = square(5, 50, 0.01, {{"name", "corner"}});
  corner["geometry"]["coordinates"] = {{{5, 50}, {5.03, 50}, {5, 50.03}, {5, 50}}};
  const Json line = lineIn(5.015, 50.015, 0.01);
  const ProgramRun beside = mesh(writeFeatures({corner, line}), {"-o", file("{}.nc"), "--name-field", "name"});
  EXPECT_EQ(beside.code, 0) << beside.errors;
  EXPECT_THAT(beside.errors, HasSubstr("left out: "));
  EXPECT_THAT(beside.errors, HasSubstr("feature 1: the lines close no ring"));
  EXPECT_EQ(beside.errors.find("corner:"), std::string::npos) << beside.errors;
  // In the water of another lake.
  const ProgramRun within = mesh(writeFeatures({corner, line, square(5.0145, 50.0145, 0.011, {{"name", "other"}})}),
                                 {"-o", file("{}.nc"), "--name-field", "name", "--overwrite"});
  EXPECT_EQ(within.code, 0) << within.errors;
  EXPECT_EQ(within.errors.find("close no ring"), std::string::npos) << within.errors;
}

TEST_F(PerFeature, InputsWithoutEffectOnAnyFeatureAreWarnedOf) {
  const std::string input = lakes();
  const std::string near = writeFeatures(Json::array({lineIn(6, 50, 0.03)}), "near.geojson");
  const std::string far = writeFeatures(Json::array({lineIn(60, 5, 0.03)}), "far.geojson");
  const std::string sizes = writeFeatures(Json::array({lineIn(60, 5, 0.03, {{"size", 100}})}), "sizes.geojson");
  const std::string area = writeFeatures(Json::array({square(60, 5, 0.03, Json::object())}), "area.geojson");
  const ProgramRun run = mesh(input, {"-o", file("{}.2dm"), "--constraints", near, "--constraints", far,
                                      "--constraints", area, "--size-features", sizes, "--report", file("r.json")});
  EXPECT_EQ(run.code, 0) << run.errors;
  const Json warnings = Json::parse(readText(file("r.json")))["warnings"];
  ASSERT_EQ(warnings.size(), 3u) << warnings;
  EXPECT_THAT(warnings[0].get<std::string>(), HasSubstr(area + ": its polygons are left out"));
  EXPECT_THAT(warnings[1].get<std::string>(), HasSubstr(far + ": nothing of it lies in the water"));
  EXPECT_THAT(warnings[2].get<std::string>(), HasSubstr(sizes + ": none of them lies in the mesh"));
  // A share of the features may have no use for them.
  EXPECT_EQ(mesh(input, {"-o", file("s-{}.2dm"), "--constraints", far, "--shard", "1/2"}).errors, "");
}

TEST_F(PerFeature, NotesAreToldOnceOrWithTheirFeature) {
  const ProgramRun run = mesh(lakes(), {"-o", file("{}.2dm"), "--size", "200", "--size-min", "300", "--coast", "follow",
                                        "--target", "mpas", "--report", file("r.json")});
  EXPECT_LE(run.code, 1) << run.errors;
  const Json notes = Json::parse(readText(file("r.json")))["input"]["notes"];
  ASSERT_GE(notes.size(), 2u);
  std::size_t of_angles = 0, of_sizes = 0;
  for (const Json& note : notes) {
    of_angles += note.get<std::string>().starts_with("no angle above 89 degrees");
    of_sizes += note.get<std::string>().starts_with("--size 200 is less than --size-min 300");
    EXPECT_THAT(run.output, HasSubstr(note.get<std::string>()));
  }
  EXPECT_EQ(of_angles, 1u) << notes;
  EXPECT_EQ(of_sizes, 1u) << notes;
}

TEST_F(PerFeature, SizesFromAPipeApplyToAllFeatures) {
  const std::string input = lakes();
  const std::string sizes =
      writeFeatures({lineIn(5, 50, 0.01, {{"size", 50}}), lineIn(5.01, 50, 0.01, {{"size", 50}})}, "sizes.geojson");
  ASSERT_EQ(mesh(input, {"-o", file("file-{}.2dm"), "--size-features", sizes, "--size", "300"}).code, 0);
  const ProgramRun run = runShell("cat " + sizes + " | \"$0\" mesh " + input + " --per-feature -o " +
                                  file("pipe-{}.2dm") + " --size-features - --size 300");
  EXPECT_EQ(run.code, 0) << run.errors;
  for (const char* fid : {"0", "1", "2", "3"})
    EXPECT_TRUE(readText(file("file-" + std::string(fid) + ".2dm")) ==
                readText(file("pipe-" + std::string(fid) + ".2dm")))
        << fid;
}

TEST_F(PerFeature, BoundsThatAreMissedMakeExitCodeOne) {
  const ProgramRun run =
      mesh(lakes(), {"-o", file("{}.2dm"), "--size", "50", "--max-vertices", "40", "--report", file("r.json")});
  EXPECT_NE(run.code, 0);
  const Json sums = Json::parse(readText(file("r.json")))["per_feature"];
  EXPECT_EQ(sums["made"], 0);
  EXPECT_EQ(sums["short"].get<int>() + sums["refused"].get<int>(), 4);
}

TEST_F(PerFeature, WhatIsThereStaysAndIsGoneOnWith) {
  const std::string input = lakes();
  ASSERT_EQ(mesh(input, {"-o", file("{}.nc"), "-o", file("{}.2dm"), "--quiet"}).code, 0);
  const std::string first = readText(file("1.nc"));
  std::filesystem::remove(file("1.nc"));  // one of its two
  write("2.nc", "precious");
  // Without an option nothing is replaced.
  const ProgramRun plain = mesh(input, {"-o", file("{}.nc"), "-o", file("{}.2dm")});
  expectRefused(plain, 4, "--skip-existing");
  EXPECT_EQ(made(".nc").count("1.nc"), 0u);
  const ProgramRun on = mesh(input, {"-o", file("{}.nc"), "-o", file("{}.2dm"), "--skip-existing"});
  EXPECT_EQ(on.code, 0) << on.errors;
  EXPECT_THAT(on.output, HasSubstr("1 of 4 features meshed, 3 were there already"));
  EXPECT_TRUE(readText(file("1.nc")) == first);
  EXPECT_EQ(readText(file("2.nc")), "precious");
  // An empty file, as a full disk leaves it, counts as missing.
  write("1.nc", "");
  EXPECT_EQ(mesh(input, {"-o", file("{}.nc"), "-o", file("{}.2dm"), "--skip-existing", "--quiet"}).code, 0);
  EXPECT_TRUE(readText(file("1.nc")) == first);
  ASSERT_EQ(mesh(input, {"-o", file("{}.nc"), "-o", file("{}.2dm"), "--overwrite", "--quiet"}).code, 0);
  EXPECT_NE(readText(file("2.nc")), "precious");
}

TEST_F(PerFeature, SharesAreMadeOnceEach) {
  const std::string input = lakes();
  std::size_t before = 0;
  for (int shard = 1; shard <= 3; ++shard) {
    EXPECT_EQ(mesh(input, {"-o", file("{}.2dm"), "--shard", std::to_string(shard) + "/3", "--quiet"}).code, 0);
    const std::size_t now = made(".2dm").size();
    EXPECT_GT(now, before);
    before = now;
  }
  EXPECT_EQ(made(".2dm").size(), 4u);
}

// After an interrupt finished outputs are complete, nothing else is left, and the same command makes the rest.
TEST_F(PerFeature, StoppedAndGoneOnWithItIsTheWhole) {
  constexpr std::size_t kFeatures = 20;
  const auto writeInput = [&](double last_side) {
    Json features = Json::array();
    for (std::size_t i = 0; i + 1 < kFeatures; ++i)
      features.push_back(square(5 + 0.1 * static_cast<double>(i), 50, 0.02, Json::object()));
    features.push_back(square(9, 50, last_side, Json::object()));
    return writeFeatures(features);
  };
  const std::vector<std::string> options{"-o", file("{}.2dm"), "--size", "25", "--threads", "2", "--skip-existing"};
  // Millions of triangles, so that the last feature is not done before others.
  const std::string input = writeInput(0.5);
  std::vector<std::string> words{"mesh", input, "--per-feature"};
  words.insert(words.end(), options.begin(), options.end());
  const ProgramRun stopped = runAndSignal(
      words, [&] { return !made(".2dm").empty(); }, SIGTERM);
  EXPECT_EQ(stopped.code, 5) << stopped.errors;
  const Names whole = made(".2dm");
  EXPECT_GT(whole.size(), 0u);
  EXPECT_LT(whole.size(), kFeatures);
  for (const std::string& name : names()) EXPECT_FALSE(name.starts_with(".")) << name;
  writeInput(0.02);
  const ProgramRun rest = mesh(input, options);
  EXPECT_EQ(rest.code, 0) << rest.errors;
  EXPECT_THAT(rest.output,
              HasSubstr(std::to_string(whole.size()) + (whole.size() == 1 ? " was" : " were") + " there already"));
  ASSERT_EQ(made(".2dm").size(), kFeatures);
  std::size_t compared = 0;
  for (const std::string& name : whole) {
    if (++compared > 5) break;
    ASSERT_EQ(runProgram({"mesh", input, "--where", "FID = " + name.substr(0, name.find('.')), "-o", file("one.2dm"),
                          "--size", "25", "--overwrite", "--quiet"})
                  .code,
              0);
    EXPECT_TRUE(readText(file("one.2dm")) == readText(file(name))) << name;
  }
}

// Several small files are moved into place after a single wait for the disk.
TEST_F(PerFeature, ManyFilesAreAllThere) {
  constexpr std::size_t kFeatures = 600;
  Json features = Json::array();
  for (std::size_t i = 0; i < kFeatures; ++i)
    features.push_back(
        square(5 + 0.1 * static_cast<double>(i % 30), 40 + 0.1 * static_cast<double>(i / 30), 0.02, Json::object()));
  const std::string input = writeFeatures(features);
  const std::vector<std::string> options{"-o", file("{}.2dm"), "--threads", "2", "--overwrite", "--quiet"};
  const auto countWhole = [&] {
    std::size_t whole = 0;
    for (const std::string& name : names()) {
      EXPECT_FALSE(name.starts_with(".")) << name;
      if (!name.ends_with(".2dm") || std::filesystem::is_directory(file(name))) continue;
      const std::string text = readText(file(name));
      EXPECT_TRUE(text.empty() || text.starts_with("MESH2D")) << name;
      whole += !text.empty();
    }
    return whole;
  };
  EXPECT_EQ(mesh(input, options).code, 0);
  EXPECT_EQ(countWhole(), kFeatures);
  // If one cannot be written, those before it are there.
  for (const std::string& name : names())
    if (name.ends_with(".2dm")) std::filesystem::resize_file(file(name), 0);
  std::filesystem::remove(file("599.2dm"));
  std::filesystem::create_directory(file("599.2dm"));
  const ProgramRun run = mesh(input, options);
  expectRefused(run, 4, "599.2dm");
  EXPECT_GT(countWhole(), kFeatures / 2);
}

TEST_F(PerFeature, WhatDoesNotGoTogetherIsRefused) {
  const std::string input = lakes();
  const std::string out = file("{}.2dm");
  expectRefused(mesh(input, {"-o", file("a.2dm")}), 2, "{}");
  expectRefused(mesh(input, {"-o", file("{}/a.2dm")}), 2, "{}");
  expectRefused(mesh(input, {"-o", file("{}.shard")}), 2, ".shard");
  expectRefused(mesh(input, {"-o", out, "--name-field", "nmae"}), 2, "there are name");
  expectRefused(mesh(input, {"-o", out, "--dissolve"}), 2, "--dissolve");
  expectRefused(mesh(input, {"-o", out, "--edits", file("e.gpkg")}), 2, "--edits");
  expectRefused(mesh(input, {"-o", out, "--bbox", "5,50,6,51"}), 2, "--bbox");
  expectRefused(mesh(input, {"-o", out, "--domain", "globe"}), 2, "--domain");
  expectRefused(mesh(input, {"-o", file("none/{}.2dm")}), 4, "none");
  expectRefused(mesh(input, {"-o", out, "--report", file("3.2dm"), "--overwrite"}), 2, "would both write");
  expectRefused(mesh(input, {"-o", file("{}.geojson"), "--name-field", "name", "--overwrite", "--quiet",
                             writeFeatures(Json::array({square(1, 1, 0.1, {{"name", "lakes"}})}), "more.geojson")}),
                2, "input and output at once");
  expectRefused(mesh(write("a.poly", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n"), {"-o", out}), 2,
                "plane graph");
  EXPECT_TRUE(made(".2dm").empty());
}

}  // namespace

}  // namespace coastmesh::test
