// Angles on the Earth, checked from longitudes and latitudes with arithmetic of this file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;
using Vector = std::array<double, 3>;

// Geocentric coordinates on WGS 84 in metres, or on the unit sphere with the same latitudes.
Vector placeOf(double lon_deg, double lat_deg, bool sphere) {
  const double lon = lon_deg * M_PI / 180.0, lat = lat_deg * M_PI / 180.0;
  const double f = sphere ? 0.0 : 1.0 / 298.257223563, e2 = f * (2.0 - f);
  const double n = (sphere ? 1.0 : 6378137.0) / std::sqrt(1.0 - e2 * std::sin(lat) * std::sin(lat));
  return {n * std::cos(lat) * std::cos(lon), n * std::cos(lat) * std::sin(lon), n * (1.0 - e2) * std::sin(lat)};
}

double angleAt(const Vector& a, const Vector& b, const Vector& c) {
  Vector u, v;
  for (std::size_t k = 0; k < 3; ++k) u[k] = b[k] - a[k], v[k] = c[k] - a[k];
  const double across = std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
  return std::atan2(across, u[0] * v[0] + u[1] * v[1] + u[2] * v[2]) * 180.0 / M_PI;
}

struct Angles {
  double least = 180.0, most = 0.0;
  std::size_t triangles = 0;
};

// The angles of a .2dm in longitudes and latitudes.
Angles anglesIn(const std::string& text, bool sphere) {
  std::vector<Vector> places;
  std::vector<std::array<std::size_t, 3>> triangles;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string card;
    std::size_t number = 0;
    words >> card >> number;
    if (card == "ND") {
      double lon = 0.0, lat = 0.0;
      words >> lon >> lat;
      places.push_back(placeOf(lon, lat, sphere));
    } else if (card == "E3T") {
      auto& [a, b, c] = triangles.emplace_back();
      words >> a >> b >> c;
    }
  }
  Angles angles;
  angles.triangles = triangles.size();
  for (const auto& v : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const double angle = angleAt(places.at(v[i] - 1), places.at(v[(i + 1) % 3] - 1), places.at(v[(i + 2) % 3] - 1));
      angles.least = std::min(angles.least, angle);
      angles.most = std::max(angles.most, angle);
    }
  return angles;
}

// A sea from Africa to South America, larger than a cap of 30 degrees, and a bay of some 400 km.
const std::vector<LonLatRing> kSea{{{-60, -40}, {15, -42}, {10, 5}, {-15, 12}, {-20, 50}, {-62, 45}},
                                   {{-30, -20}, {-25, -8}, {-38, -10}}};
const std::vector<LonLatRing> kBay{{{0, 50}, {6, 50}, {6, 54}, {3, 53}, {0, 54}}};

class SurfaceRuns : public ProgramTest {
 protected:
  std::string layer(const std::string& name, const std::vector<LonLatRing>& rings) {
    return write(name, geoJsonPolygons({rings}));
  }
  ProgramRun mesh(const std::string& input, std::vector<std::string> options) {
    std::vector<std::string> words{"mesh", input, "-o", file("m.2dm"), "--overwrite", "--report", file("m.json")};
    words.insert(words.end(), options.begin(), options.end());
    return runProgram(words);
  }
  Json reported() { return Json::parse(readText(file("m.json"))); }
};

TEST_F(SurfaceRuns, FiguresAreThoseOfFlatTrianglesOnTheEarth) {
  const std::string sea = layer("sea.geojson", kSea);
  for (const std::string kind : {"auto", "ellipsoid", "sphere"}) {
    const bool sphere = kind == "sphere";
    for (const std::vector<std::string>& asked :
         {std::vector<std::string>{}, {"--size", "400000"}, {"--min-angle", "38"}, {"--size-max", "700000"}}) {
      std::vector<std::string> options{"--surface", kind};
      options.insert(options.end(), asked.begin(), asked.end());
      const ProgramRun run = mesh(sea, options);
      ASSERT_EQ(run.code, 0) << run.errors << run.output;
      const std::string name = sphere ? "sphere" : "ellipsoid";
      EXPECT_THAT(run.output, HasSubstr("measured on the " + name + "\n"));
      const Json json = reported()["mesh"];
      EXPECT_EQ(json["surface"]["kind"], name);
      EXPECT_EQ(json["surface"]["radius_m"], sphere ? Json(6371008.8) : Json(nullptr));
      const Angles angles = anglesIn(readText(file("m.2dm")), sphere);
      EXPECT_EQ(json["triangles"], angles.triangles);
      EXPECT_NEAR(json["min_angle_deg"].get<double>(), angles.least, 1e-6) << kind;
      EXPECT_NEAR(json["max_angle_deg"].get<double>(), angles.most, 1e-6) << kind;
      const double bound = asked == std::vector<std::string>{"--min-angle", "38"} ? 38.0 : 33.0;
      EXPECT_GE(angles.least, bound - 1e-6);
      const ProgramRun info =
          runProgram({"info", file("m.2dm"), "--assume-crs", "EPSG:4326", "--json", "--surface", kind});
      EXPECT_NEAR(Json::parse(info.output)["min_angle_deg"].get<double>(), angles.least, 1e-6);
      EXPECT_EQ(Json::parse(info.output)["surface"], name);
    }
  }
}

// Nodes on a frame's parallels are moved onto them after meshing.
TEST_F(SurfaceRuns, WithinABoxFiguresAreThoseOfTheFile) {
  const std::string island = layer("island.geojson", {{{0, 0}, {6, 2}, {3, 9}, {-4, 7}}});
  for (const std::string size : {"300000", "600000"}) {
    const ProgramRun run = mesh(island, {"--domain", "outside", "--bbox=-65,-50,60,60", "--size", size});
    ASSERT_EQ(run.code, 0) << run.errors << run.output;
    const Angles angles = anglesIn(readText(file("m.2dm")), false);
    EXPECT_NEAR(reported()["mesh"]["min_angle_deg"].get<double>(), angles.least, 1e-6);
    EXPECT_NEAR(reported()["mesh"]["max_angle_deg"].get<double>(), angles.most, 1e-6);
  }
}

// An input within the cap stays in the plane, byte for byte, unless --surface requests otherwise.
TEST_F(SurfaceRuns, SmallInputsStayInThePlane) {
  const std::string bay = layer("bay.geojson", kBay);
  ASSERT_EQ(mesh(bay, {}).code, 0);
  const std::string plain = readText(file("m.2dm"));
  EXPECT_EQ(reported()["mesh"]["surface"],
            (Json{{"kind", "plane"}, {"radius_m", nullptr}, {"regions", {{"plane", 1}}}}));
  ASSERT_EQ(mesh(bay, {"--surface", "plane"}).code, 0);
  EXPECT_EQ(readText(file("m.2dm")), plain);
  ASSERT_EQ(mesh(bay, {"--surface", "ellipsoid"}).code, 0);
  const Angles angles = anglesIn(readText(file("m.2dm")), false);
  EXPECT_NEAR(reported()["mesh"]["min_angle_deg"].get<double>(), angles.least, 1e-6);
}

// Triangles around a node: the smallest angle, at that node, is 39.8 degrees in the plane, 38.1 on the ellipsoid, 37.9
// on spheres.
TEST_F(SurfaceRuns, FilesAreCheckedOnTheEarth) {
  const std::vector<std::pair<int, int>> nodes{{0, 0},   {32, 9},    {13, 30}, {-10, 28},
                                               {-33, 5}, {-25, -22}, {3, -33}, {28, -18}};
  std::ostringstream text;
  text << "MESH2D\n";
  for (int i = 1; i <= 7; ++i) text << "E3T " << i << " 1 " << i + 1 << ' ' << i % 7 + 2 << " 1\n";
  for (std::size_t i = 0; i < nodes.size(); ++i)
    text << "ND " << i + 1 << ' ' << nodes[i].first << ' ' << nodes[i].second << " 0\n";
  const std::string great = write("great.2dm", text.str());
  const auto holds = [&](const std::string& degrees, const std::vector<std::string>& options) {
    std::vector<std::string> words{"check", great, "--assume-crs", "EPSG:4326", "--min-angle", degrees};
    words.insert(words.end(), options.begin(), options.end());
    const ProgramRun run = runProgram(words);
    EXPECT_LE(run.code, 1) << run.errors;
    return run.code == 0;
  };
  const double ellipsoid = anglesIn(readText(great), false).least, sphere = anglesIn(readText(great), true).least;
  EXPECT_TRUE(holds(std::to_string(ellipsoid), {}));
  EXPECT_FALSE(holds(std::to_string(ellipsoid + 0.05), {}));
  EXPECT_TRUE(holds(std::to_string(ellipsoid + 1.0), {"--surface", "plane"}));
  EXPECT_TRUE(holds(std::to_string(sphere), {"--surface", "sphere"}));
  EXPECT_FALSE(holds(std::to_string(ellipsoid), {"--surface", "sphere"}));
}

TEST_F(SurfaceRuns, AgainstItsInputAMeshIsMeasuredOnItsSurface) {
  const std::string sea = layer("sea.geojson", kSea);
  ASSERT_EQ(mesh(sea, {"--min-angle", "38"}).code, 0);
  const auto check = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words{"check",   file("m.2dm"), "--assume-crs", "EPSG:4326",
                                   "--input", sea,           "--min-angle",  "38"};
    words.insert(words.end(), options.begin(), options.end());
    return runProgram(words);
  };
  const ProgramRun run = check({});
  EXPECT_EQ(run.code, 0) << run.output << run.errors;
  // An angle that violates the bound in the plane may meet it on the Earth.
  const ProgramRun plane = check({"--surface", "plane"});
  EXPECT_EQ(plane.code, 1);
  EXPECT_THAT(plane.output, HasSubstr("angle beyond the bound"));
}

TEST_F(SurfaceRuns, ModelsThatTakeLatitudesAsSphericalGetTheirSphere) {
  const std::string bay = layer("bay.geojson", kBay);
  for (const std::string target : {"fesom", "mpas"}) {
    const ProgramRun run = mesh(bay, {"--target", target, "--size", "60000"});
    EXPECT_LE(run.code, 1) << run.errors;
    EXPECT_EQ(reported()["mesh"]["surface"]["kind"], "sphere");
    const Angles angles = anglesIn(readText(file("m.2dm")), true);
    EXPECT_NEAR(reported()["mesh"]["min_angle_deg"].get<double>(), angles.least, 1e-6);
    EXPECT_THAT(run.output, HasSubstr("as the target does"));
    EXPECT_EQ(run.output.find("as MPAS needs it") != std::string::npos, target == "mpas");
    EXPECT_EQ(reported()["refine"]["max_angle_deg"], target == "mpas" ? 89.0 : 180.0);
    EXPECT_LE(angles.most, target == "mpas" ? 89.0 + 1e-6 : 180.0);
  }
  mesh(bay, {"--target", "fesom", "--surface", "plane"});
  EXPECT_EQ(reported()["mesh"]["surface"]["kind"], "plane");
  mesh(bay, {"--target", "mpas", "--max-angle", "100"});
  EXPECT_EQ(reported()["refine"]["max_angle_deg"], 100.0);
  mesh(bay, {"--target", "mpas", "--crs", "plane"});
  EXPECT_EQ(reported()["mesh"]["surface"]["kind"], "plane");
}

// Edges as lines of longitude and latitude: nodes on the bay's southern edge stay on its parallel.
TEST_F(SurfaceRuns, EdgesOfTheInputAreTheLinesAskedFor) {
  const std::string bay = layer("bay.geojson", {{{0, 50}, {12, 50}, {12, 56}, {0, 56}}});
  const auto furthestOff = [&](const std::vector<std::string>& options) {
    const ProgramRun run = mesh(bay, options);
    EXPECT_EQ(run.code, 0) << run.errors;
    std::istringstream lines(readText(file("m.2dm")));
    double most = 0.0;
    for (std::string line, card; std::getline(lines, line);) {
      std::istringstream words(line);
      double number = 0.0, lon = 0.0, lat = 0.0;
      if (words >> card >> number >> lon >> lat; card == "ND" && std::abs(lat - 50.0) < 0.2)
        most = std::max(most, std::abs(lat - 50.0) * 111200.0);
    }
    return most;
  };
  EXPECT_GT(furthestOff({"--size", "50000"}), 10000.0);
  EXPECT_LT(furthestOff({"--size", "50000", "--edges", "lonlat", "--edge-tolerance", "500"}), 501.0);
  EXPECT_THAT(mesh(bay, {"--edges", "geodesic"}).output,
              HasSubstr(" points were added to edges that would otherwise leave"));
  const std::string poly = write("a.poly", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n");
  for (const auto& words : {std::vector<std::string>{poly}, {bay, "--crs", "plane"}}) {
    std::vector<std::string> options(words.begin() + 1, words.end());
    options.insert(options.end(), {"--edges", "geodesic"});
    const ProgramRun run = mesh(words.front(), options);
    EXPECT_EQ(run.code, 2);
    EXPECT_THAT(run.errors, HasSubstr("--edges"));
  }
}

TEST_F(SurfaceRuns, SurfacesThatThePlaneHasNotAreMisuse) {
  const std::string bay = layer("bay.geojson", kBay);
  const std::string poly = write("a.poly", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n");
  for (const std::string kind : {"ellipsoid", "sphere"}) {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{poly}, {bay, "--crs", "plane"}, {bay, "--crs", "EPSG:3857"}}) {
      const ProgramRun run = mesh(words.front(), [&] {
        std::vector<std::string> options(words.begin() + 1, words.end());
        options.insert(options.end(), {"--surface", kind});
        return options;
      }());
      EXPECT_EQ(run.code, 2) << run.errors;
      EXPECT_THAT(run.errors, HasSubstr("--surface " + kind + ": "));
    }
    const std::string bare = write("bare.2dm", "MESH2D\nE3T 1 1 2 3 1\nND 1 0 0 0\nND 2 9 0 0\nND 3 0 9 0\n");
    for (const std::string command : {"check", "info"}) {
      const ProgramRun run = runProgram({command, bare, "--surface", kind});
      EXPECT_EQ(run.code, 2) << run.errors;
      EXPECT_THAT(run.errors, HasSubstr("--assume-crs"));
    }
  }
  EXPECT_EQ(mesh(poly, {"--surface", "plane"}).code, 0);
  EXPECT_EQ(mesh(bay, {"--crs", "plane", "--surface", "auto"}).code, 0);
}

}  // namespace
}  // namespace coastmesh::test
