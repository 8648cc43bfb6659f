// Meshes with unusual coordinates: across ±180, at a pole, with triangles a quarter of the globe wide, without
// longitudes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

struct Point2 {
  double x, y;
};

class Coordinates : public ProgramTest {
 protected:
  std::string ring(const std::string& name, const LonLatRing& ring) const {
    return write(name, geoJsonPolygons({{ring}}));
  }
  // A lake of two halves, cut at the antimeridian, with an island.
  std::string lakeAt180() const {
    return write("lake.geojson",
                 geoJsonPolygons({{{{-180.0, 65.30}, {-179.85, 65.31}, {-179.9, 65.36}, {-180.0, 65.34}},
                                   {{-179.95, 65.32}, {-179.93, 65.32}, {-179.94, 65.33}}},
                                  {{{180.0, 65.30}, {180.0, 65.34}, {179.91, 65.35}, {179.9, 65.31}}}}));
  }
  std::string polarCap() const {
    LonLatRing cap;
    for (int lon = -180; lon < 180; lon += 10) cap.emplace_back(lon, 75.0);
    return ring("lake.geojson", cap);
  }
  // Spikes 87 degrees long, with angles of 0.2 to 0.3 degrees at their tips.
  std::string spikes() const {
    return ring(
        "lake.geojson",
        {{0, 47.5}, {-87.07, 47.25}, {-87.25, 0}, {-88, 47.5}, {0, 47.75}, {-87.5, 48}, {0, 47.93}, {-87, 47.5}});
  }
  // A concave shore in metres.
  LonLatRing inMetres(double x, double y) const {
    return {{x, y}, {x + 4000, y}, {x + 4000, y + 5000}, {x + 2000, y + 1000}, {x + 300, y + 5000}, {x, y + 5000}};
  }

  // The mesh as .2dm text with all digits, nodes and triangles in their order.
  std::string textOf(const std::string& mesh) const {
    const ProgramRun run = runProgram({"convert", mesh, "-o", file("text.2dm"), "--overwrite", "--quiet"});
    EXPECT_EQ(run.code, 0) << run.errors;
    return readText(file("text.2dm"));
  }
  Json infoOf(const std::string& mesh) const {
    const ProgramRun run = runProgram({"info", mesh, "--json"});
    EXPECT_EQ(run.code, 0) << run.errors;
    return Json::parse(run.output);
  }

  // Expects the same mesh in every layer format as in the .nc; `code`: exit code of `mesh` and `check`.
  void expectAlikeInLayers(const std::string& input, int code) const {
    std::vector<std::string> arguments{"mesh", input, "--dissolve", "-o", file("m.nc"), "--quiet"};
    for (const char* ending : {"gpkg", "shp", "geojson", "fgb"}) {
      arguments.insert(arguments.end(), {"-o", file(std::string("m_") + ending + "." + ending)});
    }
    const ProgramRun run = runProgram(arguments);
    ASSERT_EQ(run.code, code) << run.errors;
    const Json told = infoOf(file("m.nc"));
    for (const char* ending : {"gpkg", "shp", "geojson", "fgb"}) {
      SCOPED_TRACE(ending);
      const std::string mesh = file(std::string("m_") + ending + "." + ending);
      EXPECT_EQ(runProgram({"check", mesh}).code, code);
      EXPECT_EQ(textOf(mesh), textOf(file("m.nc")));
      const Json info = infoOf(mesh);
      const double area = told["area_m2"];  // longitudes past 180 may have fewer digits
      EXPECT_NEAR(info["area_m2"].get<double>(), area, 1e-12 * area);
      EXPECT_EQ(info["boundaries"], told["boundaries"]);
    }
    EXPECT_EQ(runProgram({"check", file("m.nc")}).code, code);
  }
};

TEST_F(Coordinates, LayersAcross180) { expectAlikeInLayers(lakeAt180(), 0); }

TEST_F(Coordinates, LayersAroundAPole) { expectAlikeInLayers(polarCap(), 0); }

// All readers and checks agree on which shore is an island, with or without roles in the file.
TEST_F(Coordinates, IslandsAcross180AndAtAPoleAreIslands) {
  LonLatRing cap, hole;
  for (int lon = -180; lon < 180; lon += 20) cap.emplace_back(lon, 70.0), hole.emplace_back(-lon, 85.0);
  const std::string polar = write("polar.geojson", geoJsonPolygons({{cap, hole}}));
  for (const std::string& input : {lakeAt180(), polar}) {
    SCOPED_TRACE(input);
    std::vector<std::string> arguments{"mesh", input, "--dissolve", "--overwrite", "--quiet"};
    const std::vector<std::string> outputs{"m.14",      "m.gr3", "m.slf", "m_grd.dat",
                                           "m_ww3.msh", "m.2dm", "m.msh", "m.nc"};
    for (const std::string& output : outputs) arguments.insert(arguments.end(), {"-o", file(output)});
    ASSERT_EQ(runProgram(arguments).code, 0);
    // Without names Gmsh's curves have no roles.
    std::string unnamed = readText(file("m.msh"));
    const std::size_t begin = unnamed.find("$PhysicalNames"), end = unnamed.find("$EndPhysicalNames");
    ASSERT_NE(end, std::string::npos);
    unnamed.erase(begin, unnamed.find('\n', end) + 1 - begin);
    write("unnamed.msh", unnamed);
    std::filesystem::copy_file(file("m.prj"), file("unnamed.prj"), std::filesystem::copy_options::overwrite_existing);
    const std::vector<const char*> meshes{"m.14",  "m.gr3", "m.slf",       "m_grd.dat", "m_ww3.msh",
                                          "m.2dm", "m.msh", "unnamed.msh", "m.nc"};
    std::map<std::string, Json> told;
    for (const char* name : meshes) told[name] = infoOf(file(name))["boundaries"];
    for (const char* name : meshes) {
      const Json& boundaries = told[name];
      // ADCIRC and SCHISM files split an outer shore into two segments.
      const bool in_two = std::string(name).ends_with(".14") || std::string(name).ends_with(".gr3");
      EXPECT_EQ(boundaries["land"], in_two ? 2 : 1) << name << boundaries;
      EXPECT_EQ(boundaries["island"], 1) << name << boundaries;
    }
    for (const char* model : {"adcirc", "schism"}) {
      const ProgramRun check = runProgram({"check", file("m.14"), "--target", model});
      EXPECT_EQ(check.output.find("shore"), std::string::npos) << check.output;
    }
    // Without .prj files only --assume-crs says that coordinates are degrees.
    for (const std::string& name : names())
      if (name.ends_with(".prj")) std::filesystem::remove(file(name));
    for (const char* name : {"m_grd.dat", "m_ww3.msh", "m.2dm", "unnamed.msh", "m.slf"}) {
      const ProgramRun assumed = runProgram({"info", file(name), "--json", "--assume-crs", "EPSG:4326"});
      EXPECT_EQ(Json::parse(assumed.output)["boundaries"], told[name]) << name << assumed.errors;
    }
  }
}

// A triangle between the spikes' sides is turned over on the ground; `mesh` and `check` report it.
TEST_F(Coordinates, TrianglesTurnedOverOnTheGroundAreTold) {
  expectAlikeInLayers(spikes(), 1);
  const ProgramRun run =
      runProgram({"mesh", file("lake.geojson"), "-o", file("s.nc"), "--report", file("s.json"), "--quiet"});
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.errors.find("not counter-clockwise on the ground"), std::string::npos) << run.errors;
  const Json turned = Json::parse(readText(file("s.json")))["mesh"]["turned"];
  ASSERT_GE(turned["count"], 1);
  EXPECT_EQ(turned["places"].size(), turned["count"]);
  const Json place = turned["places"][0];
  EXPECT_TRUE(place["lon"] > -87 && place["lon"] < 0 && place["lat"] > 47 && place["lat"] < 60) << place;
}

// In a plane that the user chose and that ends at ±180, the two halves of a lake there are at opposite ends.
TEST_F(Coordinates, ACrsThatTearsTheInputIsRefused) {
  const std::string lake = ring("across.geojson", {{179.9, 10}, {-179.8, 10}, {-179.8, 10.3}, {179.9, 10.3}});
  for (const char* crs : {"EPSG:4326", "EPSG:3857"}) {
    const ProgramRun run = runProgram({"mesh", lake, "--crs", crs, "-o", file("m.nc"), "--quiet"});
    EXPECT_EQ(run.code, 3) << crs << run.errors;
    EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
    for (const char* part : {"across.geojson', feature 0", crs, "tears it apart between", "leave out --crs"})
      EXPECT_NE(run.errors.find(part), std::string::npos) << run.errors;
    EXPECT_FALSE(names().contains("m.nc"));
  }
  // In a CRS for the Pacific the same lake is in one piece.
  ASSERT_EQ(runProgram({"mesh", lake, "-o", file("whole.nc"), "--quiet"}).code, 0);
  const ProgramRun pacific = runProgram({"mesh", lake, "--crs", "EPSG:3832", "-o", file("pacific.nc"), "--quiet"});
  ASSERT_EQ(pacific.code, 0) << pacific.errors;
  const double area = infoOf(file("whole.nc"))["area_m2"];
  EXPECT_NEAR(infoOf(file("pacific.nc"))["area_m2"].get<double>(), area, 1e-4 * area);
}

TEST_F(Coordinates, ACrsThatShowsAWideInputInOnePieceIsTaken) {
  // Spans the map from end to end, with edges half as wide as the map, an island, and latitudes up to 89.
  const std::string belt = write(
      "belt.geojson",
      geoJsonPolygons({{{{-180, -60}, {0, -60}, {180, -60}, {180, 89}, {-180, 60}}, {{-60, 0}, {60, 0}, {0, 40}}}}));
  for (const char* crs : {"EPSG:4326", "EPSG:3857", "ESRI:54001"}) {
    const ProgramRun run = runProgram({"mesh", belt, "--crs", crs, "-o", file("m.2dm"), "--overwrite", "--quiet"});
    EXPECT_LE(run.code, 1) << crs << run.errors;
  }
}

// Angles in a plane that is not conformal differ from those on the ground.
TEST_F(Coordinates, ACrsThatDistortsShapesIsWarnedOf) {
  const std::string lake = ring("lake.geojson", {{10, 56}, {10.5, 56}, {10.5, 56.3}, {10, 56.3}});
  const std::string far = ring("far.geojson", {{-30, 40}, {-29, 40}, {-29, 41}, {-30, 41}});
  const auto mesh = [&](const std::string& input, const char* crs) {
    return runProgram({"mesh", input, "--crs", crs, "-o", file("m.nc"), "--overwrite", "--quiet"});
  };
  for (const char* crs : {"EPSG:32632", "EPSG:3857", "EPSG:3035"}) {
    const ProgramRun run = mesh(lake, crs);
    EXPECT_EQ(run.code, 0) << crs << run.errors;
    EXPECT_EQ(run.errors, "") << crs;
  }
  // Equal-area maps far from where they keep shapes, longitudes and latitudes, and degrees as metres.
  for (const auto& [input, crs] : {std::pair{far, "EPSG:3035"}, std::pair{lake, "EPSG:4326"},
                                   std::pair{lake, "ESRI:54001"}, std::pair{lake, "EPSG:6933"}}) {
    const ProgramRun run = mesh(input, crs);
    EXPECT_EQ(run.code, 0) << crs << run.errors;
    for (const char* part : {"warning: --crs: ", crs, " distorts shapes: at ", " % with their direction",
                             "degrees from those on the ground", "leave out --crs"})
      EXPECT_NE(run.errors.find(part), std::string::npos) << run.errors;
    EXPECT_EQ(std::ranges::count(run.errors, '\n'), 1) << run.errors;
  }
}

// Mercator coordinates continue past the antimeridian, as in the input.
TEST_F(Coordinates, MetresGoOnPastTheAntimeridian) {
  for (const double turn : {0.0, -40075016.685578488}) {
    std::string text = R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:3857"}},)";
    std::ostringstream corners;
    corners.precision(17);
    const double west = 19e6 + turn, east = 21e6 + turn;
    corners << '[' << west << ",6e6],[" << east << ",6e6],[" << east << ",7e6],[" << west << ",7e6],[" << west
            << ",6e6]";
    text += R"("features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[)" +
            corners.str() + "]]}}]}";
    const std::string input = write("lake.geojson", text);
    const ProgramRun run =
        runProgram({"mesh", input, "-o", file("m.2dm"), "--size", "100000", "--overwrite", "--quiet"});
    ASSERT_EQ(run.code, 0) << run.errors;
    EXPECT_NE(run.errors.find("1.47 to 1.67 times"), std::string::npos) << run.errors;
    EXPECT_EQ(run.errors.find('\n'), run.errors.rfind('\n')) << run.errors;
    std::istringstream lines(readText(file("m.2dm")));
    std::size_t nodes = 0;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string word;
      double number, x, y;
      if (!(words >> word >> number >> x >> y) || word != "ND") continue;
      ++nodes;
      EXPECT_TRUE(x >= west - 1e-6 && x <= east + 1e-6) << line;
    }
    EXPECT_GT(nodes, 50u);
  }
}

// Points within the snap distance are merged, even if they belong to different features.
TEST_F(Coordinates, FeaturesASmallGapApartAreSnapped) {
  const double gap = 1e-9;  // degrees: a tenth of a millimetre
  const std::string sheets =
      write("sheets.geojson", geoJsonPolygons({{{{10, 50}, {10.1, 50}, {10.1, 50.1}, {10, 50.1}}},
                                               {{{10.1 + gap, 50}, {10.2, 50}, {10.2, 50.1}, {10.1 + gap, 50.1}}}}));
  const auto piecesOf = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"mesh", sheets, "-o", file("m.nc"), "--overwrite", "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramRun run = runProgram(words);
    EXPECT_EQ(run.code, 0) << run.errors;
    return infoOf(file("m.nc"))["pieces"].get<int>();
  };
  EXPECT_EQ(piecesOf({}), 1);
  EXPECT_EQ(piecesOf({"--dissolve", "--snap", "1"}), 1);
  EXPECT_EQ(piecesOf({"--snap", "0"}), 2);
}

// GDAL's own messages about it are suppressed.
TEST_F(Coordinates, HeightsAloneAreRefusedInOneLine) {
  const std::string input = write(
      "heights.geojson",
      R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:5711"}},"features":[{"type":)"
      R"("Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9],[0,0]]]}}]})");
  const ProgramRun run = runProgram({"mesh", input, "-o", file("m.nc")});
  EXPECT_EQ(run.code, 3) << run.errors;
  EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
  EXPECT_NE(run.errors.find("has no longitudes and latitudes"), std::string::npos) << run.errors;
}

TEST_F(Coordinates, OceanAndLandAreTheTwoSidesOfAllCoasts) {
  const std::string land =
      write("land.geojson",
            geoJsonPolygons({{{{-20, -30}, {40, -25}, {30, 35}, {-15, 30}}}, {{{100, 10}, {140, 0}, {120, 40}}}}));
  const auto mesh = [&](const std::string& input, std::vector<std::string> options) {
    options.insert(options.begin(), {"mesh", input, "--size", "400000", "-o", file("m.2dm"), "--overwrite"});
    return runProgram(options);
  };
  for (const auto& [name, longer] :
       {std::pair<std::string, std::vector<std::string>>{"ocean", {"--domain", "outside", "--bbox=-180,-90,180,90"}},
        {"land", {"--domain", "auto"}}}) {
    ASSERT_EQ(mesh(land, longer).code, 0);
    const std::string text = readText(file("m.2dm"));
    const ProgramRun run = mesh(land, {"--domain", name});
    ASSERT_EQ(run.code, 0) << run.errors;
    EXPECT_EQ(run.errors.find("--domain"), std::string::npos) << run.errors;
    EXPECT_EQ(readText(file("m.2dm")), text) << name;
    EXPECT_EQ(mesh(land, {"--domain", name, "--bbox=0,0,10,10"}).code, 2);
  }
  const std::string plane = ring("plane.geojson", {{0, 0}, {1000, 0}, {0, 1000}});
  const ProgramRun run = mesh(plane, {"--domain", "ocean", "--crs", "plane"});
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.errors.find("--domain ocean takes longitudes"), std::string::npos) << run.errors;
}

// A plane can show the whole globe except for a place on an island, anywhere, if the island measures a degree or more.
TEST_F(Coordinates, TheGlobeLessAnIsland) {
  const auto mesh = [&](const Point2& at, double side, std::vector<std::string> options) {
    const std::string island =
        ring("island.geojson", {{at.x, at.y}, {at.x + side, at.y}, {at.x + side, at.y + side}, {at.x, at.y + side}});
    options.insert(options.begin(), {"mesh", island, "--domain", "outside", "--size", "500000", "-o", file("globe.nc"),
                                     "--overwrite", "--quiet"});
    return runProgram(options);
  };
  const std::string all = "--bbox=-180,-90,180,90";
  for (const Point2& at : {Point2{33.3, 27.2}, Point2{-101.7, -13.1}, Point2{178.1, 61.3}}) {
    const ProgramRun run = mesh(at, 1.7, {all});
    EXPECT_EQ(run.code, 0) << at.x << run.errors;
    const Json info = infoOf(file("globe.nc"));
    // Square metres of WGS 84, less the island's.
    EXPECT_NEAR(info["area_m2"].get<double>(), 5.10065e14 - 3.5e10 * std::cos(at.y * 0.01745), 2e-3 * 5.1e14);
    EXPECT_EQ(info["boundaries"]["island"], 1) << info["boundaries"];
    EXPECT_EQ(runProgram({"check", file("globe.nc"), "--target", "schism"}).output.find("shore"), std::string::npos);
  }
  const ProgramRun small = mesh({33.3, 27.2}, 0.2, {all});
  EXPECT_EQ(small.code, 3);
  EXPECT_TRUE(isOneErrorLine(small.errors));
  EXPECT_NE(small.errors.find("--bbox=-180,-85,180,90"), std::string::npos) << small.errors;
  const ProgramRun advised = mesh({33.3, 27.2}, 0.2, {"--bbox=-180,-85,180,90"});
  EXPECT_EQ(advised.code, 0) << advised.errors;
}

// Metres in place of GeoJSON's longitudes: taken as a plane with --crs plane.
TEST_F(Coordinates, MetresInAPlane) {
  for (const double at : {0.0, 1000.0, 448123.0, -5e6}) {
    SCOPED_TRACE(at);
    const std::string input = ring("metres.geojson", inMetres(at, 2 * at));
    const ProgramRun run = runProgram({"mesh", input, "--crs", "plane", "--size-max", "500", "-o", file("m.nc"), "-o",
                                       file("m.gpkg"), "-o", file("m.2dm"), "--overwrite", "--quiet"});
    ASSERT_EQ(run.code, 0) << run.errors;
    EXPECT_NE(run.errors.find("metres in a plane"), std::string::npos) << run.errors;
    for (const char* name : {"m.nc", "m.gpkg", "m.2dm"}) {
      const ProgramRun check = runProgram({"check", file(name), "--input", input, "--crs", "plane"});
      EXPECT_EQ(check.code, 0) << name << check.output << check.errors;
      const Json info = infoOf(file(name));
      EXPECT_EQ(info["crs"], "plane");
      EXPECT_NEAR(info["area_m2"].get<double>(), 12.6e6, 1.0) << name;
      EXPECT_GT(info["nodes"], 50);
    }
  }
}

// A flume of 3 m by 1 m in a file without a CRS: with --crs plane no degrees of WGS 84, in the mesh neither.
TEST_F(Coordinates, SmallPlanesWithoutACrs) {
  const std::string flume = write("flume.csv", "id,WKT\n1,\"POLYGON((0 0,3 0,3 1,0 1,0 0))\"\n");
  const ProgramRun run = runProgram({"mesh", flume, "--crs", "plane", "--size", "0.2", "-o", file("m.gpkg")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_EQ(run.errors, "");
  EXPECT_THAT(run.output, HasSubstr("'" + flume + "': does not say its CRS; taken as metres in a plane"));
  EXPECT_EQ(infoOf(file("m.gpkg"))["crs"], "plane");
  // GeoJSON always says that it is in degrees; then both are taken as they are in the CRS that it says.
  const std::string point = write("point.geojson", R"({"type":"Point","coordinates":[1.5,0.5]})");
  EXPECT_EQ(
      runProgram({"mesh", flume, "--constraints", point, "--crs", "plane", "--size", "0.2", "-o", file("p.gpkg")}).code,
      0);
  EXPECT_THAT(runProgram({"info", flume}).output, HasSubstr("taken for longitudes and latitudes on WGS 84"));
}

TEST_F(Coordinates, MetresThatAreSaidToBeDegreesAreRefused) {
  const std::string input = ring("metres.geojson", inMetres(1000, 2000));
  const ProgramRun run = runProgram({"mesh", input, "-o", file("m.nc"), "--quiet"});
  EXPECT_EQ(run.code, 3);
  EXPECT_TRUE(isOneErrorLine(run.errors));
  EXPECT_NE(run.errors.find("metres.geojson"), std::string::npos) << run.errors;
  const ProgramRun other = runProgram({"mesh", input, "--crs", "EPSG:3857", "-o", file("m.nc"), "--quiet"});
  EXPECT_EQ(other.code, 3) << other.errors;
  EXPECT_NE(other.errors.find("metres.geojson"), std::string::npos) << other.errors;
}

TEST_F(Coordinates, FeetInAPlaneAreWarnedOf) {
  const std::string input =
      write("feet.geojson",
            R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::2263"}},)"
            R"("features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":)"
            R"([[[980000,190000],[990000,190000],[990000,200000],[980000,200000],[980000,190000]]]}}]})");
  const auto errorsWith = [&](const std::string& crs) {
    return runProgram({"mesh", input, "--crs", crs, "--size", "900", "-o", file("m.nc"), "--overwrite", "--quiet"})
        .errors;
  };
  EXPECT_NE(errorsWith("plane").find("US survey foot: lengths, as of --size, have that unit"), std::string::npos);
  EXPECT_EQ(errorsWith("auto"), "");
}

// In Mercator's plane the south of this box is less enlarged than its centre.
TEST_F(Coordinates, TheLargestSizeHoldsOnTheGroundInAnyPlane) {
  const std::string input = ring("north.geojson", {{10, 40}, {11, 40}, {11, 65}, {10, 65}});
  ASSERT_EQ(runProgram({"mesh", input, "--crs", "EPSG:3857", "--size-max", "20000", "-o", file("m.nc")}).code, 0);
  EXPECT_LE(infoOf(file("m.nc"))["longest_edge_m"].get<double>(), 20000.0);
}

TEST_F(Coordinates, JsonMayHoldACoastline) {
  const std::string input = ring("lake.json", {{10, 40}, {11, 40}, {11, 41}, {10, 41}});
  const ProgramRun run = runProgram({"info", input});
  EXPECT_EQ(run.code, 0) << run.errors;
}

// Degrees taken as a plane keep their CRS, and their longitudes in any revolution.
TEST_F(Coordinates, DegreesInAPlane) {
  const std::string input = ring("wide.geojson", {{-10, 0}, {400, 0}, {400, 50}, {200, 20}, {-10, 50}});
  const ProgramRun run =
      runProgram({"mesh", input, "--crs", "plane", "--size-max", "20", "-o", file("m.2dm"), "--quiet"});
  ASSERT_LE(run.code, 1) << run.errors;
  std::istringstream text(readText(file("m.2dm")));
  double least = 0, greatest = 0;
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with("ND ")) continue;
    std::istringstream words(line.substr(3));
    double number = 0, x = 0;
    words >> number >> x;
    least = std::min(least, x), greatest = std::max(greatest, x);
  }
  EXPECT_EQ(least, -10);
  EXPECT_EQ(greatest, 400);
  EXPECT_EQ(infoOf(file("m.2dm"))["crs"], "EPSG:4326");
}

// Every format refuses coordinates that are not on Earth when they are read, so that no unreadable output is written.
TEST_F(Coordinates, NodesOffTheEarthAreRefused) {
  const std::string two_dm = "MESH2D\nE3T 1 1 2 3 1\nND 1 0 0 0\nND 2 1e9 0 0\nND 3 0 1 0\n";
  const std::string gmsh =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1e9 0 0\n3 0 1 0\n$EndNodes\n$Elements\n1\n"
      "1 2 2 0 1 1 2 3\n$EndElements\n";
  const std::string adcirc = "title\n1 3\n1 0 0 1\n2 1 95 1\n3 0 1 1\n1 3 1 2 3\n0\n0\n0\n0\n";
  const auto feature = R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":)"
                       R"({"type":"Polygon","coordinates":[[[0,0],[1e9,0],[0,1],[0,0]]]}}]})";
  for (const auto& [name, text] : std::map<std::string, std::string>{
           {"m.2dm", two_dm}, {"m.msh", gmsh}, {"m.14", adcirc}, {"m.geojson", feature}}) {
    SCOPED_TRACE(name);
    const std::string mesh = write(name, text);
    const std::vector<std::string> crs =
        name == "m.geojson" ? std::vector<std::string>{} : std::vector<std::string>{"--assume-crs", "EPSG:4326"};
    for (std::vector<std::string> arguments : std::vector<std::vector<std::string>>{
             {"convert", mesh, "-o", file("o.gpkg")}, {"check", mesh}, {"plot", mesh, "-o", file("o.svg")}}) {
      arguments.insert(arguments.end(), crs.begin(), crs.end());
      const ProgramRun run = runProgram(arguments);
      EXPECT_EQ(run.code, 3) << arguments[0] << run.output;
      EXPECT_TRUE(isOneErrorLine(run.errors));
      EXPECT_NE(run.errors.find(name), std::string::npos) << run.errors;
      EXPECT_NE(run.errors.find("node 2"), std::string::npos) << run.errors;
    }
  }
  EXPECT_EQ(names().count("o.gpkg"), 0u);
}

TEST_F(Coordinates, LatitudesBeforeLongitudesAreNamed) {
  const auto errorOf = [this](const std::string& corner) {
    const std::string path = write("s.geojson", R"({"type":"Polygon","coordinates":[[)" + corner +
                                                    R"(,[60.5,-150],[60.5,-149],)" + corner + "]]}");
    const ProgramRun run = runProgram({"mesh", path, "-o", file("o.nc")});
    EXPECT_EQ(run.code, 3);
    EXPECT_TRUE(isOneErrorLine(run.errors));
    return run.errors;
  };
  EXPECT_NE(errorOf("[60,-150]").find("latitude and longitude swapped"), std::string::npos);
  EXPECT_NE(errorOf("[500000,4200000]").find("--crs plane"), std::string::npos);
}

// Coordinates in a projected CRS can be off the Earth too.
TEST_F(Coordinates, NodesOffAProjectionAreRefused) {
  const std::string mesh = write("m.2dm", "MESH2D\nE3T 1 1 2 3 1\nND 1 5e5 5e6 0\nND 2 6e5 5e6 0\nND 3 1e30 5e6 0\n");
  const ProgramRun run = runProgram({"convert", mesh, "-o", file("o.gpkg"), "--assume-crs", "EPSG:32616"});
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.errors.find("m.2dm"), std::string::npos) << run.errors;
  EXPECT_NE(run.errors.find("node 3"), std::string::npos) << run.errors;
}

// Coordinates to the south and west turn counter-clockwise rings of the ground into clockwise ones.
TEST_F(Coordinates, InputsThatMirrorTheGroundAreRefused) {
  const auto inCrs = [&](const std::string& code) {
    return write("field.geojson",
                 R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::)" +
                     code + R"("}},"features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon",)" +
                     R"("coordinates":[[[1050000,700000],[1060000,700000],[1060000,712000],[1050000,700000]]]}}]})");
  };
  const std::string krovak = inCrs("5513");
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{{}, {"--per-feature"}}) {
    std::vector<std::string> arguments{"mesh", krovak, "-o", file("field{}.14"), "--size", "2000", "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 3);
    EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
    EXPECT_NE(run.errors.find("EPSG:5513 mirrors the ground"), std::string::npos) << run.errors;
    EXPECT_NE(run.errors.find("EPSG:5514"), std::string::npos) << run.errors;
  }
  // With --crs the coordinates are taken as a plane.
  for (const std::string crs : {"plane", "EPSG:5513"}) {
    const ProgramRun run =
        runProgram({"mesh", krovak, "--crs", crs, "-o", file("field.2dm"), "--size", "2000", "--quiet", "--overwrite"});
    EXPECT_EQ(run.code, 0) << run.errors;
    EXPECT_EQ(runProgram({"check", file("field.2dm"), "--assume-crs", "EPSG:5513"}).code, 0) << crs;
  }
  const ProgramRun run =
      runProgram({"mesh", lake(), "--crs", "EPSG:5513", "-o", file("lake.2dm"), "--size", "2000", "--quiet"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.errors.find("give EPSG:5514"), std::string::npos) << run.errors;
}

// GDAL's messages may contain line ends; an error has none.
TEST_F(Coordinates, ErrorsAreOneLine) {
  const std::string geojson = lake();
  ASSERT_EQ(runProgram({"mesh", geojson, "-o", file("m.fgb"), "-o", file("m.shp"), "--quiet"}).code, 0);
  std::string fgb = readText(file("m.fgb"));
  fgb[3] = 0;  // its version
  const std::string old = write("old.fgb", fgb);
  const std::string vtu = write("no.vtu", "this is no XML\n<at all\n");
  std::string index = readText(file("m.shx"));
  index.resize(40);
  write("m.shx", index);
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"check", old},
                                             {"info", vtu},
                                             {"check", file("m.shp")},
                                             {"mesh", geojson, "--where", "name =\n= 3", "-o", file("o.nc")},
                                             {"mesh", geojson, "--where", "name = 'x", "-o", file("o.nc")}}) {
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 3) << arguments[1];
    EXPECT_TRUE(isOneErrorLine(run.errors));
    EXPECT_LT(run.errors.size(), 800u);
  }
}

// Models read metres. Layers carry the CRS, and UGRID files name the units as in UDUNITS.
TEST_F(Coordinates, InOtherUnitsThanMetresAreWarnedOfForModels) {
  const auto lakeIn = [&](int epsg) {
    return write("lake" + std::to_string(epsg) + ".geojson",
                 R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::)" +
                     std::to_string(epsg) +
                     R"("}},"features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":)"
                     R"([[[980000,190000],[990000,190000],[990000,200000],[980000,200000],[980000,190000]]]}}]})");
  };
  const auto errorsWith = [&](int epsg, const std::vector<std::string>& outputs) {
    std::vector<std::string> arguments{"mesh", lakeIn(epsg), "--size", "500", "--overwrite"};
    for (const std::string& output : outputs) arguments.insert(arguments.end(), {"-o", file(output)});
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 0) << run.errors;
    return run.errors;
  };
  for (const std::string model : {"a.14", "a.gr3", "a.slf", "a_grd.dat", "a.2dm", "a_ww3.msh"}) {
    const std::string text = errorsWith(2263, {model, "b.2dm"});
    EXPECT_NE(text.find(model + "' has x and y in the unit of EPSG:2263, US survey foot"), std::string::npos) << text;
    EXPECT_EQ(text.find("has x and y"), text.rfind("has x and y")) << text;
    EXPECT_EQ(errorsWith(32618, {model}).find("has x and y"), std::string::npos);
  }
  // Writing a .ll writes the .gr3 too, and the .ll has longitudes and latitudes.
  const std::string schism = errorsWith(2263, {"a.ll"});
  EXPECT_NE(schism.find("a.gr3' has x and y in the unit of"), std::string::npos) << schism;
  EXPECT_EQ(errorsWith(2263, {"a.gpkg", "a.nc", "a.vtu"}), "");
  EXPECT_NE(readText(file("a.nc")).find("US_survey_foot"), std::string::npos);
  const ProgramRun run = runProgram({"convert", file("a.nc"), "-o", file("a.2dm"), "--overwrite"});
  EXPECT_NE(run.errors.find("EPSG:2263"), std::string::npos) << run.errors;
}

// For example in Web Mercator far from the equator.
TEST_F(Coordinates, NotTrueToScaleAreWarnedOfForModels) {
  const auto errorsAt = [&](double south, const std::string& output) {
    const std::string y = std::to_string(south), top = std::to_string(south + 10000.0);
    const std::string lake =
        write("lake.geojson",
              R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::3857"}},)"
              R"("features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[980000,)" +
                  y + "],[990000," + y + "],[990000," + top + "],[980000," + top + "],[980000," + y + "]]]}}]}");
    const ProgramRun run = runProgram({"mesh", lake, "--size", "500", "--overwrite", "-o", file(output)});
    EXPECT_EQ(run.code, 0) << run.errors;
    return run.errors;
  };
  const std::string text = errorsAt(8.6e6, "a.2dm");  // 61 degrees
  EXPECT_NE(text.find("a.2dm' are 2.05 times those on the ground"), std::string::npos) << text;
  EXPECT_EQ(errorsAt(8.6e6, "a.nc"), "");
  EXPECT_EQ(errorsAt(1e5, "a.2dm").find("times those"), std::string::npos);
}

// An equal-area cylinder at 60 degrees: parallels are 1.73 times as long, meridians 0.58 times.
TEST_F(Coordinates, ThatDistortShapesAreWarnedOfByDirection) {
  const std::string lake =
      write("lake.geojson",
            R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::6933"}},)"
            R"("features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":)"
            R"([[[980000,6345000],[990000,6345000],[990000,6350000],[980000,6350000],[980000,6345000]]]}}]})");
  const ProgramRun run = runProgram({"mesh", lake, "--size", "500", "-o", file("a.2dm")});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_NE(run.errors.find("a.2dm' are 0.57"), std::string::npos) << run.errors;
  EXPECT_NE(run.errors.find(" to 1.7"), std::string::npos) << run.errors;
  EXPECT_NE(run.errors.find(" times those on the ground, by place and direction, and angles differ by up to 6"),
            std::string::npos)
      << run.errors;
}

// GDAL calls it an error that WKT 1 cannot express Equal Earth, and then writes it as WKT 2.
TEST_F(Coordinates, InEqualEarthGoIntoGeoPackages) {
  const std::string lake =
      write("lake.geojson",
            R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::8857"}},)"
            R"("features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[)"
            R"([-240000,6400000],[-230000,6400000],[-230000,6412000],[-240000,6400000]]]}}]})");
  const std::string cleaned = file("cleaned.gpkg"), mesh = file("m.gpkg");
  const ProgramRun clean = runProgram({"clean", lake, "-o", cleaned});
  EXPECT_EQ(clean.code, 0) << clean.errors;
  const ProgramRun run = runProgram({"mesh", cleaned, "-o", mesh, "--edits", file("edits.gpkg")});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_EQ(infoOf(cleaned)["crs"], "EPSG:8857");
  EXPECT_EQ(infoOf(mesh)["crs"], "EPSG:8857");
}

// Files for models do not say whether they are in degrees; that of the middle one is in metres beyond doubt.
TEST_F(Coordinates, OfAModelsFileMayBeDegrees) {
  const auto grid = [&](const std::string& name, const std::string& east) {
    return write(name, "a sea\n1 3\n1 5 53 5\n2 " + east + " 53 5\n3 6 54 5\n1 3 1 2 3\n0\n0\n0\n0\n");
  };
  const std::string degrees = grid("sea.14", "6"), metres = grid("far.14", "600");
  // Flumes of 30 m by 2 m, with a corner at the origin, and of 5 m around it.
  for (const std::string flume : {"1 0 0 1\n2 30 0 1\n3 0 2 1\n", "1 -2.5 -1 1\n2 2.5 -1 1\n3 0 1 1\n"})
    EXPECT_EQ(runProgram({"info", write("flume.14", "a flume\n1 3\n" + flume + "1 3 1 2 3\n0\n0\n0\n0\n")}).errors, "");
  const std::string cards = write("sea.2dm", "MESH2D\nND 1 5 53 -5\nND 2 6 53 -5\nND 3 6 54 -5\nE3T 1 1 2 3 1\n");
  EXPECT_THAT(runProgram({"info", cards}).errors, HasSubstr("give --assume-crs EPSG:4326"));
  for (const std::string command : {"info", "check"}) {
    EXPECT_THAT(runProgram({command, degrees}).errors, HasSubstr("give --assume-crs EPSG:4326")) << command;
    EXPECT_EQ(runProgram({command, metres}).errors, "") << command;
    for (const std::string crs : {"EPSG:4326", "plane"})
      EXPECT_EQ(runProgram({command, degrees, "--assume-crs", crs}).errors, "") << command << crs;
  }
}

}  // namespace

}  // namespace coastmesh::test
