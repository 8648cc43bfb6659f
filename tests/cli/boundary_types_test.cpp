// Boundary types defined by the input itself or by separate files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;
using Roles = std::map<std::string, int>;  // number of edges of each role

Json feature(const Json& properties, const std::string& type, const Json& coordinates) {
  return {
      {"type", "Feature"}, {"properties", properties}, {"geometry", {{"type", type}, {"coordinates", coordinates}}}};
}

// A rectangle of some 7 by 6 km.
Json lakeAt(double west, const Json& properties) {
  const Json ring = {{west, 50.0}, {west + 0.1, 50.0}, {west + 0.1, 50.05}, {west, 50.05}, {west, 50.0}};
  return feature(properties, "Polygon", Json::array({ring}));
}

// Along its southern shore.
Json southOf(double west, const Json& properties) {
  return feature(properties, "LineString", {{west, 50.0}, {west + 0.1, 50.0}});
}

// Along its western shore.
Json westOf(double west, const Json& properties) {
  return feature(properties, "LineString", {{west, 50.0}, {west, 50.05}});
}

class BoundaryTypes : public ProgramTest {
 protected:
  std::string put(const std::string& name, const Json& features) const {
    return write(name, Json{{"type", "FeatureCollection"}, {"features", features}}.dump());
  }
  // A lake, and a line along its southern shore that opens it.
  std::string lakeWithLine() const {
    return put("lake.geojson", {lakeAt(5, {{"status", "new"}}), southOf(5, {{"status", "old"}, {"type", "open"}})});
  }
  void done(const std::vector<std::string>& arguments) const { expectDone(runProgram(arguments)); }
  void doneInShell(const std::string& script) const { expectDone(runShell("cd '" + file("") + "' && " + script)); }

  Roles rolesIn(const std::string& mesh) const {
    done({"convert", file(mesh), "-o", file("roles.geojson"), "--overwrite", "--quiet"});
    Roles roles;
    const Json boundaries = Json::parse(readText(file("roles_boundaries.geojson")));
    for (const Json& boundary : boundaries["features"])
      roles[boundary["properties"]["role"]] += static_cast<int>(boundary["geometry"]["coordinates"].size()) - 1;
    return roles;
  }

  // "NAME ROLE" of each boundary, sorted.
  std::string namesIn(const std::string& mesh) const {
    done({"convert", file(mesh), "-o", file("names.geojson"), "--overwrite", "--quiet"});
    std::vector<std::string> all;
    const Json boundaries = Json::parse(readText(file("names_boundaries.geojson")));
    for (const Json& boundary : boundaries["features"]) {
      const Json& properties = boundary["properties"];
      const std::string role = properties["role"];
      all.push_back(properties["name"].is_null() ? role : properties["name"].get<std::string>() + " " + role);
    }
    std::ranges::sort(all);
    std::string text;
    for (const std::string& each : all) text += (text.empty() ? "" : ", ") + each;
    return text;
  }

 private:
  static void expectDone(const ProgramRun& run) {
    EXPECT_EQ(run.code, 0) << run.errors;
    EXPECT_EQ(run.errors, "");
  }
};

TEST_F(BoundaryTypes, WhatIsFilteredOutDefinesNothing) {
  const std::string input = lakeWithLine();
  const std::vector<std::string> options{"--boundary-column", "type", "--overwrite", "--quiet"};
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), options.begin(), options.end());
    done(arguments);
  };
  run({"mesh", input, "-o", file("all.gpkg")});
  EXPECT_EQ(rolesIn("all.gpkg").count("open"), 1u);
  run({"mesh", input, "-o", file("new.gpkg"), "--where", "status='new'"});
  EXPECT_EQ(rolesIn("new.gpkg").count("open"), 0u);
  run({"clean", input, "-o", file("cleaned.gpkg"), "--where", "status='new'"});
  done({"mesh", file("cleaned.gpkg"), "-o", file("then.gpkg"), "--quiet"});
  EXPECT_EQ(rolesIn("then.gpkg").count("open"), 0u);
  run({"mesh", input, "--per-feature", "-o", file("one-{}.gpkg"), "--where", "status='new'"});
  EXPECT_EQ(rolesIn("one-0.gpkg").count("open"), 0u);
}

TEST_F(BoundaryTypes, LayersThatAreLeftOutDefineNothing) {
  put("lake.geojson", Json::array({lakeAt(5, {{"type", "land"}})}));
  put("mouth.geojson", Json::array({southOf(5, {{"type", "open"}})}));
  std::string layers;
  for (const std::string name : {"lake", "mouth"})
    layers += "<OGRVRTLayer name='" + name + "'><SrcDataSource relativeToVRT='1'>" + name +
              ".geojson</SrcDataSource></OGRVRTLayer>";
  const std::string both = write("both.vrt", "<OGRVRTDataSource>" + layers + "</OGRVRTDataSource>");
  const std::vector<std::string> options{"--boundary-column", "type", "--overwrite", "--quiet", "-o", file("a.gpkg")};
  for (const std::size_t open : {1u, 0u}) {
    std::vector<std::string> arguments{"mesh", both};
    if (open == 0) arguments.insert(arguments.end(), {"--layer", "lake"});
    arguments.insert(arguments.end(), options.begin(), options.end());
    done(arguments);
    EXPECT_EQ(rolesIn("a.gpkg").count("open"), open);
  }
}

TEST_F(BoundaryTypes, TheFilterIsNotForFilesOfBoundaries) {
  const std::string input = lakeWithLine();
  const std::string types = put("types.geojson", Json::array({westOf(5, {{"type", "river"}})}));
  done({"mesh", input, "-o", file("a.gpkg"), "--where", "status='new'", "--boundaries", types, "--quiet"});
  const Roles roles = rolesIn("a.gpkg");
  EXPECT_EQ(roles.count("river"), 1u);
  EXPECT_EQ(roles.count("open"), 0u);
}

// All column names listed by --help are searched for.
TEST_F(BoundaryTypes, AFileWithoutTypesIsRefusedWithTheColumnsLookedFor) {
  const std::string input = lakeWithLine();
  const std::string types = put("types.geojson", Json::array({westOf(5, {{"ib", 22}})}));
  const ProgramRun run = runProgram({"mesh", input, "-o", file("a.gpkg"), "--boundaries", types, "--quiet"});
  EXPECT_EQ(run.code, 3);
  const std::string columns = "type, role, boundary, ibtype or kind";
  EXPECT_NE(run.errors.find("has no type of boundary in a column called " + columns), std::string::npos) << run.errors;
  EXPECT_NE(runProgram({"mesh", "--help"}).output.find(columns), std::string::npos);
}

// Standard input and pipes can be read only once.
TEST_F(BoundaryTypes, StandardInputAndPipesDefineThemToo) {
  lakeWithLine();
  const std::string options = " --boundary-column type --quiet --overwrite ";
  doneInShell("\"$0\" mesh lake.geojson -o mesh.nc" + options);
  EXPECT_EQ(rolesIn("mesh.nc").count("open"), 1u);
  const std::string mesh = readText(file("mesh.nc"));
  doneInShell("\"$0\" mesh - -o mesh.nc" + options + "< lake.geojson");
  EXPECT_TRUE(readText(file("mesh.nc")) == mesh);
  doneInShell("mkfifo pipe && (cat lake.geojson > pipe & \"$0\" mesh pipe -o mesh.nc" + options + ")");
  EXPECT_TRUE(readText(file("mesh.nc")) == mesh);
  doneInShell("\"$0\" mesh - --per-feature -o mesh-{}.gpkg" + options + "< lake.geojson");
  EXPECT_EQ(rolesIn("mesh-0.gpkg"), rolesIn("mesh.nc"));
  doneInShell("\"$0\" clean - -o cleaned.gpkg" + options + "< lake.geojson");
  doneInShell("\"$0\" mesh cleaned.gpkg -o mesh.nc --quiet --overwrite");
  EXPECT_EQ(rolesIn("mesh.nc").count("open"), 1u);
  const std::string then = readText(file("mesh.nc"));
  doneInShell("\"$0\" mesh - -o mesh.nc --quiet --overwrite < cleaned.gpkg");
  EXPECT_TRUE(readText(file("mesh.nc")) == then);
  doneInShell("\"$0\" clean - -o again.gpkg --quiet < cleaned.gpkg");
  EXPECT_TRUE(readText(file("again.gpkg")) == readText(file("cleaned.gpkg")));
}

// Two openings that touch are two boundaries, if their names differ; those of one name are one.
TEST_F(BoundaryTypes, NamesOfFeaturesAreThoseOfBoundaries) {
  const std::string lake = put("lake.geojson", Json::array({lakeAt(5, {{"name", "Lake"}})}));
  const auto line = [](double from, double to, const std::string& name) {
    return feature({{"type", "open"}, {"name", name}}, "LineString", {{from, 50.0}, {to, 50.0}});
  };
  const std::string types =
      put("types.geojson", {line(5, 5.05, "west"), line(5.05, 5.08, "east"), line(5.08, 5.1, "east"),
                            westOf(5, {{"type", "land"}, {"name", "x"}})});
  done({"mesh", lake, "-o", file("a.nc"), "-o", file("a.vtu"), "--boundaries", types, "--size", "500", "--quiet"});
  for (const std::string mesh : {"a.nc", "a.vtu"}) EXPECT_EQ(namesIn(mesh), "east open, land, west open") << mesh;
}

// In one step, and with a cleaned file between, of which a GIS names the layer.
TEST_F(BoundaryTypes, ACleanedFileHasThemWithTheirNames) {
  const std::string input =
      put("lake.geojson", {lakeAt(5, {{"name", "Lake"}}), southOf(5, {{"name", "S"}, {"type", "open"}}),
                           westOf(5, {{"name", "W"}, {"type", "river"}})});
  const std::vector<std::string> finish{"-o", file("a.nc"), "--size", "500", "--quiet", "--overwrite"};
  const auto mesh = [&](const std::string& of, std::vector<std::string> options) {
    options.insert(options.begin(), {"mesh", of});
    options.insert(options.end(), finish.begin(), finish.end());
    done(options);
    return readText(file("a.nc"));
  };
  const std::string one_step = mesh(input, {"--boundary-column", "type"});
  EXPECT_EQ(namesIn("a.nc"), "S open, W river, land");
  const std::string cleaned = file("cleaned.gpkg");
  done({"clean", input, "-o", cleaned, "--boundary-column", "type", "--quiet"});
  EXPECT_TRUE(mesh(cleaned, {}) == one_step);
  EXPECT_TRUE(mesh(cleaned + "|layername=pslg", {}) == one_step);
  EXPECT_TRUE(mesh(cleaned, {"--layer", "pslg"}) == one_step);
  done({"clean", cleaned, "-o", file("again.gpkg"), "--quiet"});
  EXPECT_TRUE(readText(file("again.gpkg")) == readText(cleaned));
}

// Unusable types are reported before a long job begins.
TEST_F(BoundaryTypes, AnUnknownTypeIsRefusedBeforeMeshing) {
  const std::string input = put("lake.geojson", Json::array({lakeAt(5, {{"type", "reed"}})}));
  const std::string types = put("types.geojson", Json::array({lakeAt(5, {{"type", "reed"}})}));
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--boundary-column", "type"}, {"--boundaries", types}}) {
    std::vector<std::string> arguments{"mesh", input, "-o", file("a.nc"), "--progress", "json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 3);
    EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
    EXPECT_THAT(run.errors, HasSubstr("\"reed\" is not a type of boundary"));
    EXPECT_THAT(run.output, Not(HasSubstr("refine")));
  }
}

TEST_F(BoundaryTypes, AColumnThatIsNotThereIsRefusedWithThoseThatAre) {
  const std::string input = put("lake.geojson", Json::array({lakeAt(5, {{"Name", "lake"}, {"shore", nullptr}})}));
  const std::string types = put("types.geojson", Json::array({lakeAt(5, {{"side", "open"}})}));
  for (const std::vector<std::string>& command : {std::vector<std::string>{"mesh", input, "-o", file("a.nc")},
                                                  {"mesh", input, "-o", file("a-{}.nc"), "--per-feature"},
                                                  {"clean", input, "-o", file("a.gpkg")}}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {"--boundary-column", "sohre", "--quiet"});
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 3);
    EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
    EXPECT_THAT(run.errors, HasSubstr("no input has the column \"sohre\" of boundary types; there are Name, shore"));
  }
  // A column exists, in any case of its letters, even if no feature has a value in it.
  done({"mesh", input, "-o", file("a.nc"), "--boundary-column", "SHORE", "--quiet"});
  // Files of boundary types must have the column; the input then need not.
  const std::vector<std::string> options{"mesh",    input,          "-o",  file("b.nc"),
                                         "--quiet", "--boundaries", types, "--boundary-column"};
  std::vector<std::string> side = options, none = options;
  side.emplace_back("side");
  none.emplace_back("shore");
  done(side);
  none.emplace_back("--overwrite");
  const ProgramRun run = runProgram(none);
  EXPECT_EQ(run.code, 3);
  EXPECT_THAT(run.errors, HasSubstr("types.geojson': has no column \"shore\" of boundary types; there is only side"));
}

TEST_F(BoundaryTypes, FilesThatConcernNoFeatureAreNamedOnce) {
  Json lakes = Json::array();
  for (int i = 0; i < 4; ++i) lakes.push_back(lakeAt(5 + i, Json::object()));
  const std::string input = put("lakes.geojson", lakes);
  const std::string one = put("one.geojson", Json::array({westOf(7, {{"type", "river"}})}));
  const std::string none = put("none.geojson", Json::array({westOf(20, {{"type", "river"}})}));
  const std::vector<std::string> options{"mesh", input, "--per-feature",      "--boundaries", one, "--boundaries",
                                         none,   "-o",  file("lake-{}.gpkg"), "--quiet"};
  const ProgramRun run = runProgram(options);
  EXPECT_EQ(run.code, 0);
  EXPECT_EQ(std::ranges::count(run.errors, '\n'), 1) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("warning: '" + none + "': says nothing of the mesh's boundary"));
  EXPECT_EQ(rolesIn("lake-2.gpkg").count("river"), 1u);
  // A shard has only some of the features, so it does not warn about the others.
  std::vector<std::string> share = options;
  share.insert(share.end(), {"--shard", "1/2", "--overwrite"});
  EXPECT_EQ(runProgram(share).errors, "");
}

TEST_F(BoundaryTypes, EachFeatureHasItsOwnForAnyNumberOfThreads) {
  Json lakes = Json::array();
  for (int i = 0; i < 6; ++i) {
    const double west = 5.0 + i;
    lakes.push_back(lakeAt(west, {{"type", i % 2 == 0 ? "river" : "10"}}));
    lakes.push_back(southOf(west, {{"type", "open"}}));
  }
  const std::string input = put("lakes.geojson", lakes);
  const std::string types = put("types.geojson", Json::array({westOf(7, {{"type", "river"}})}));
  for (const std::string threads : {"1", "4"})
    EXPECT_EQ(runProgram({"mesh", input, "--per-feature", "--boundary-column", "type", "--boundaries", types, "-o",
                          file("lake-{}-" + threads + ".gpkg"), "--threads", threads, "--quiet"})
                  .code,
              0);
  for (int i = 0; i < 6; ++i) {
    const std::string name = "lake-" + std::to_string(2 * i);
    EXPECT_TRUE(readText(file(name + "-1.gpkg")) == readText(file(name + "-4.gpkg"))) << name;
    const Roles roles = rolesIn(name + "-4.gpkg");
    EXPECT_EQ(roles.count("open"), 1u) << name;
    EXPECT_EQ(roles.count("river"), i % 2 == 0 ? 1u : 0u) << name;
  }
}

// Boundaries opened by a file or by the input are not shore: --size-shore does not apply to them.
TEST_F(BoundaryTypes, OpeningsDoNotDrawTheSizeOfTheShore) {
  const Json open = southOf(5, {{"type", "open"}}), river = southOf(5, {{"type", "river"}});
  put("lake.geojson", Json::array({lakeAt(5, Json::object())}));
  put("own.geojson", Json::array({lakeAt(5, Json::object()), open}));
  const auto vertices = [&](const std::string& input, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"mesh",         file(input), "-o",           file("a.gpkg"),
                                       "--overwrite",  "--report",  file("r.json"), "--quiet",
                                       "--size-shore", "100",       "--size-max",   "1500"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    done(arguments);
    return Json::parse(readText(file("r.json")))["mesh"]["vertices"].get<int>();
  };
  const int all = vertices("lake.geojson", {});
  const std::string types = put("open.geojson", Json::array({open}));
  const int opened = vertices("lake.geojson", {"--boundaries", types});
  EXPECT_LT(opened, 0.85 * all);
  EXPECT_EQ(rolesIn("a.gpkg").count("open"), 1u);
  // Edges are coarse except near the shores at both ends.
  EXPECT_LT(rolesIn("a.gpkg")["open"], 40);
  EXPECT_EQ(vertices("own.geojson", {"--boundary-column", "type"}), opened);
  // A river's mouth is as fine as the shore.
  EXPECT_EQ(vertices("lake.geojson", {"--boundaries", put("river.geojson", Json::array({river}))}), all);
  // The same applies to a coast that follows the sizes.
  EXPECT_LT(vertices("lake.geojson", {"--boundaries", types, "--coast", "follow"}), 0.85 * all);
}

// An opening with many vertices, slightly off a line, at sizes that depend on the distance from the shore alone.
TEST_F(BoundaryTypes, ACoastThatFollowsIsAsCoarseAtOpeningsAsTheWater) {
  Json south, ring;
  for (int i = 0; i <= 100; ++i) south.push_back({5 + 0.001 * i, 50 + 0.0001 * ((7 * i) % 3)});
  ring = south;
  for (const Json& corner : Json{{5.1, 50.05}, {5.0, 50.05}, {5.0, 50.0}}) ring.push_back(corner);
  const std::string input = put("lake.geojson", Json::array({feature(Json::object(), "Polygon", Json::array({ring}))}));
  const std::string types = put("types.geojson", Json::array({feature({{"type", "open"}}, "LineString", south)}));
  done({"mesh", input, "-o", file("a.gpkg"), "--quiet", "--boundaries", types, "--size-shore", "100", "--shore-rate",
        "0.2", "--grade", "0.2", "--size-max", "1500", "--coast", "follow"});
  EXPECT_LT(rolesIn("a.gpkg")["open"], 40);
  EXPECT_GT(rolesIn("a.gpkg")["open"], 10);
}

// A bay whose west is opened by a line, and behind a strait of 200 m a larger lagoon.
TEST_F(BoundaryTypes, ACoastThatFollowsKeepsTheWaterAtOpenings) {
  const Json ring = {{5, 50},      {5.1, 50},      {5.1, 50.049}, {5.13, 50.049}, {5.13, 50}, {5.5, 50}, {5.5, 50.1},
                     {5.13, 50.1}, {5.13, 50.051}, {5.1, 50.051}, {5.1, 50.1},    {5, 50.1},  {5, 50}};
  const std::string input =
      put("lagoon.geojson", Json::array({feature(Json::object(), "Polygon", Json::array({ring}))}));
  const std::string types =
      put("types.geojson", Json::array({feature({{"type", "open"}}, "LineString", {{5, 50}, {5, 50.1}})}));
  const ProgramRun run =
      runProgram({"mesh", input, "-o", file("a.gpkg"), "--report", file("r.json"), "--boundaries", types, "--size",
                  "1000", "--coast", "follow", "--keep-water", "open", "--strait-min", "0.4"});
  EXPECT_EQ(run.code, 0);
  EXPECT_THAT(run.errors, Not(HasSubstr("says nothing of the mesh's boundary")));
  EXPECT_NEAR(rolesIn("a.gpkg")["open"], 11, 3);
  const Json report = Json::parse(readText(file("r.json")));
  const double bay = 0.1 / 0.47;  // of all water
  EXPECT_NEAR(report["mesh"]["area_m2"].get<double>(), bay * report["input"]["area_m2"].get<double>(),
              0.01 * report["input"]["area_m2"].get<double>());
}

TEST_F(BoundaryTypes, APlaneGraphHasNoColumn) {
  done({"clean", put("lake.geojson", Json::array({lakeAt(5, Json::object())})), "-o", file("lake.poly"), "--quiet"});
  for (const std::string command : {"mesh", "clean"}) {
    const ProgramRun run = runProgram({command, file("lake.poly"), "--boundary-column", "type", "-o", file("a.gpkg")});
    EXPECT_EQ(run.code, 2);
    EXPECT_THAT(run.errors, HasSubstr("leave out --boundary-column"));
  }
  // The column is then that of the files of boundary types.
  const std::string types = put("types.geojson", Json::array({lakeAt(5, {{"side", "open"}})}));
  const ProgramRun run = runProgram(
      {"mesh", file("lake.poly"), "--boundaries", types, "--boundary-column", "side", "-o", file("a.nc"), "--quiet"});
  EXPECT_EQ(run.code, 0) << run.errors;
}

}  // namespace

}  // namespace coastmesh::test
