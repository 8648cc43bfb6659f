// Features that are near one another, in pieces, or beyond the frame.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

using ::testing::HasSubstr;

class ManyFeatures : public ProgramTest {
 protected:
  // Meshes to mesh.nc, with a report.
  ProgramRun mesh(const std::string& input, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"mesh",       input, "-o", file("mesh.nc"), "--report", file("report.json"),
                                       "--overwrite"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return runProgram(arguments);
  }
  nlohmann::json report() const { return nlohmann::json::parse(readText(file("report.json"))); }

  // A feature for each line.
  std::string lines(const std::string& name, const std::vector<LonLatRing>& lines) {
    nlohmann::json features = nlohmann::json::array();
    for (const LonLatRing& line : lines)
      features.push_back({{"type", "Feature"},
                          {"properties", nlohmann::json::object()},
                          {"geometry", {{"type", "LineString"}, {"coordinates", line}}}});
    return write(name, nlohmann::json{{"type", "FeatureCollection"}, {"features", features}}.dump());
  }
};

// A pond on a spit of 2 km, which the sea's shore crosses once it follows elements of 4 km.
TEST_F(ManyFeatures, NeighboursDoNotOverlapWhereShoresMove) {
  const std::string waters =
      write("waters.geojson",
            geoJsonPolygons({{{{10.0, 50.0},
                               {10.56, 50.0},
                               {10.56, 50.171},
                               {10.364, 50.171},
                               {10.364, 50.189},
                               {10.56, 50.189},
                               {10.56, 50.36},
                               {10.0, 50.36}}},
                             {{{10.42, 50.1755}, {10.462, 50.1755}, {10.462, 50.1845}, {10.42, 50.1845}}}}));
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--size", "4000", "--coast", "follow"},
                                                  {"--size-shore", "4000", "--coast", "follow", "--keep-water", "all"},
                                                  {"--simplify", "3000"}}) {
    const ProgramRun run = mesh(waters, options);
    ASSERT_EQ(run.code, 0) << run.errors;
    const ProgramRun check = runProgram({"check", file("mesh.nc")});
    EXPECT_EQ(check.code, 0) << options.front() << ": " << check.output;
  }
}

// Two waters that overlap; the shore of the first, which divides them, has an edge of 31 m.
TEST_F(ManyFeatures, ShortEdgesOfSharedBordersAreNamed) {
  const std::string waters = write(
      "waters.geojson",
      geoJsonPolygons({{{{10.0, 50.0}, {10.5, 50.0}, {10.5, 50.15}, {10.5003, 50.1502}, {10.5, 50.3}, {10.0, 50.3}}},
                       {{{10.49, 50.05}, {10.9, 49.95}, {10.9, 50.25}, {10.49, 50.2}}}}));
  const std::vector<std::string> sizes{"--size-shore", "3000", "--size-max", "8000", "--coast", "follow"};
  const ProgramRun apart = mesh(waters, sizes);
  EXPECT_EQ(apart.code, 0);
  EXPECT_THAT(apart.errors, HasSubstr("the shortest edge, 30.9 m at (10.50015, 50.1501), is at a border"));
  std::vector<std::string> dissolved = sizes;
  dissolved.emplace_back("--dissolve");
  EXPECT_EQ(mesh(waters, dissolved).errors, "");
}

// The second lake, just east of the frame, has nearly all points.
TEST_F(ManyFeatures, TheBudgetIsSharedByThoseInTheFrame) {
  LonLatRing large;
  for (int i = 0; i < 600; ++i)
    large.push_back({11.1 + 0.05 * std::cos(i * 0.01047), 50.0 + 0.5 * std::sin(i * 0.01047)});
  const std::string lakes =
      write("lakes.geojson", geoJsonPolygons({{{{10.0, 50.0}, {10.1, 50.0}, {10.1, 50.1}, {10.0, 50.1}}}, {large}}));
  const ProgramRun run = mesh(lakes, {"--bbox=9,49,11,51", "--size", "1000", "--max-vertices", "400"});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_GT(report()["mesh"]["vertices"].get<int>(), 80);
}

TEST_F(ManyFeatures, SnapJoinsLinesAcrossGaps) {
  const std::string shore = lines(
      "shore.geojson", {{{14.0, 60.0}, {14.2, 60.0}, {14.2, 60.1}}, {{14.200005, 60.1}, {14.0, 60.1}, {14.0, 60.0}}});
  const ProgramRun apart = mesh(shore, {});
  EXPECT_EQ(apart.code, 3);
  EXPECT_THAT(apart.errors, HasSubstr("0.278 m apart"));
  const ProgramRun joined = mesh(shore, {"--snap", "1"});
  EXPECT_EQ(joined.code, 0) << joined.errors;
  EXPECT_THAT(joined.output, HasSubstr("1 gap between ends of lines was closed"));
}

TEST_F(ManyFeatures, ACleanedPlaneGraphCanBeMeshed) {
  const std::string graph = write("square.poly",
                                  "8 2 0 0\n1 0 0\n2 9 0\n3 9 9\n4 0 9\n5 3 3\n6 6 3\n7 6 6\n8 3 6\n8 0\n"
                                  "1 1 2\n2 2 3\n3 3 4\n4 4 1\n5 5 6\n6 6 7\n7 7 8\n8 8 5\n1\n1 5 5\n");
  ASSERT_EQ(runProgram({"clean", graph, "-o", file("square.gpkg")}).code, 0);
  const ProgramRun run = mesh(file("square.gpkg"), {});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_NEAR(report()["mesh"]["area_m2"].get<double>(), 72.0, 1e-9);
}

}  // namespace
}  // namespace coastmesh::test
