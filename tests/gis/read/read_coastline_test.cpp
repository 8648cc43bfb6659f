#include "gis/read/read_coastline.hpp"

#include <cpl_conv.h>
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>

#include "gis/error.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

using ::testing::HasSubstr;

class ReadCoastline : public ::testing::Test {
 protected:
  void SetUp() override {
    GDALAllRegister();
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("coastmesh-read-") + info->name() + "-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  // Writes a GeoJSON file of these geometries, each as a feature with a name.
  std::string geojson(const std::string& name, const std::vector<std::string>& geometries) const {
    std::string text = R"({"type":"FeatureCollection","features":[)";
    for (std::size_t i = 0; i < geometries.size(); ++i) {
      text += (i ? "," : "") + std::string(R"({"type":"Feature","properties":{"name":"f)") + std::to_string(i) +
              R"("},"geometry":)" + geometries[i] + "}";
    }
    return write(name, text + "]}");
  }
  // Writes a layer from WKT with OGR; empty text is a null geometry.
  std::string layer(const std::string& name, const char* driver, const char* crs, const std::vector<std::string>& wkt,
                    const char* layer_name = "coast", bool append = false) const {
    GDALDriver* const found = GetGDALDriverManager()->GetDriverByName(driver);
    const std::unique_ptr<GDALDataset> dataset(
        append ? GDALDataset::Open(path(name).c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE)
               : found->Create(path(name).c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    OGRSpatialReference srs;
    if (crs) srs.SetFromUserInput(crs);
    srs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const bool shape = std::string(driver) == "ESRI Shapefile";
    OGRLayer* const made =
        dataset->CreateLayer(layer_name, crs ? &srs : nullptr, shape ? wkbPolygon : wkbUnknown, nullptr);
    OGRFieldDefn field("depth", OFTReal);
    EXPECT_EQ(made->CreateField(&field), OGRERR_NONE);
    for (const std::string& text : wkt) {
      OGRFeature feature(made->GetLayerDefn());
      OGRGeometry* geometry = nullptr;
      if (!text.empty()) OGRGeometryFactory::createFromWkt(text.c_str(), nullptr, &geometry);
      if (geometry) feature.SetGeometryDirectly(geometry);
      EXPECT_EQ(made->CreateFeature(&feature), OGRERR_NONE);
    }
    return path(name);
  }

  Coastline read(const std::vector<std::string>& sources) { return readCoastline(sources, report_ = {}); }
  Coastline read(const std::string& source) { return read(std::vector{source}); }

  void expectRefused(const std::vector<std::string>& sources, const std::vector<std::string>& words) {
    ::testing::internal::CaptureStderr();
    try {
      read(sources);
      ADD_FAILURE() << "was read";
    } catch (const InputError& error) {
      const std::string text = error.what();
      for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos);
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  }

  ReadReport report_;

 private:
  std::filesystem::path folder_;
};

const char* const kSquare = R"({"type":"Polygon","coordinates":[[[0,0],[0.1,0],[0.1,0.3],[0,0.3],[0,0]]]})";

TEST_F(ReadCoastline, PolygonsComeBitForBitWithNamesAndNumbers) {
  const Coastline coastline = read(
      geojson("a.geojson", {kSquare, R"({"type":"MultiPolygon","coordinates":[[[[5,5],[6,5],[6,6],[5,5]]],)"
                                     R"([[[7,7,1],[9,7,2],[9,9,3],[7,7,1]],[[8,7.5],[8.5,7.5],[8.5,8],[8,7.5]]]]})"}));
  ASSERT_EQ(coastline.features.size(), 2u);
  EXPECT_EQ(coastline.crs.authority, "EPSG:4326");
  const Feature& first = coastline.features[0];
  EXPECT_EQ(first.fid, 0);
  EXPECT_EQ(first.source, path("a.geojson"));
  EXPECT_EQ(first.polygons[0].outer, (Ring{{0, 0}, {0.1, 0}, {0.1, 0.3}, {0, 0.3}}));
  EXPECT_EQ(first.attributes, (std::vector<std::pair<std::string, std::string>>{{"name", "f0"}}));
  ASSERT_EQ(coastline.features[1].polygons.size(), 2u);
  EXPECT_EQ(coastline.features[1].polygons[1].outer, (Ring{{7, 7}, {9, 7}, {9, 9}}));
  ASSERT_EQ(coastline.features[1].polygons[1].holes.size(), 1u);
  EXPECT_EQ(report_.features, 2u);
  EXPECT_EQ(report_.rings, 4u);
  EXPECT_EQ(report_.points, 5u + 4u + 4u + 4u);
  EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(ReadCoastline, ABareGeometryIsAFeatureAPolygon) {
  const Coastline coastline = read(write("bare.geojson", R"({"type":"GeometryCollection","geometries":[
      {"type":"MultiPolygon","coordinates":[[[[0,0],[1,0],[1,1],[0,0]]],[[[5,5],[6,5],[6,6],[5,5]]]]},
      {"type":"Polygon","coordinates":[[[8,8],[9,8],[9,9],[8,8]]]}]})"));
  ASSERT_EQ(coastline.features.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(coastline.features[i].fid, static_cast<std::int64_t>(i));
    EXPECT_EQ(coastline.features[i].polygons.size(), 1u);
  }
  EXPECT_EQ(coastline.features[2].polygons[0].outer[0], (Point{8, 8}));
}

// A row of a table is no bare geometry: neither one without values nor the only one that a filter leaves.
TEST_F(ReadCoastline, ARowStaysOneFeature) {
  const std::string two =
      R"("geometry":{"type":"MultiPolygon","coordinates":[[[[0,0],[1,0],[1,1],[0,0]]],[[[5,5],[6,5],[6,6],[5,5]]]]})";
  const std::string file = write("row.geojson", R"({"type":"FeatureCollection","features":[
      {"type":"Feature","id":7,"properties":{"name":null},)" +
                                                    two + "}]}");
  const Coastline row = read(file);
  ASSERT_EQ(row.features.size(), 1u);
  EXPECT_EQ(row.features[0].fid, 7);
  EXPECT_EQ(row.features[0].polygons.size(), 2u);
  const std::string rows = write("rows.geojson", R"({"type":"FeatureCollection","features":[
      {"type":"Feature","id":7,"properties":{},)" + two +
                                                     R"(},{"type":"Feature","id":8,"properties":{},)" + two + "}]}");
  ReadReport report;
  const Coastline left = readCoastline({Source{.path = rows}}, ReadFilter{.layers = {}, .where = "fid = 8"}, report);
  ASSERT_EQ(left.features.size(), 1u);
  EXPECT_EQ(left.features[0].fid, 8);
}

TEST_F(ReadCoastline, SkipsAndCountsWhatIsNoShore) {
  const Coastline coastline = read(geojson("mixed.geojson", {"null", kSquare, R"({"type":"Point","coordinates":[3,3]})",
                                                             R"({"type":"MultiPoint","coordinates":[[3,3],[4,4]]})",
                                                             R"({"type":"Polygon","coordinates":[]})"}));
  EXPECT_EQ(coastline.features.size(), 1u);
  EXPECT_EQ(coastline.features[0].fid, 1);
  EXPECT_EQ(report_.skipped_empty, 2u);
  EXPECT_EQ(report_.skipped_points, 3u);
  EXPECT_THAT(report_.notes, ::testing::Contains(HasSubstr("2 features without a shape are left out")));
}

TEST_F(ReadCoastline, WarnsOfNumbersThatSeveralFeaturesHave) {
  const auto numbered = [&](const std::string& name, const std::vector<int>& ids) {
    std::string text = R"({"type":"FeatureCollection","features":[)";
    for (std::size_t i = 0; i < ids.size(); ++i)
      text += (i ? "," : "") + std::string(R"({"type":"Feature","properties":{},"id":)") + std::to_string(ids[i]) +
              R"(,"geometry":)" + std::string(kSquare) + "}";
    return write(name, text + "]}");
  };
  read(numbered("descending.geojson", {7, 5, 3}));
  EXPECT_THAT(report_.warnings, ::testing::IsEmpty());
  read(numbered("once.geojson", {3, 5, 3, 3, 1}));
  ASSERT_THAT(report_.warnings, ::testing::SizeIs(1));
  EXPECT_THAT(report_.warnings[0], HasSubstr("once.geojson': number 3 is that of several features: src_fid does not"));
  report_ = {};
  read(numbered("twice.geojson", {8, 5, 5, 8}));
  ASSERT_THAT(report_.warnings, ::testing::SizeIs(1));
  EXPECT_THAT(report_.warnings[0], HasSubstr("2 numbers are those of several features, as 5"));
}

// OGR would silently omit a hole, a polygon or a whole feature.
TEST_F(ReadCoastline, RefusesPartsOfGeojsonThatAreNoGeometry) {
  const std::string hole =
      R"({"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9],[0,0]],[[2,1],[3,null],[3,2],[2,1]]]})";
  const std::string part = R"({"type":"MultiPolygon","coordinates":[[[[0,0],[9,0],[9,9],[0,0]]],[[1,1],[2,1],[2,2]]]})";
  const std::string text = R"({"type":"Polygon","coordinates":[[[0,0],["9",0],[9,9],[0,0]]]})";
  const std::string type = R"({"type":"Polygn","coordinates":[[[0,0],[9,0],[9,9],[0,0]]]})";
  for (const auto& [geometry, what] :
       {std::pair<std::string, std::string>{hole, "hole 1, vertex 2, is not a place ([3, null])"},
        {part, "[1, 1] lies in 2 arrays"},
        {text, R"(outer ring, vertex 2, is not a place (["9", 0]))"},
        {type, "of the type 'Polygn'"}}) {
    const std::string file = geojson("odd.geojson", {kSquare, geometry});
    expectRefused({file}, {"odd.geojson', feature 1: " + what, "repair or remove this feature"});
  }
}

// GDAL does not open a bare geometry with anything but numbers in it.
TEST_F(ReadCoastline, NamesThePlaceInABareGeometry) {
  const std::string bare = R"({"type":"Polygon","coordinates":[[[0,0],[9,0],["x",9],[0,0]]]})";
  expectRefused(
      {write("bare.geojson", bare)},
      {"bare.geojson', feature 0: outer ring, vertex 3, is not a place ([\"x\", 9])", "repair or remove this feature"});
  expectRefused({write("cut.geojson", R"({"type":"Polygon","coordinates":[[[0,0],[9,0])")},
                {"cut.geojson': not a vector file that GDAL can read"});
}

TEST_F(ReadCoastline, RefusesTextsThatAreNoWkt) {
  const std::string square = "\"POLYGON((0 0,1 0,1 1,0 0))\"";
  for (const std::string odd : {"POLYGN((5 5,6 5,6 6,5 5))", "POLYGON((5 5,6 x,6 6,5 5))", "none"}) {
    const std::string rest = ",name\n" + square + ",a\n\"" + odd + "\",b\n";
    expectRefused({write("odd.csv", "wkt" + rest)}, {"odd.csv', feature 2: its wkt is not a geometry (" + odd + ")"});
    expectRefused({write("odd.csv", "_WKTcoast" + rest)}, {"feature 2: its _WKTcoast is not a geometry (" + odd + ")"});
  }
  // An empty text is an empty geometry, as elsewhere.
  EXPECT_EQ(read(write("empty.csv", "WKT,name\n" + square + ",a\n,b\n\"POLYGON EMPTY\",c\n")).features.size(), 1u);
  EXPECT_EQ(report_.skipped_empty, 2u);
}

// As PostGIS writes it, and in columns named as databases and GeoPandas do.
TEST_F(ReadCoastline, ReadsExtendedWkt) {
  for (const std::string column : {"WKT", "geometry", "geom", "the_geom", "Geometry"}) {
    const Coastline coastline =
        read(write("ewkt.csv", "id," + column + "\n1,\"SRID=32633;POLYGON((500000 0,500001 0,500001 1,500000 0))\"\n"));
    ASSERT_EQ(coastline.features.size(), 1u) << column;
    EXPECT_EQ(coastline.crs.authority, "EPSG:32633");
    EXPECT_EQ(coastline.features[0].polygons[0].outer.front(), (Point{500000, 0}));
  }
  const std::string plain = "id,geometry\n1,\"POLYGON((0 0,1 0,1 1,0 0))\"\n";
  EXPECT_EQ(read(write("plain.csv", plain)).features.size(), 1u);
  expectRefused(
      {write("two.csv",
             "WKT,a\n\"SRID=4326;POLYGON((0 0,1 0,1 1,0 0))\",1\n\"SRID=4267;POLYGON((0 0,1 0,1 1,0 0))\",2\n")},
      {"two.csv', feature 2: its CRS is SRID 4267, but that of features before it is 4326"});
  expectRefused({write("none.csv", "geom,a\n\"SRID=4326;POLYGN((0 0,1 0,1 1,0 0))\",1\n")},
                {"none.csv', feature 1: its geom is not a geometry (SRID=4326;POLYGN"});
  expectRefused({write("odd.csv", "geom,a\n\"SRID=999999;POLYGON((0 0,1 0,1 1,0 0))\",1\n")},
                {"odd.csv', feature 1: the CRS of its geometry, SRID 999999, is not known"});
}

TEST_F(ReadCoastline, ClosesRings) {
  const Coastline coastline =
      read(write("open.csv", "WKT,name\n\"POLYGON((0 0,1 0,1 1,0 1))\",a\n\"POLYGON((5 5,6 5,6 6,5 5))\",b\n"));
  ASSERT_EQ(coastline.features.size(), 2u);
  EXPECT_EQ(coastline.features[0].polygons[0].outer.size(), 4u);
  EXPECT_EQ(report_.unclosed_rings, 1u);
  ASSERT_FALSE(report_.warnings.empty());
  EXPECT_NE(report_.warnings[0].find("not closed"), std::string::npos);
}

TEST_F(ReadCoastline, CurvesBecomeStraightPieces) {
  const Coastline coastline =
      read(layer("curves.gpkg", "GPKG", "EPSG:32631", {"CURVEPOLYGON(CIRCULARSTRING(0 0,10 0,0 0))"}));
  ASSERT_EQ(coastline.features.size(), 1u);
  EXPECT_GT(coastline.features[0].polygons[0].outer.size(), 60u);
  for (const Point& p : coastline.features[0].polygons[0].outer) EXPECT_NEAR(std::hypot(p.x - 5, p.y), 5, 1e-6);
}

TEST_F(ReadCoastline, LinesAreJoinedOverAllSources) {
  const std::string a = geojson("west.geojson", {R"({"type":"LineString","coordinates":[[0,0],[0,4],[4,4]]})",
                                                 R"({"type":"LineString","coordinates":[[20,20],[21,21]]})"});
  const std::string b =
      geojson("east.geojson", {R"({"type":"MultiLineString","coordinates":[[[4,0],[4,4]],[[4,0],[0,0]]]})",
                               R"({"type":"LineString","coordinates":[[1,1],[2,1],[2,2],[1,1]]})"});
  const Coastline coastline = read({a, b});
  ASSERT_EQ(coastline.features.size(), 2u);
  const Feature& lake = coastline.features[0];
  EXPECT_EQ(lake.source, a);
  EXPECT_EQ(lake.fid, 0);
  EXPECT_EQ(lake.attributes[0].second, "f0");
  EXPECT_EQ(lake.polygons[0].outer.size(), 4u);
  ASSERT_EQ(lake.polygons[0].holes.size(), 1u);
  EXPECT_EQ(lake.polygons[0].holes[0].size(), 3u);
  const Feature& line = coastline.features[1];
  EXPECT_EQ(line.fid, 1);
  EXPECT_TRUE(line.polygons.empty());
  EXPECT_EQ(line.lines[0], (std::vector<Point>{{20, 20}, {21, 21}}));
  EXPECT_EQ(report_.rings, 2u);
}

TEST_F(ReadCoastline, AllLayersOfASource) {
  layer("two.gpkg", "GPKG", "EPSG:4326", {"POLYGON((0 0,1 0,1 1,0 0))"}, "lakes");
  layer("two.gpkg", "GPKG", "EPSG:4326", {"POLYGON((5 5,6 5,6 6,5 5))"}, "ponds", true);
  const Coastline coastline = read(path("two.gpkg"));
  ASSERT_EQ(coastline.features.size(), 2u);
  EXPECT_EQ(coastline.features[0].source, path("two.gpkg") + "|lakes");
  EXPECT_EQ(coastline.features[1].source, path("two.gpkg") + "|ponds");
  EXPECT_EQ(coastline.features[0].polygons[0].outer[1], (Point{1, 0}));
}

// PROJ complains of datum shifts by grids, that it has no WKT 1 for them or that the grids are not installed. The
// features are as good as any.
TEST_F(ReadCoastline, DatumShiftsByGridsAreNoErrorsInTheFile) {
  const std::string polygon = "POLYGON((500000 0,600000 0,600000 100000,500000 0))";
  for (const char* grids : {"@null", "not_installed.gsb"}) {
    const std::string crs = std::string("+proj=utm +zone=31 +ellps=intl +type=crs +nadgrids=") + grids;
    for (const char* driver : {"GPKG", "FlatGeobuf"}) {
      testing::internal::CaptureStderr();  // GDAL's messages while it writes the file
      const std::string file = layer(std::string(grids) + '.' + driver, driver, crs.c_str(), {polygon});
      testing::internal::GetCapturedStderr();
      testing::internal::CaptureStderr();
      const Coastline coastline = read(file);
      EXPECT_EQ(metresPerUnit(coastline.crs), 1.0);
      EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << grids << ' ' << driver;
      EXPECT_EQ(coastline.features.size(), 1u);
      EXPECT_TRUE(report_.warnings.empty()) << report_.warnings.front();
    }
  }
}

TEST_F(ReadCoastline, BringsAllToTheCrsOfTheFirst) {
  const std::string geographic = geojson("first.geojson", {kSquare});
  const std::string utm =
      layer("utm.gpkg", "GPKG", "EPSG:32631", {"POLYGON((500000 0,600000 0,600000 100000,500000 0))"});
  const Coastline coastline = read({geographic, utm});
  EXPECT_EQ(coastline.crs.authority, "EPSG:4326");
  EXPECT_EQ(coastline.features[0].polygons[0].outer[1], (Point{0.1, 0}));
  EXPECT_NEAR(coastline.features[1].polygons[0].outer[0].x, 3, 1e-9);
  EXPECT_NEAR(coastline.features[1].polygons[0].outer[0].y, 0, 1e-9);
  const Coastline other_way = read({utm, geographic});
  EXPECT_EQ(other_way.crs.authority, "EPSG:32631");
  EXPECT_EQ(other_way.features[0].polygons[0].outer[1], (Point{600000, 0}));
  EXPECT_LT(other_way.features[1].polygons[0].outer[1].x, 500000);
}

// A frame in degrees around a coast in metres: its sides are where the mesh ends.
TEST_F(ReadCoastline, SidesOfAFrameThatBendInAnotherCrsAreNamed) {
  const std::string polar = layer("polar.gpkg", "GPKG", "EPSG:3995",
                                  {"POLYGON((500000 -900000,600000 -900000,600000 -800000,500000 -900000))"});
  const auto warningsOf = [&](const std::string& name, const std::string& ring) {
    const std::string frame = geojson(name, {R"({"type":"Polygon","coordinates":[[)" + ring + "]]}"});
    ReadReport report;
    readCoastline({{polar}, {frame, FeatureUse::Frame}}, {}, report);
    return report.warnings;
  };
  const std::vector<std::string> far = warningsOf("far.geojson", "[8,76],[33,76],[33,81.5],[8,81.5],[8,76]");
  ASSERT_EQ(far.size(), 1u);
  EXPECT_NE(far[0].find("far.geojson"), std::string::npos);
  EXPECT_NE(far[0].find("up to 36.7 km from where they are in its own, EPSG:4326"), std::string::npos) << far[0];
  EXPECT_NE(far[0].find("-segmentize"), std::string::npos);
  EXPECT_TRUE(warningsOf("near.geojson", "[20,78],[20.5,78],[20.5,78.1],[20,78.1],[20,78]").empty());
}

TEST_F(ReadCoastline, WithoutACrs) {
  // Looks like degrees: taken as WGS 84, with a warning.
  const std::string degrees = layer("degrees.shp", "ESRI Shapefile", nullptr, {"POLYGON((0 0,0 1,1 1,0 0))"});
  EXPECT_EQ(read(degrees).crs.authority, "EPSG:4326");
  ASSERT_EQ(report_.warnings.size(), 1u);
  EXPECT_NE(report_.warnings[0].find("degrees.shp"), std::string::npos);
  EXPECT_NE(report_.warnings[0].find("WGS 84"), std::string::npos);
  // Metres: a plane, with a warning.
  const std::string metres = layer("metres.shp", "ESRI Shapefile", nullptr, {"POLYGON((0 0,0 1000,1000 1000,0 0))"});
  EXPECT_TRUE(read(metres).crs.isPlane());
  EXPECT_EQ(report_.warnings.size(), 1u);
  // After a source with a CRS: the same CRS, with a warning.
  const std::string utm = layer("utm.gpkg", "GPKG", "EPSG:32631", {"POLYGON((5 5,6 5,6 6,5 5))"});
  EXPECT_EQ(read({utm, metres}).features[1].polygons[0].outer.size(), 3u);
  ASSERT_EQ(report_.warnings.size(), 2u);
  EXPECT_NE(report_.warnings[0].find("if they are degrees"), std::string::npos);
  expectRefused({geojson("first.geojson", {kSquare}), metres}, {"metres.shp", "CRS"});
  expectRefused({metres, utm}, {"metres.shp", "utm.gpkg", "CRS"});
}

TEST_F(ReadCoastline, NamesTheVertexThatIsNoPlace) {
  const std::string file = layer("nan.gpkg", "GPKG", "EPSG:4326", {"POLYGON((0 0,1 0,1 1,0 0))"});
  {
    const std::unique_ptr<GDALDataset> dataset(GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE));
    OGRLayer* const coast = dataset->GetLayer(0);
    OGRLinearRing outer, hole;
    for (const Point& p : square(0, 0, 9)) outer.addPoint(p.x, p.y);
    outer.closeRings();
    hole.addPoint(1, 1);
    hole.addPoint(2, 1);
    hole.addPoint(2, std::numeric_limits<double>::quiet_NaN());
    hole.addPoint(1, 1);
    OGRPolygon polygon;
    polygon.addRing(&outer);
    polygon.addRing(&hole);
    OGRFeature feature(coast->GetLayerDefn());
    feature.SetGeometry(&polygon);
    ASSERT_EQ(coast->CreateFeature(&feature), OGRERR_NONE);
  }
  expectRefused({file}, {"nan.gpkg", "feature 2", "hole 1", "vertex 3 of 4", "nan"});
}

TEST_F(ReadCoastline, RefusesInOneSentenceAndKeepsGdalQuiet) {
  expectRefused({path("missing.shp")}, {"missing.shp", "no such file"});
  expectRefused({write("empty.geojson", "")}, {"empty.geojson", "empty"});
  expectRefused({write("picture.png", "not a picture at all")}, {"picture.png", "not a vector file"});
  expectRefused({write("broken.geojson", R"({"type":"FeatureCollection","features":[{"type":)")}, {"broken.geojson"});
  expectRefused({geojson("points.geojson", {R"({"type":"Point","coordinates":[3,3]})"})},
                {"points.geojson", "points only"});
  expectRefused({geojson("nothing.geojson", {})}, {"nothing.geojson", "no feature"});
  expectRefused({geojson("nulls.geojson", {"null"})}, {"nulls.geojson", "no feature"});
  expectRefused(
      {geojson("ok.geojson", {kSquare}), geojson("points.geojson", {R"({"type":"Point","coordinates":[3,3]})"})},
      {"points.geojson"});
  expectRefused({}, {"no input"});
}

TEST_F(ReadCoastline, SaysWhyAConnectionFailsAndKeepsItsPassword) {
  if (GDALGetDriverByName("PostgreSQL") == nullptr) GTEST_SKIP() << "GDAL has no driver for PostgreSQL";
  for (const std::string source :
       {"PG:host=127.0.0.1 port=1 dbname=x user=u password=top-secret", "postgresql://u:top-secret@127.0.0.1:1/x"}) {
    expectRefused({source}, {"***", "cannot be opened", "127.0.0.1", "refused"});
    try {
      read(source);
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find("top-secret"), std::string::npos) << error.what();
    }
  }
}

TEST_F(ReadCoastline, NamesOfSourcesHaveNoPasswords) {
  const Coastline coastline = read(geojson("password=top", {kSquare}));
  EXPECT_TRUE(coastline.features[0].source.ends_with("password=***")) << coastline.features[0].source;
}

TEST_F(ReadCoastline, LargeObjectsAreReadWhateverTheirSize) {
  // Beyond the size at which GDAL refuses a GeoJSON object by default, reduced here by GDAL's own option.
  CPLSetThreadLocalConfigOption("OGR_GEOJSON_MAX_OBJ_SIZE", "0.001");
  std::string ring = "[";
  for (int i = 0; i < 2000; ++i) {
    const double angle = i * 2 * M_PI / 2000;
    ring += "[" + std::to_string(std::cos(angle)) + "," + std::to_string(std::sin(angle)) + "],";
  }
  ring += "[1.000000,0.000000]]";
  const Coastline coastline = read(geojson("large.geojson", {R"({"type":"Polygon","coordinates":[)" + ring + "]}"}));
  CPLSetThreadLocalConfigOption("OGR_GEOJSON_MAX_OBJ_SIZE", nullptr);
  EXPECT_EQ(coastline.features[0].polygons[0].outer.size(), 2000u);
}

// A square with its south-western corner at x, 0.
std::string squareAt(int x) {
  const auto at = [](int u, int v) { return "[" + std::to_string(u) + "," + std::to_string(v) + "]"; };
  return R"({"type":"Polygon","coordinates":[[)" + at(x, 0) + "," + at(x + 1, 0) + "," + at(x + 1, 1) + "," + at(x, 1) +
         "," + at(x, 0) + "]]}";
}

TEST_F(ReadCoastline, LayersByName) {
  layer("two.gpkg", "GPKG", "EPSG:4326", {"POLYGON((0 0,1 0,1 1,0 0))"}, "lakes");
  const std::string file = layer("two.gpkg", "GPKG", "EPSG:4326",
                                 {"POLYGON((5 0,6 0,6 1,5 0))", "POLYGON((8 0,9 0,9 1,8 0))"}, "ponds", true);
  ReadReport report;
  EXPECT_EQ(readCoastline({{file}}, {}, report).features.size(), 3u);
  EXPECT_EQ(readCoastline({{file}}, {{"ponds"}, ""}, report).features.size(), 2u);
  EXPECT_EQ(readCoastline({{file + "|lakes"}}, {}, report).features.size(), 1u);
  EXPECT_EQ(readCoastline({{file + "|layername=lakes"}}, {}, report).features.size(), 1u);
  try {
    readCoastline({{file}}, {{"seas"}, ""}, report);
    FAIL() << "took a layer that is not there";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("no layer 'seas'; there are lakes, ponds"), std::string::npos)
        << error.what();
  }
}

TEST_F(ReadCoastline, FeaturesByAttribute) {
  const std::string file = geojson("three.geojson", {squareAt(0), squareAt(3), squareAt(6)});
  ReadReport report;
  const Coastline kept = readCoastline({{file}}, {{}, "name <> 'f1'"}, report);
  ASSERT_EQ(kept.features.size(), 2u);
  EXPECT_EQ(kept.features[1].polygons[0].outer[0].x, 6);
  EXPECT_EQ(report.filtered, 1u);
  EXPECT_THROW(readCoastline({{file}}, {{}, "depth > 5"}, report), InputError);  // no such field
  EXPECT_THROW(readCoastline({{file}}, {{}, "name <"}, report), InputError);     // not SQL
  EXPECT_THROW(readCoastline({{file}}, {{}, "name = 'none'"}, report), InputError);
}

TEST_F(ReadCoastline, Archives) {
  geojson("lake.geojson", {squareAt(0)});
  ASSERT_EQ(std::system(("cd '" + path("") + "' && mkdir -p deep && cp lake.geojson deep && gzip -k lake.geojson && " +
                         "tar czf lake.tgz deep")
                            .c_str()),
            0);
  const auto zip = [&](const std::string& archive, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      const std::string target = "/vsizip/" + path(archive) + "/" + name;
      ASSERT_EQ(CPLCopyFile(target.c_str(), path("lake.geojson").c_str()), 0);
    }
  };
  zip("one.zip", {"some/folder/lake.geojson", "some/readme.txt"});
  zip("two.zip", {"a.geojson", "b.geojson"});
  zip("of_macos.zip", {"lake.geojson", "__MACOSX/._lake.geojson", "metadata.json"});
  ReadReport report;
  for (const std::string archive : {"lake.geojson.gz", "lake.tgz", "one.zip", "of_macos.zip"}) {
    EXPECT_EQ(readCoastline({path(archive)}, report).features.size(), 1u) << archive;
  }
  EXPECT_EQ(readCoastline({path("two.zip") + "/b.geojson"}, report).features.size(), 1u);
  EXPECT_THROW(readCoastline({path("two.zip")}, report), InputError);
}

// A pipe has no ending that tells what is in it.
TEST_F(ReadCoastline, ArchivesFromPipes) {
  geojson("lake.geojson", {squareAt(0)});
  ASSERT_EQ(std::system(("cd '" + path("") + "' && mkdir -p a b && cp lake.geojson a && cp lake.geojson b && " +
                         "gzip -k lake.geojson && tar cf lake.tar a && tar czf lake.tgz a && mkfifo pipe")
                            .c_str()),
            0);
  for (const char* const name : {"a/lake.geojson", "b/lake.geojson"}) {
    const std::string target = "/vsizip/" + path("two.zip") + "/" + name;
    ASSERT_EQ(CPLCopyFile(target.c_str(), path("lake.geojson").c_str()), 0);
  }
  ReadReport report;
  const auto readFromPipe = [&](const std::string& archive) {
    EXPECT_EQ(std::system(("cat '" + path(archive) + "' > '" + path("pipe") + "' &").c_str()), 0);
    return readCoastline({path("pipe")}, report).features.size();
  };
  for (const std::string archive : {"lake.geojson.gz", "lake.tar", "lake.tgz"})
    EXPECT_EQ(readFromPipe(archive), 1u) << archive;
  try {
    readFromPipe("two.zip");
    FAIL() << "no error";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with("'" + path("pipe") + "': holds 2 vector files (")) << text;
    EXPECT_TRUE(text.ends_with("save it to a file, and name one as 'FILE/a/lake.geojson'")) << text;
  }
}

// A .dbf of an old program, which does not state its encoding.
TEST_F(ReadCoastline, TextsWithoutAnEncodingBecomeUtf8) {
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("ESRI Shapefile");
  {
    const std::unique_ptr<GDALDataset> made(driver->Create(path("old.shp").c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    const char* const raw[] = {"ENCODING=", nullptr};
    OGRLayer* const layer = made->CreateLayer("old", nullptr, wkbPolygon, const_cast<char**>(raw));
    OGRFieldDefn name("name", OFTString);
    ASSERT_EQ(layer->CreateField(&name), OGRERR_NONE);
    for (const char* const text : {"M\xfcggelsee", "plain", "\x8cuvre"}) {
      OGRFeature feature(layer->GetLayerDefn());
      OGRGeometry* shape = nullptr;
      OGRGeometryFactory::createFromWkt("POLYGON((0 0,1 0,1 1,0 0))", nullptr, &shape);
      feature.SetGeometryDirectly(shape);
      feature.SetField("name", text);
      ASSERT_EQ(layer->CreateFeature(&feature), OGRERR_NONE);
    }
  }
  std::filesystem::remove(path("old.cpg"));
  ReadReport report;
  const Coastline read = readCoastline({path("old.shp")}, report);
  ASSERT_EQ(read.features.size(), 3u);
  const std::vector<std::string> names{"Müggelsee", "plain", "Œuvre"};
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(read.features[i].attributes.front().second, names[i]);
  const auto saysEncoding = [](const std::string& text) { return text.find("Windows-1252") != text.npos; };
  EXPECT_EQ(std::ranges::count_if(report.warnings, saysEncoding), 1);
}

TEST_F(ReadCoastline, LayersOfArchives) {
  const auto shapefile = [&](const std::string& name, int squares) {
    std::vector<std::string> shapes;
    for (int i = 0; i < squares; ++i) shapes.push_back(squareAt(3 * i));
    geojson(name + ".geojson", shapes);
    const std::string source = path(name + ".geojson"), target = path(name + ".shp");
    const std::unique_ptr<GDALDataset> from(GDALDataset::Open(source.c_str(), GDAL_OF_VECTOR));
    GDALClose(GetGDALDriverManager()
                  ->GetDriverByName("ESRI Shapefile")
                  ->CreateCopy(target.c_str(), from.get(), FALSE, nullptr, nullptr, nullptr));
  };
  const auto zip = [&](const std::string& archive, const std::string& folder, const std::string& name) {
    for (const char* const ending : {".shp", ".shx", ".dbf", ".prj"}) {
      const std::string target = "/vsizip/" + path(archive) + "/" + folder + name + ending;
      ASSERT_EQ(CPLCopyFile(target.c_str(), path(name + ending).c_str()), 0);
    }
  };
  shapefile("lakes", 2);
  shapefile("coast", 3);
  shapefile("ponds", 1);
  for (const std::string name : {"lakes", "coast", "ponds"}) {
    zip("flat.zip", "", name);
    zip("deep.zip", "gis data/", name);
    zip("twice.zip", name + "/", "lakes");
  }
  ReadReport report;
  const auto count = [&](const std::string& source, const std::vector<std::string>& layers) {
    return readCoastline({{source}}, {layers, ""}, report).features.size();
  };
  const auto errorOf = [&](const std::string& source, const std::vector<std::string>& layers) -> std::string {
    try {
      count(source, layers);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  for (const std::string& archive : {path("flat.zip"), path("deep.zip")}) {
    EXPECT_EQ(count(archive, {"lakes"}), 2u);
    EXPECT_EQ(count(archive, {"coast"}), 3u);
    EXPECT_EQ(count(archive, {"coast", "ponds"}), 4u);
    EXPECT_EQ(count(archive + "|lakes", {}), 2u);
    EXPECT_EQ(count(archive + "|layername=coast", {}), 3u);
    const std::string several = errorOf(archive, {}), none = errorOf(archive, {"rivers"});
    for (const char* const name : {"lakes", "coast", "ponds"}) {
      EXPECT_THAT(several, HasSubstr(name));
      EXPECT_THAT(none, HasSubstr(name));
    }
    EXPECT_THAT(several, HasSubstr("--layer"));
    EXPECT_THAT(none, HasSubstr("'rivers'"));
  }
  // Only their paths distinguish them.
  EXPECT_THAT(errorOf(path("twice.zip"), {"lakes"}), HasSubstr("coast/lakes.shp"));
  EXPECT_EQ(count(path("twice.zip") + "/coast/lakes.shp", {}), 2u);
}

// Sources of other uses keep their lines separate from the coast's, and keep their points.
TEST_F(ReadCoastline, SourcesOfOtherUses) {
  const std::string coast = geojson("coast.geojson", {squareAt(0)});
  const std::string wharf = geojson("wharf.geojson", {R"({"type":"LineString","coordinates":[[0,0],[0.5,0.5]]})",
                                                      R"({"type":"Point","coordinates":[0.25,0.75]})"});
  ReadReport report;
  const Coastline read = readCoastline({{coast}, {wharf, FeatureUse::Constraint}}, {}, report);
  ASSERT_EQ(read.features.size(), 3u);
  EXPECT_EQ(report.features, 1u);
  EXPECT_EQ(read.features[1].use, FeatureUse::Constraint);
  EXPECT_EQ(read.features[1].lines.size(), 1u);
  EXPECT_EQ(read.features[2].points, (std::vector<Point>{{0.25, 0.75}}));
}

}  // namespace
}  // namespace coastmesh
