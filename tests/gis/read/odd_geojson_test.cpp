#include "gis/read/odd_geojson.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <utility>

namespace coastmesh {
namespace {

std::string oddOf(const std::string& text) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() /
      (std::string("coastmesh-odd-") + info->name() + "-" + std::to_string(::getpid()) + ".geojson");
  std::ofstream(path, std::ios::binary) << text;
  const std::optional<std::string> odd = oddGeojson(path.string());
  std::filesystem::remove(path);
  return odd.value_or("nothing");
}

// A feature between two others; the first has members with the names that are searched for.
std::string among(const std::string& geometry, const std::string& id = "") {
  return R"({"type":"FeatureCollection","id":9,"crs":{"geometry":[1],"features":[2]},"features":[
    {"type":"Feature","id":"text","properties":{"coordinates":["a"],"geometry":"b","id":5,"type":"c"},
     "geometry":{"type":"Polygon","bbox":[0,0,1,1],"coordinates":[[[0,0],[1,0,5],[1,1]]]}},
    {"geometry":)" +
         geometry + R"(,"type":"Feature")" + id + R"(},{"type":"Feature","geometry":{"type":"None"}}]})";
}

TEST(OddGeojson, NamesFeatureAndPlace) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({"type":"Polygon","coordinates":[[[0,0],[4,0],[4,4],[0,0]],[[1,1],[2],[2,2],[1,1]]]})",
       "hole 1, vertex 2, is not a place ([2])"},
      {R"({"coordinates":[[[0,0],[4,null],[4,4]]],"type":"polygon"})",
       "outer ring, vertex 2, is not a place ([4, null])"},
      {R"({"type":"MultiPolygon","coordinates":[[[[0,0],[4,0],[4,4]]],[[[1,1],[2,1]],[[2,2],[3,3],["x",1.5e0]]]]})",
       R"(polygon 2, hole 1, vertex 3, is not a place (["x", 1.5e0]))"},
      {R"({"type":"LineString","coordinates":[[0,0],[],[1,1]]})", "vertex 2, is not a place ([])"},
      {R"({"type":"MultiLineString","coordinates":[[[0,0],[1,1]],[[0,true]]]})",
       "line 2, vertex 1, is not a place ([0, true])"},
      {R"({"type":"MultiPoint","coordinates":[[0,0],[{"x":[1]},2]]})", "point 2, is not a place ([{…}, 2])"},
      {R"({"type":"Point","coordinates":[3]})", "its point, is not a place ([3])"},
      {R"({"type":"Polygon","coordinates":[[[0,[1,0]],[1,1]]]})",
       "[1, 0] lies in 3 arrays of the coordinates of its Polygon, not in 2"},
      {R"({"type":"Polygon","coordinates":[[0,0],[4,0],[4,4]]})",
       "[0, 0] lies in 1 array of the coordinates of its Polygon, not in 2"},
      {R"({"type":"MultiPolygon","coordinates":[[[[0,0],[4,0],[4,4]]],[[1,1],[2,1],[2,2]]]})",
       "[1, 1] lies in 2 arrays of the coordinates of its MultiPolygon, not in 3"},
      {R"({"type":"GeometryCollection","geometries":[{"type":"Point","coordinates":[1,2]},{"type":"GeometryCollection",
           "geometries":[{"type":"LineString","coordinates":[[0]]}]}]})",
       "geometry 2 of its collection, geometry 1 of its collection, vertex 1, is not a place ([0])"},
      {R"({"type":"GeometryCollection"})", "a GeometryCollection, has no geometries"},
      {R"({"type":"Polygon","coordinates":null})", "a Polygon, has no coordinates"},
      {R"({"type":"Polygn","coordinates":[]})", "of the type 'Polygn', is not a geometry of GeoJSON"},
      {R"({"coordinates":[[[0,0],[1,1]]]})", "of the type '', is not a geometry of GeoJSON"},
      {R"([1,[2]])", "its geometry is not an object ([…])"},
      {R"("POINT 1 2")", R"(its geometry is not an object ("POINT 1 2"))"},
  };
  for (const auto& [geometry, what] : cases) {
    EXPECT_EQ(oddOf(among(geometry)), std::string("feature 1: ") + what) << geometry;
    EXPECT_EQ(oddOf(among(geometry, R"(,"id":70)")), std::string("feature 70: ") + what) << geometry;
  }
}

TEST(OddGeojson, TakesAFileOfOneFeatureOrGeometry) {
  EXPECT_EQ(oddOf(R"({"type":"Feature","geometry":{"type":"Point","coordinates":[3]},"id":12})"),
            "feature 12: its point, is not a place ([3])");
  EXPECT_EQ(oddOf(R"({"type":"Polygon","coordinates":[[[0,0],[1,"2"],[1,1]]]})"),
            R"(feature 0: outer ring, vertex 2, is not a place ([1, "2"]))");
}

TEST(OddGeojson, FindsNothingWhereAllIsWell) {
  for (const char* const geometry :
       {"null", R"({"type":"Polygon","coordinates":[]})", R"({"type":"Point","coordinates":[]})",
        R"({"type":"Polygon","coordinates":[[]]})", R"({"type":"MultiPolygon","coordinates":[[[]]]})",
        R"({"type":"GeometryCollection","geometries":[]})",
        R"({"type":"MULTIPOINT","coordinates":[[1,2,3],[-1e5,2.5,3,4]]})"}) {
    EXPECT_EQ(oddOf(among(geometry)), "feature 2: of the type 'None', is not a geometry of GeoJSON") << geometry;
  }
  EXPECT_EQ(oddOf(R"({"type":"FeatureCollection","features":[]})"), "nothing");
}

// Text that is not JSON, or not GeoJSON, is left for others to refuse.
TEST(OddGeojson, SaysNothingOfWhatIsNoGeojson) {
  for (const char* const text : {"", "{", "[1]", "7", R"({"type":"FeatureCollection","features":[{"geometry":)",
                                 R"({"type":"Topology","objects":{"a":{"arcs":[[0]]}},"arcs":[[[0]]]})"}) {
    EXPECT_EQ(oddOf(text), "nothing") << text;
  }
  EXPECT_EQ(oddOf(std::string(100'000, '[')), "nothing");
  std::string deep =
      R"({"type":"Polygon","coordinates":)" + std::string(100'000, '[') + "1" + std::string(100'000, ']') + "}";
  EXPECT_NE(oddOf(deep).find("of the coordinates of its Polygon"), std::string::npos);
  EXPECT_FALSE(oddGeojson("/no/such/file"));
}

}  // namespace
}  // namespace coastmesh
