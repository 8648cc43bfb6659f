#include "gis/read/bare_geojson.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace coastmesh {
namespace {

std::optional<GeometryParts> read(const std::string& text) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() /
      (std::string("coastmesh-bare-") + info->name() + "-" + std::to_string(::getpid()) + ".geojson");
  std::ofstream(path, std::ios::binary) << text;
  std::optional<GeometryParts> parts = readBareGeojson(path.string());
  std::filesystem::remove(path);
  return parts;
}

TEST(BareGeojson, ReadsEveryTypeOfGeometry) {
  const auto parts = read(R"({"type": "GeometryCollection", "bbox": [0, [1], {"a": [2]}], "name": "x", "geometries": [
    {"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 4], [0, 0]], [[1, 0.5], [2, 0.5], [2, 1], [1, 0.5]]]},
    {"coordinates": [[[[5, 5, 9], [6, 5, 9], [6, 6, 9], [5, 5, 9]]], [[[7, 7], [8, 7], [8, 8]]]],
     "type": "MultiPolygon"},
    {"type": "LineString", "coordinates": [[-1e-1, 2.5E0], [3, -4]]},
    {"type": "MultiLineString", "coordinates": [[[0, 1], [2, 3]], [], [[4, 5], [6, 7]]]},
    {"type": "Point", "coordinates": [1, 1]}, {"type": "MultiPoint", "coordinates": [[1, 1], [2, 2]]},
    {"type": "Polygon", "coordinates": []}]})");
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->polygons.size(), 3u);
  EXPECT_EQ(parts->polygons[0].outer, (Ring{{0, 0}, {4, 0}, {4, 4}}));
  EXPECT_EQ(parts->polygons[0].holes, (std::vector<Ring>{{{1, 0.5}, {2, 0.5}, {2, 1}}}));
  EXPECT_EQ(parts->polygons[1].outer, (Ring{{5, 5}, {6, 5}, {6, 6}}));
  EXPECT_EQ(parts->polygons[2].outer, (Ring{{7, 7}, {8, 7}, {8, 8}}));
  EXPECT_EQ(parts->lines,
            (std::vector<std::vector<Point>>{{{-0.1, 2.5}, {3, -4}}, {{0, 1}, {2, 3}}, {{4, 5}, {6, 7}}}));
  EXPECT_EQ(parts->points.size(), 3u);
  EXPECT_EQ(parts->rings, 4u);
  EXPECT_EQ(parts->unclosed_rings, 1u);
  EXPECT_EQ(parts->unclosed_place, (Point{8, 8}));
  EXPECT_EQ(parts->coordinates, 4u + 4u + 4u + 3u + 2u + 4u + 2u);
}

TEST(BareGeojson, ReadsAGeometryThatStandsAlone) {
  const auto parts = read(R"({"type":"MultiPolygon","coordinates":[[[[0,0],[1,0],[1,1],[0,0]]]]})");
  ASSERT_TRUE(parts);
  EXPECT_EQ(parts->polygons.size(), 1u);
}

// All forms of numbers and strings that JSON has.
TEST(BareGeojson, ReadsNumbersAndStringsAsJsonHasThem) {
  for (const std::string name :
       {"", R"("name": "caf\u00e9",)", "\"name\": \"caf\303\251\",", R"("a": [true, false, null, -0],)"}) {
    // The last ones are left to the full JSON parser, and so are non-ASCII letters.
    for (const std::string last :
         {"[0e5,123456789.123456789012]", "[1e-400,123456789.123456789012]",
          "[0,123456789.12345678901200000000000000000000000000000000000000000000000000000000000]"}) {
      const auto parts = read("\n\t{" + name + R"("type" : "LineString","coordinates":[
      [ 0,-0 ],[-0.0,1],[0.1,1e2],[1E-2,1.5e+1],[12345678901234567890,0.30000000000000004],
      [4.35,0.000001],)" + last +
                              "]} ");
      ASSERT_TRUE(parts) << name << last;
      ASSERT_EQ(parts->lines.size(), 1u);
      const std::vector<Point> wanted = {{0, 0},
                                         {-0.0, 1},
                                         {0.1, 100},
                                         {0.01, 15},
                                         {12345678901234567890.0, 0.1 + 0.2},
                                         {4.35, 1e-6},
                                         {0, 123456789.123456789012}};
      EXPECT_EQ(parts->lines[0], wanted);
      EXPECT_FALSE(std::signbit(parts->lines[0][0].y));
      EXPECT_TRUE(std::signbit(parts->lines[0][1].x));
    }
  }
}

TEST(BareGeojson, LeavesWhatIsNoJsonToOgr) {
  for (const std::string number : {"01", "1.", ".5", "+1", "-", "1e", "1e+", "0x1", "inf", "nan", "1 2", "1,,2", "1,"})
    EXPECT_FALSE(read(R"({"type":"LineString","coordinates":[[0,0],[)" + number + ",1]]}")) << number;
  for (const std::string text :
       {R"({"type":"LineString","coordinates":[[0,0],[1,1]]}})",
        R"({"type":"LineString","coordinates":[[0,0],[1,1]]},)", R"({"type":"LineString","coordinates":[[0,0],[1,1]])",
        R"({"type":"LineString","coordinates":[[0,0],[1,1]}])", R"({"type":"LineString" "coordinates":[[0,0],[1,1]]})",
        R"({"type":"LineString","coordinates" [[0,0],[1,1]]})", R"({"type":"LineString,"coordinates":[[0,0],[1,1]]})",
        R"({"type":"LineString","coordinates":[[0,0],[1,1]],})",
        R"({"type":"LineString","coordinates":[[0,0],[1,1]],"a":tru})",
        R"({"type":"LineString","coordinates":[[0,0],[1,1)"})
    EXPECT_FALSE(read(text)) << text;
}

TEST(BareGeojson, LeavesTheRestToOgr) {
  const char* const others[] = {
      R"({"type":"FeatureCollection","features":[]})",
      R"({"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[1,2]}})",
      R"({"geometry":{"type":"Point","coordinates":[1,2]},"type":"Feature"})",
      R"({"type":"Topology","objects":{},"arcs":[]})",
      R"({"type":"Polygon","crs":{"type":"name"},"coordinates":[[[0,0],[1,0],[1,1],[0,0]]]})",
      (R"({"type":"GeometryCollection","geometries":[{"type":"GeometryCollection","geometries":[)"
       R"({"type":"GeometryCollection","geometries":[]}]}]})"),
      R"({"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]])",  // cut off
      R"({"type":"Polygon","coordinates":[[0,0],[1,0],[1,1],[0,0]]})",  // a level too few
      R"({"type":"Polygon","coordinates":[[[[0,0],[1,0],[0,0]]]]})",    // a level too many
      R"({"type":"Polygon","coordinates":[[[0],[1,0],[1,1],[0,0]]]})",  // no position
      R"({"type":"Polygon","coordinates":[[[0,[1,0]],[1,1]]]})",        // numbers and arrays mixed
      R"({"type":"Polygon","coordinates":[[[]]]})",                     // empty positions
      R"({"type":"Polygon","coordinates":[[[0,0],[1,0],[],[1,1]]]})",
      R"({"type":"LineString","coordinates":[[]]})",
      R"({"type":"Polygon","coordinates":[[[0,null],[1,0],[1,1]]]})",
      R"({"type":"Polygon","coordinates":[[[0,1e999],[1,0],[1,1]]]})",
      R"({"coordinates":[[[0,0],[1,0],[1,1],[0,0]]]})",
      R"([1,2,3])",
      R"("text")",
      R"(17)",
      "",
      "WKT,name\n",
  };
  for (const char* text : others) EXPECT_FALSE(read(text)) << text;
  EXPECT_FALSE(readBareGeojson("/no/such/file"));
}

}  // namespace
}  // namespace coastmesh
