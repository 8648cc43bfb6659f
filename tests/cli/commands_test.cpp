#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

class Commands : public ProgramTest {
 protected:
  // Meshes the lake and returns the mesh's path.
  std::string meshed(const std::string& name) const {
    const ProgramRun run = runProgram({"mesh", lake(), "-o", file(name), "--quiet", "--overwrite"});
    EXPECT_EQ(run.code, 0) << run.errors;
    return file(name);
  }
  Json info(const std::string& path) const {
    const ProgramRun run = runProgram({"info", path, "--json", "--assume-crs", "EPSG:4326"});
    EXPECT_EQ(run.code, 0) << run.errors;
    return Json::parse(run.output);
  }
};

TEST_F(Commands, EveryOptionOfTheJsonUsageIsInTheHelp) {
  const ProgramRun run = runProgram({"--json-usage"});
  ASSERT_EQ(run.code, 0);
  const Json usage = Json::parse(run.output);
  std::set<std::string> verbs;
  for (const Json& command : usage["commands"]) {
    const std::string verb = command["command"];
    verbs.insert(verb);
    const ProgramRun own = runProgram({verb, "--json-usage"});
    EXPECT_EQ(own.code, 0);
    EXPECT_EQ(Json::parse(own.output), command);
    const ProgramRun help = runProgram({verb, "--help"});
    EXPECT_EQ(help.code, 0);
    for (const Json& option : command["options"]) {
      EXPECT_FALSE(option["help"].get<std::string>().empty());
      for (const std::string name : option["names"]) EXPECT_NE(help.output.find(name), std::string::npos) << name;
    }
  }
  EXPECT_EQ(verbs, (std::set<std::string>{"mesh", "check", "info", "plot", "convert", "cut", "clean", "partition",
                                          "gather", "remesh", "merge", "rivers"}));
}

// GDAL's error would not help.
TEST_F(Commands, InfoNamesTheLayersThatItReads) {
  std::filesystem::create_directory(file("layers"));
  write("layers/a.csv", "WKT,n\n\"POLYGON ((0 0, 1000 0, 1000 1000, 0 1000, 0 0))\",1\n");
  write("layers/b.csv",
        "WKT,n\n\"POLYGON ((2000 0, 3000 0, 3000 1000, 2000 0))\",1\n\"POLYGON ((4000 0, 5000 0, 5000 900, 4000 "
        "0))\",2\n");
  const ProgramRun text = runProgram({"info", file("layers")});
  EXPECT_EQ(text.code, 0) << text.errors;
  EXPECT_THAT(text.output, HasSubstr("in            '" + file("layers") + "|a', 1\n"));
  EXPECT_THAT(text.output, HasSubstr("in            '" + file("layers") + "|b', 2\n"));
  const Json sources = Json::parse(runProgram({"info", file("layers"), "--json"}).output).at("sources");
  ASSERT_EQ(sources.size(), 2u);
  EXPECT_EQ(sources[1].at("features"), 2);
}

TEST_F(Commands, InfoSaysWhyAMeshCannotBeRead) {
  const ProgramRun run = runProgram({"info", write("sea_grd.dat", "Nodes: 3\n")});
  EXPECT_EQ(run.code, 3);
  EXPECT_THAT(run.errors, HasSubstr("sea_grd.dat', line 1: \"Node Number = ...\" is expected"));
}

// QGIS, the help and the manual pages show labels and sections.
TEST_F(Commands, EveryOptionHasALabelOfItsOwnAndASection) {
  const std::vector<std::string> sections = {
      "Input",   "Domain", "Triangles", "Sizes", "Coast", "Depths", "Boundaries and models",
      "Picture", "Output", "The run"};
  const Json usage = Json::parse(runProgram({"--json-usage"}).output);
  for (const Json& command : usage["commands"]) {
    const std::string verb = command["command"];
    const std::string help = runProgram({verb, "--help"}).output;
    std::set<std::string> labels;
    std::size_t at_section = 0, at_help = 0;
    for (const Json& option : command["options"]) {
      const std::string label = option["label"], section = option["section"];
      const std::string shown = verb + " " + option["name"].get<std::string>() + ": '" + label + "', " + section;
      EXPECT_GE(label.size(), 4u) << shown;
      EXPECT_TRUE(std::isupper(static_cast<unsigned char>(label.front()))) << shown;
      EXPECT_FALSE(label.ends_with('.') || label.ends_with(':')) << shown;
      EXPECT_TRUE(labels.insert(label).second) << shown << " is the label of two options";
      while (at_section < sections.size() && sections[at_section] != section) ++at_section;
      ASSERT_LT(at_section, sections.size()) << shown << " is out of the order of sections, or of none";
      // The help shows them in the same order.
      for (const std::string& part : {"\n" + section + ":\n", label}) {
        const std::size_t found = part == label ? help.find(part, at_help) : help.find(part);
        ASSERT_NE(found, std::string::npos) << shown;
        at_help = std::max(at_help, found);
      }
    }
  }
}

TEST_F(Commands, UsageTellsDefaultAndRange) {
  const Json usage = Json::parse(runProgram({"mesh", "--json-usage"}).output);
  const auto option = [&usage](const std::string& name) {
    for (const Json& entry : usage["options"]) {
      if (entry["name"] == name) return entry;
    }
    return Json();
  };
  EXPECT_EQ(option("--min-angle")["default"], 33.0);
  EXPECT_EQ(option("--min-angle")["minimum"], 0.0);
  EXPECT_EQ(option("--min-angle")["maximum"], 45.0);
  EXPECT_EQ(option("--min-angle")["unit"], "DEG");
  EXPECT_EQ(option("--size-max")["exclusive_minimum"], 0.0);
  EXPECT_TRUE(option("--size-max")["default"].is_null());
  EXPECT_EQ(option("--coarsen")["default"], true);
  EXPECT_EQ(option("--algorithm")["choices"].size(), 4u);
  EXPECT_EQ(option("--output")["required"], true);
}

TEST_F(Commands, VersionIsPrinted) {
  const ProgramRun run = runProgram({"--version"});
  EXPECT_EQ(run.code, 0);
  EXPECT_TRUE(run.output.starts_with("coastmesh ")) << run.output;
}

TEST_F(Commands, CheckFindsNothingInOurOwnMeshes) {
  for (const char* name : {"a.2dm", "a.msh", "a.nc", "a.gpkg"}) {
    const std::string mesh = meshed(name);
    const ProgramRun alone =
        runProgram({"check", mesh, "--min-angle", "33", "--delaunay", "--pinches", "--assume-crs", "EPSG:4326"});
    EXPECT_EQ(alone.code, 0) << name << alone.output << alone.errors;
    const ProgramRun against = runProgram({"check", mesh, "--input", lake(), "--min-angle", "33"});
    EXPECT_EQ(against.code, 0) << name << against.output << against.errors;
  }
}

TEST_F(Commands, CheckFindsDefectsAndPlacesThem) {
  const std::string mesh = meshed("a.2dm");
  const ProgramRun angles = runProgram({"check", mesh, "--min-angle", "45", "-o", file("defects.geojson")});
  EXPECT_EQ(angles.code, 1) << angles.errors;
  EXPECT_FALSE(Json::parse(readText(file("defects.geojson")))["features"].empty());

  // The mesh of another lake.
  const std::string other = write("other.geojson", geoJsonPolygons({{{{0, 0}, {0.1, 0}, {0.1, 0.1}}}}));
  EXPECT_EQ(runProgram({"check", mesh, "--input", other}).code, 1);

  // One triangle with reversed orientation.
  std::string text = readText(mesh);
  const std::size_t line = text.find("E3T 1 ");
  std::istringstream words(text.substr(line, text.find('\n', line) - line));
  std::string tag, id, a, b, c, material;
  words >> tag >> id >> a >> b >> c >> material;
  text.replace(line, text.find('\n', line) - line, "E3T 1 " + b + " " + a + " " + c + " " + material);
  const ProgramRun turned = runProgram({"check", write("turned.2dm", text)});
  EXPECT_EQ(turned.code, 1) << turned.errors;
  EXPECT_THAT(turned.output, testing::HasSubstr("triangle not counter-clockwise: 1"));
}

TEST_F(Commands, ConvertKeepsTheMesh) {
  const std::string mesh = meshed("a.nc");
  const Json first = info(mesh);
  EXPECT_EQ(runProgram({"convert", mesh, "-o", file("b.msh"), "-o", file("b.gpkg")}).code, 0);
  EXPECT_EQ(runProgram({"convert", file("b.msh"), "-o", file("c.2dm")}).code, 0);
  EXPECT_EQ(runProgram({"convert", file("c.2dm"), "-o", file("d.nc")}).code, 0);
  for (const char* name : {"b.msh", "b.gpkg", "c.2dm", "d.nc"}) {
    const Json last = info(file(name));
    EXPECT_EQ(last["nodes"], first["nodes"]) << name;
    EXPECT_EQ(last["triangles"], first["triangles"]) << name;
    EXPECT_EQ(last["extent"], first["extent"]) << name;
    EXPECT_NEAR(last["min_angle_deg"].get<double>(), first["min_angle_deg"].get<double>(), 1e-9) << name;
  }
}

// Boundaries of a clockwise mesh are those of its mirror image.
TEST_F(Commands, ConvertWarnsOfClockwiseTriangles) {
  const std::string mesh = write("cw.2dm",
                                 "MESH2D\nE3T 1 1 3 2 1\nE3T 2 1 4 3 1\n"
                                 "ND 1 0 0 -1\nND 2 1 0 -1\nND 3 1 1 -1\nND 4 0 1 -1\n");
  const ProgramRun run = runProgram({"convert", mesh, "-o", file("a.14")});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("2 of 2 triangles are clockwise"));
  const ProgramRun mended = runProgram({"convert", mesh, "-o", file("b.14"), "--target", "adcirc"});
  EXPECT_EQ(mended.code, 0) << mended.errors;
  EXPECT_THAT(mended.errors, Not(HasSubstr("clockwise")));
  EXPECT_THAT(runProgram({"convert", file("b.14"), "-o", file("c.2dm")}).errors, Not(HasSubstr("clockwise")));
  EXPECT_EQ(Json::parse(runProgram({"info", mesh, "--json"}).output).at("area_m2"), 1.0);
}

TEST_F(Commands, WhatAFileLacksIsWarnedOf) {
  ASSERT_EQ(runProgram({"mesh", lake(), "-o", file("lake.slf")}).code, 0);
  EXPECT_THAT(runProgram({"convert", file("lake.slf"), "-o", file("a.14")}).errors, Not(HasSubstr("lake.cli")));
  std::filesystem::remove(file("lake.cli"));
  const std::string missing = "there is no 'lake.cli' beside it, so all boundaries are taken as shore";
  EXPECT_THAT(runProgram({"convert", file("lake.slf"), "-o", file("b.14")}).errors, HasSubstr(missing));
  EXPECT_THAT(runProgram({"info", file("lake.slf")}).errors, HasSubstr(missing));
  EXPECT_THAT(runProgram({"check", file("lake.slf")}).errors, HasSubstr(missing));
  const ProgramRun check = runProgram({"check", file("lake.slf"), "--target", "telemac"});
  EXPECT_EQ(check.errors, "");
  EXPECT_THAT(check.output, HasSubstr(missing));
}

TEST_F(Commands, InfoTellsACoastlineFromAMesh) {
  const Json lake_info = info(lake());
  EXPECT_EQ(lake_info["kind"], "coastline");
  EXPECT_EQ(lake_info["features"], 1);
  EXPECT_EQ(lake_info["rings"], 2);
  EXPECT_EQ(lake_info["holes"], 1);
  const Json mesh_info = info(meshed("a.gpkg"));
  EXPECT_EQ(mesh_info["kind"], "mesh");
  EXPECT_EQ(mesh_info["boundaries"], (Json{{"land", 1}, {"island", 1}}));
  EXPECT_EQ(runProgram({"info", file("nowhere.nc")}).code, 3);
}

TEST_F(Commands, CleanWritesItsLayers) {
  const LonLatRing bow_tie{{0, 0}, {0.1, 0.1}, {0.1, 0}, {0, 0.1}};
  const std::string input = write("bow.geojson", geoJsonPolygons({{bow_tie}}));
  const ProgramRun run = runProgram({"clean", input, "-o", file("clean.gpkg")});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_NE(run.output.find("crossing: 1"), std::string::npos) << run.output;
  EXPECT_EQ(runProgram({"clean", input, "-o", file("clean.poly")}).code, 0);
  ASSERT_EQ(runProgram({"clean", input, "-o", file("told.gpkg"), "--report", file("clean.json")}).code, 0);
  const Json report = Json::parse(readText(file("clean.json")));
  EXPECT_GT(report["input"]["points"], 3);
  EXPECT_GT(report["graph"]["segments"], 2);
  EXPECT_TRUE(report["clean"].contains("touching_ring"));
  for (const char* stage : {"read", "clean", "write", "total"}) EXPECT_GE(report["time_s"][stage], 0.0) << stage;
  EXPECT_EQ(info(file("clean.poly"))["kind"], "poly");
  EXPECT_EQ(info(file("clean.poly"))["points"], 5);
  EXPECT_EQ(runProgram({"clean", input, "-o", file("clean.geojson")}).code, 4);
}

TEST_F(Commands, PlotDraws) {
  const std::string mesh = meshed("a.nc");
  EXPECT_EQ(runProgram({"plot", mesh, "-o", file("a.png"), "--size", "300"}).code, 0);
  EXPECT_TRUE(readText(file("a.png")).starts_with("\x89PNG"));
  for (const char* color : {"none", "angle", "feature", "size"}) {
    EXPECT_EQ(runProgram({"plot", mesh, "-o", file("a.svg"), "--color", color, "--overwrite"}).code, 0);
    EXPECT_NE(readText(file("a.svg")).find("</svg>"), std::string::npos);
  }
  EXPECT_EQ(runProgram({"plot", mesh, "-o", file("b.svg"), "--bbox", "-87.49,41.60,-87.48,41.61"}).code, 0);
  EXPECT_EQ(runProgram({"plot", mesh, "-o", file("a.jpg")}).code, 4);
  EXPECT_EQ(runProgram({"plot", mesh, "-o", file("a.html"), "--color", "piece"}).code, 2);  // pieces are not marked
  EXPECT_EQ(runProgram({"plot", mesh, "-o", file("a.html"), "--color", "depth"}).code, 3);
  EXPECT_FALSE(std::filesystem::exists(file("a.html")));
  EXPECT_EQ(runProgram({"plot", mesh, "-o", file("a.html")}).code, 0);
  const std::string page = readText(file("a.html"));
  EXPECT_TRUE(page.starts_with("<!doctype html>"));
  EXPECT_TRUE(page.ends_with("</html>\n"));
  EXPECT_EQ(page.find("{{"), std::string::npos);
}

// Nothing writes to these pipes: opening one would block forever.
TEST_F(Commands, PipesThatNoFormatReadsAreRefused) {
  for (const char* const name : {"p.nc", "p.msh", "p.gpkg", "p.fgb"}) {
    ASSERT_EQ(mkfifo(file(name).c_str(), 0600), 0);
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"check", file(name)},
                                                      {"plot", file(name), "-o", file("a.svg")},
                                                      {"convert", file(name), "-o", file("a.2dm")}}) {
      const ProgramRun run = runProgram(arguments);
      EXPECT_EQ(run.code, 3) << name;
      EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
      EXPECT_NE(run.errors.find(std::string(name) + "' is a pipe"), std::string::npos) << run.errors;
    }
  }
  EXPECT_NE(runProgram({"info", file("p.nc")}).errors.find("is a pipe"), std::string::npos);
  for (const char* const option : {"--bathymetry", "--size-raster"}) {
    const ProgramRun run =
        runProgram({"mesh", lake(), option, file("p.nc"), "--size-max", "900", "-o", file("a.14"), "--quiet"});
    EXPECT_EQ(run.code, 3) << option;
    EXPECT_NE(run.errors.find("p.nc' is a pipe"), std::string::npos) << run.errors;
  }
}

// Formats that are read from beginning to end can be read through a pipe.
TEST_F(Commands, PipesThatFormatsReadAreRead) {
  ASSERT_EQ(runProgram({"mesh", lake(), "-o", file("m.14"), "--quiet"}).code, 0);
  for (const auto& [pipe, from] : {std::pair{"p.14", file("m.14")}, {"p.geojson", lake()}}) {
    ASSERT_EQ(mkfifo(file(pipe).c_str(), 0600), 0);
    const ProgramRun run = runShell("(cat '" + from + "' > '" + file(pipe) + "' &) ; \"$0\" info '" + file(pipe) + "'");
    EXPECT_EQ(run.code, 0) << run.errors;
    EXPECT_NE(run.output, "");
  }
}

TEST_F(Commands, ArchivesOnStandardInputAreRead) {
  const std::string pack = "cd '" + file("") + "' && cp '" + lake() +
                           "' a.geojson && cp a.geojson b.geojson && tar czf one.tgz a.geojson && tar czf two.tgz "
                           "a.geojson b.geojson && cat ";
  for (const char* const name : {"-", "/dev/stdin", "/vsistdin/"}) {
    const ProgramRun run = runShell(pack + "one.tgz | \"$0\" info " + name);
    EXPECT_EQ(run.code, 0) << run.errors;
  }
  const ProgramRun two = runShell(pack + "two.tgz | \"$0\" clean - -o c.gpkg");
  EXPECT_EQ(two.code, 3);
  EXPECT_EQ(
      two.errors,
      "coastmesh: error: 'standard input': holds 2 layers (a, b): name one as '/dev/stdin|a', or choose one of the "
      "input's with --layer\n");
  // GDAL has no names for all of these.
  const ProgramRun chained = runShell(pack + "one.tgz | \"$0\" info /vsitar//vsistdin/");
  EXPECT_EQ(chained.code, 3);
  EXPECT_NE(chained.errors.find("name standard input '-'"), std::string::npos) << chained.errors;
  for (const char* const named : {"'/dev/stdin|a'", "- --layer a"}) {
    const ProgramRun run = runShell(pack + "two.tgz | \"$0\" clean --overwrite -o c.gpkg " + named);
    EXPECT_EQ(run.code, 0) << run.errors;
  }
}

}  // namespace

}  // namespace coastmesh::test
