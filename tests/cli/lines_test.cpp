// Lines, regions and boundary types given by the user: every output holds them, or a warning says what it cannot hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using Json = nlohmann::json;

class NamedLines : public ProgramTest {
 protected:
  // Runs the program, expects exit code 0 and returns standard error.
  std::string done(const std::vector<std::string>& arguments) const {
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 0) << run.errors;
    return run.errors;
  }

  // A layer of the mesh in `path`, of any format.
  Json layerOf(const std::string& path, const std::string& layer) const {
    const std::string out = file("layer.geojson");
    EXPECT_EQ(runProgram({"convert", path, "-o", out, "--overwrite", "--quiet"}).code, 0);
    const std::string name = layer == "triangles" ? out : file("layer_" + layer + ".geojson");
    return std::filesystem::exists(name) ? Json::parse(readText(name))["features"] : Json::array();
  }

  std::set<std::string> valuesOf(const Json& features, const std::string& column) const {
    std::set<std::string> values;
    for (const Json& feature : features) {
      const Json& value = feature["properties"][column];
      if (!value.is_null()) values.insert(value.is_string() ? value.get<std::string>() : value.dump());
    }
    return values;
  }
};

const std::vector<std::string> kOutputs{"nc", "14", "gpkg", "msh", "2dm", "node", "vtu", "gr3", "slf"};

std::vector<std::string> outputsIn(const std::string& stem) {
  std::vector<std::string> arguments;
  for (const std::string& ending : kOutputs) {
    arguments.push_back("-o");
    arguments.push_back(stem + "." + ending);
  }
  return arguments;
}

// No output turns a weir into an ordinary line without a warning.
TEST_F(NamedLines, WeirsAreNoMereConstraints) {
  const std::string lake = inputFile("lines/lake.geojson"), weirs = inputFile("lines/weirs.geojson");
  const auto meshed = [&](const std::string& option, const std::string& stem) {
    std::vector<std::string> arguments{"mesh", lake, option, weirs};
    for (const std::string& argument : outputsIn(file(stem))) arguments.push_back(argument);
    return done(arguments);
  };
  const std::string said = meshed("--weirs", "weir");
  meshed("--constraints", "plain");
  for (const std::string& ending : kOutputs) {
    const std::string name = file("weir." + ending);
    const bool told = said.find("'" + name + "' cannot hold 1 weir") != std::string::npos;
    const bool differs = readText(name) != readText(file("plain." + ending)) ||
                         (ending == "node" && readText(file("weir.poly")) != readText(file("plain.poly")));
    EXPECT_NE(told, differs) << ending;
  }
  for (const std::string ending : {"nc", "gpkg", "msh", "vtu"}) {
    const Json lines = layerOf(file("weir." + ending), "lines");
    ASSERT_EQ(lines.size(), 1u) << ending;
    EXPECT_EQ(valuesOf(lines, "kind"), std::set<std::string>{"weir"}) << ending;
    EXPECT_EQ(valuesOf(lines, "name"), std::set<std::string>{"w1"}) << ending;
    // The line is complete, from its first point to its last.
    const Json& points = lines[0]["geometry"]["coordinates"];
    EXPECT_EQ(points.front(), Json::parse("[-87.9, 47.55]")) << ending;
    EXPECT_EQ(points.back(), Json::parse("[-87.7, 47.6]")) << ending;
  }
  EXPECT_EQ(valuesOf(layerOf(file("weir.2dm"), "lines"), "kind"), std::set<std::string>{"weir"});
  EXPECT_EQ(valuesOf(layerOf(file("weir.node"), "lines"), "kind"), std::set<std::string>{"weir"});
}

TEST_F(NamedLines, TheReportCountsThemAndSaysWhatIsLost) {
  done({"mesh", inputFile("lines/lake.geojson"), "--weirs", inputFile("lines/weirs.geojson"), "--regions",
        inputFile("lines/regions.geojson"), "-o", file("a.14"), "-o", file("a.nc"), "--report", file("a.json")});
  const Json report = Json::parse(readText(file("a.json")));
  EXPECT_EQ(report["lines"], Json::parse(R"({"constraint": 0, "weir": 1, "region_border": 2})"));
  ASSERT_EQ(report["output_warnings"].size(), 2u);  // the other: no depths
  EXPECT_NE(report["output_warnings"][0].get<std::string>().find("a.14' cannot hold the names of 2 regions; 1 weir and "
                                                                 "2 borders of regions"),
            std::string::npos)
      << report["output_warnings"][0];
}

TEST_F(NamedLines, RegionsComeThroughEveryFormatThatHoldsThem) {
  done({"mesh", inputFile("lines/lake.geojson"), "--regions", inputFile("lines/regions.geojson"), "-o", file("a.gpkg"),
        "--quiet"});
  const Json wanted = layerOf(file("a.gpkg"), "triangles");
  EXPECT_EQ(valuesOf(wanted, "region"), (std::set<std::string>{"north", "south"}));
  EXPECT_EQ(valuesOf(wanted, "name"), std::set<std::string>{"lake"});
  const auto columnOf = [](const Json& features, const char* column) {
    std::vector<std::string> values;
    for (const Json& feature : features) values.push_back(feature["properties"][column].dump());
    return values;
  };
  for (const std::string ending : {"nc", "msh", "2dm", "vtu", "gpkg", "shp", "fgb"}) {
    const std::string path = file("through." + ending);
    done({"convert", file("a.gpkg"), "-o", path, "--quiet"});
    EXPECT_EQ(columnOf(layerOf(path, "triangles"), "region"), columnOf(wanted, "region")) << ending;
  }
  done({"convert", file("a.gpkg"), "-o", file("b.gpkg"), "--quiet"});
  EXPECT_TRUE(readText(file("a.gpkg")) == readText(file("b.gpkg")));
}

// Bands of latitudes round the globe, drawn with a point at each corner of the map.
TEST_F(NamedLines, RegionsRoundTheGlobe) {
  const auto band = [](double south, double north) {
    return LonLatRing{{-180, south}, {180, south}, {180, north}, {-180, north}};
  };
  const std::string regions = write("bands.geojson", geoJsonPolygons({{band(-90, -60)}, {band(-20, 20)}}));
  done({"mesh", "--domain", "globe", "--size", "600000", "--regions", regions, "-o", file("a.gpkg"), "--quiet"});
  std::map<std::string, double> area_m2;
  for (const Json& triangle : layerOf(file("a.gpkg"), "triangles"))
    area_m2[triangle["properties"]["region"].dump()] += triangle["properties"]["area_m2"].get<double>();
  ASSERT_EQ(area_m2.size(), 3u);
  const double globe = 5.10065621724e14;
  // Shares of the ellipsoid, of which its flattening moves less than a hundredth.
  const auto share = [](double south, double north) {
    return (std::sin(north * M_PI / 180) - std::sin(south * M_PI / 180)) / 2;
  };
  EXPECT_NEAR(area_m2["\"part 0\""] / globe / share(-90, -60), 1, 0.015);
  EXPECT_NEAR(area_m2["\"part 1\""] / globe / share(-20, 20), 1, 0.015);
  const std::string bands = write("north.geojson", geoJsonPolygons({{band(60, 80)}}));
  EXPECT_NE(
      runProgram({"mesh", bands, "-o", file("b.gpkg")}).errors.find("its edge from -180, 60 to 180, 60 goes once"),
      std::string::npos);
  done({"mesh", bands, "--edges", "lonlat", "--size", "300000", "-o", file("b.gpkg"), "--quiet"});
  double north_m2 = 0;
  for (const Json& triangle : layerOf(file("b.gpkg"), "triangles"))
    north_m2 += triangle["properties"]["area_m2"].get<double>();
  EXPECT_NEAR(north_m2 / globe / share(60, 80), 1, 0.015);
}

// Two regions have two colours, or one if they have the same name.
TEST_F(NamedLines, PlotColoursRegionsByTheirNames) {
  const auto coloursOf = [&](const std::string& regions) {
    done({"mesh", inputFile("lines/lake.geojson"), "--regions", write("regions.geojson", regions), "-o", file("a.nc"),
          "--quiet", "--overwrite"});
    done({"plot", file("a.nc"), "-o", file("a.svg"), "--color", "region", "--overwrite"});
    const std::string text = readText(file("a.svg"));
    std::set<std::string> colours;
    for (std::size_t at = text.find("fill:rgb"); at != std::string::npos; at = text.find("fill:rgb", at + 1))
      colours.insert(text.substr(at, text.find(')', at) - at));
    return colours.size();
  };
  std::string regions = readText(inputFile("lines/regions.geojson"));
  const std::size_t apart = coloursOf(regions);
  regions.replace(regions.find("south"), 5, "north");
  EXPECT_EQ(coloursOf(regions) + 1, apart);
}

TEST_F(NamedLines, ConvertSaysWhatAFileCannotHold) {
  const std::string mesh = inputFile("lines/weir.14");
  const auto said = [&](const std::string& name) { return done({"convert", mesh, "-o", file(name), "--quiet"}); };
  EXPECT_EQ(said("same.14"), "");
  EXPECT_NE(readText(file("same.14")).find("\n31 12 1 1 1\n2 11 1.5 1 1\n34 10 2 1 1\n"), std::string::npos);
  for (const std::string name :
       {"a.gr3", "a.nc", "a.2dm", "a.msh", "a.vtu", "a.gpkg", "a.node", "a.geojson", "a.fgb", "a.slf", "a_grd.dat"}) {
    const std::string text = said(name);
    EXPECT_NE(text.find("cannot hold"), std::string::npos) << name << ": " << text;
    EXPECT_NE(text.find("heights and nodes across of 1 weir"), std::string::npos) << name << ": " << text;
    EXPECT_EQ(std::ranges::count(text, '\n'), 1) << name << ": " << text;
  }
  EXPECT_EQ(valuesOf(layerOf(file("a.nc"), "boundaries"), "ibtype"), std::set<std::string>{"24"});
}

// A cleaned file has all data of its inputs and gives the same mesh as they do.
TEST_F(NamedLines, CleanedFilesHoldAllOfTheInput) {
  const std::vector<std::string> given{inputFile("lines/lake.geojson"), "--weirs", inputFile("lines/weirs.geojson"),
                                       "--regions", inputFile("lines/regions.geojson")};
  const auto run = [&](std::vector<std::string> arguments, const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    done(arguments);
  };
  run({"clean", "-o", file("cleaned.gpkg"), "--quiet"}, given);
  run({"mesh", "-o", file("direct.gpkg"), "--quiet"}, given);
  done({"mesh", file("cleaned.gpkg"), "-o", file("then.gpkg"), "--quiet"});
  // The cleaned file has extra points where lines cross, so the centre of its projection differs in the last bits.
  const Json direct = layerOf(file("direct.gpkg"), "triangles"), then = layerOf(file("then.gpkg"), "triangles");
  ASSERT_EQ(direct.size(), then.size());
  for (std::size_t t = 0; t < direct.size(); ++t) {
    for (const char* const key : {"src_fid", "source", "name", "region", "node1", "node2", "node3"})
      EXPECT_EQ(direct[t]["properties"][key], then[t]["properties"][key]) << t << " " << key;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t axis = 0; axis < 2; ++axis)
        EXPECT_NEAR(direct[t]["geometry"]["coordinates"][0][k][axis].get<double>(),
                    then[t]["geometry"]["coordinates"][0][k][axis].get<double>(), 1e-12);
  }
  EXPECT_EQ(valuesOf(layerOf(file("then.gpkg"), "triangles"), "region"), (std::set<std::string>{"north", "south"}));
  EXPECT_EQ(valuesOf(layerOf(file("then.gpkg"), "lines"), "name"), (std::set<std::string>{"w1", "north", "south"}));
  done({"clean", file("cleaned.gpkg"), "-o", file("again.gpkg"), "--quiet"});
  EXPECT_TRUE(readText(file("cleaned.gpkg")) == readText(file("again.gpkg")));
}

// A column of boundary types is kept like the other attributes.
TEST_F(NamedLines, CleanedFilesHoldTypesOfBoundaries) {
  std::string lake = readText(inputFile("lines/lake.geojson"));
  lake.replace(lake.find("\"id\": 1"), 7, "\"type\": \"river\"");
  const std::string input = write("rivers.geojson", lake);
  done({"clean", input, "-o", file("cleaned.gpkg"), "--quiet"});
  done({"mesh", file("cleaned.gpkg"), "--boundary-column", "type", "-o", file("then.nc"), "--quiet"});
  done({"mesh", input, "--boundary-column", "type", "-o", file("direct.nc"), "--quiet"});
  EXPECT_TRUE(readText(file("direct.nc")) == readText(file("then.nc")));
  EXPECT_EQ(valuesOf(layerOf(file("then.nc"), "boundaries"), "role"), std::set<std::string>{"river"});
}

// Types of single lines that are joined into one shore need no option when read from a cleaned file.
TEST_F(NamedLines, CleanedFilesHoldTypesOfLines) {
  const auto line = [](const std::string& type, const std::string& points) {
    return R"({"type": "Feature", "properties": {"type": ")" + type +
           R"("}, "geometry": {"type": "LineString", "coordinates": )" + points + "}}";
  };
  const std::string input =
      write("lines.geojson", R"({"type": "FeatureCollection", "features": [)" + line("river", "[[0, 0], [0, 0.1]]") +
                                 "," + line("10", "[[0, 0.1], [0.1, 0.1]]") + "," +
                                 line("land", "[[0.1, 0.1], [0.1, 0], [0, 0]]") + "]}");
  done({"mesh", input, "--boundary-column", "type", "-o", file("direct.gpkg"), "--quiet"});
  done({"clean", input, "--boundary-column", "type", "-o", file("cleaned.gpkg"), "--quiet"});
  done({"mesh", file("cleaned.gpkg"), "-o", file("then.gpkg"), "--quiet"});
  const Json boundary = layerOf(file("then.gpkg"), "boundaries");
  EXPECT_EQ(valuesOf(boundary, "role"), (std::set<std::string>{"land", "river"}));
  EXPECT_EQ(valuesOf(boundary, "ibtype"), std::set<std::string>{"10"});
  EXPECT_EQ(boundary, layerOf(file("direct.gpkg"), "boundaries"));
  done({"clean", file("cleaned.gpkg"), "-o", file("again.gpkg"), "--quiet"});
  EXPECT_TRUE(readText(file("cleaned.gpkg")) == readText(file("again.gpkg")));
}

}  // namespace

}  // namespace coastmesh::test
