#include "gis/read/line_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "gis/error.hpp"
#include "gis/read/read_coastline.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class LineFiles : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    const std::string path = folder_ / name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  // The features as "attribute: WKT".
  static std::vector<std::string> featuresOf(const std::string& path) {
    const std::unique_ptr<GDALDataset> dataset = readLineFile(path);
    std::vector<std::string> texts;
    for (const auto& feature : *dataset->GetLayer(0)) {
      texts.push_back(feature->GetFieldAsString(0) + (": " + feature->GetGeometryRef()->exportToWkt()));
    }
    return texts;
  }
  static std::string errorOf(const std::string& path) {
    try {
      readLineFile(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  static Coastline coastOf(const std::string& path) {
    ReadReport report;
    return readCoastline({path}, report);
  }

  testing::TemporaryFolder folder_;
};

TEST_F(LineFiles, AreKnownByTheirEndings) {
  for (const char* const path : {"a.ldb", "a.LDB", "b/a.pli", "a.pliz", "a.pol", "a.i2s", "a.i3s", "a.bln"})
    EXPECT_TRUE(isLineFile(path)) << path;
  for (const char* const path : {"ldb", "a.shp", "a.pli/b", "a.poly", "a.ldb.gz"})
    EXPECT_FALSE(isLineFile(path)) << path;
}

TEST_F(LineFiles, BlocksHaveNamesCommentsHeightsAndLabels) {
  const std::string path = file("dikes.pliz",
                                "* dikes of 2021\r\n  north dike \r\n 2 5\r\n0 0 4.5 1.0 1.0\r\n10 0 4.75 1.0 1.0\r\n"
                                "* and\r\nL2\r\n2 3\r\n0 5 L2_0001\r\n1D+01 5 L2_0002\r\n");
  EXPECT_THAT(featuresOf(path), ElementsAre("north dike: LINESTRING (0 0 4.5,10 0 4.75)", "L2: LINESTRING (0 5,10 5)"));
}

TEST_F(LineFiles, MissingValuesPartALine) {
  const std::string path = file("coast.ldb", "L1\n6 2\n0 0\n1 0\n999.999 999.999\n5 0\n999.999 1.5\n-999.0 -999.0\n");
  EXPECT_THAT(featuresOf(path), ElementsAre("L1: LINESTRING (0 0,1 0)", "L1: LINESTRING (5 0,999.999 1.5)"));
}

TEST_F(LineFiles, ASinglePointIsAPoint) {
  EXPECT_THAT(featuresOf(file("intake.pli", "in\n1 3\n3 4 -2\n")), ElementsAre("in: POINT (3 4 -2)"));
}

TEST_F(LineFiles, RingsOfAPolAreClosed) {
  const std::string path = file("area.pol", "a\n3 2\n0 0\n9 0\n9 9\nb\n4 2\n1 1\n2 1\n2 2\n1 1\n");
  EXPECT_THAT(featuresOf(path), ElementsAre("a: LINESTRING (0 0,9 0,9 9,0 0)", "b: LINESTRING (1 1,2 1,2 2,1 1)"));
  EXPECT_THAT(featuresOf(file("parts.pol", "a\n7 2\n0 0\n9 0\n9 9\n999.999 999.999\n1 1\n2 1\n2 2\n")),
              ElementsAre("a: LINESTRING (0 0,9 0,9 9,0 0)", "a: LINESTRING (1 1,2 1,2 2,1 1)"));
  // As a coast: a lake with an island.
  const Coastline coast = coastOf(path);
  ASSERT_EQ(coast.features.size(), 1u);
  ASSERT_EQ(coast.features[0].polygons.size(), 1u);
  EXPECT_EQ(coast.features[0].polygons[0].holes.size(), 1u);
}

TEST_F(LineFiles, LineSetsOfBlueKenue) {
  const std::string header = "#####\n:FileType i2s  ASCII  EnSim 1.0\n# DataType  2D Line Set\n:Name shore\n";
  const std::string lines = ":EndHeader\n2 1.5\n0 50\n1 50\n\n3 0\n1 50\n1 51\n0 50\n";
  const std::string plane = file("shore.i2s", header + ":Projection Cartesian\n" + lines);
  EXPECT_THAT(featuresOf(plane), ElementsAre("1.5: LINESTRING (0 50,1 50)", "0: LINESTRING (1 50,1 51,0 50)"));
  EXPECT_EQ(readLineFile(plane)->GetLayer(0)->GetSpatialRef(), nullptr);
  const std::string degrees = file("degrees.i2s", header + ":Projection LatLong\n:Ellipsoid WGS84\n" + lines);
  EXPECT_TRUE(coastOf(degrees).crs.geographic);
  EXPECT_THAT(featuresOf(file("up.i3s", ":FileType i3s ASCII EnSim 1.0\n:EndHeader\n2\n0 0 7.5\n1 0 8\n")),
              ElementsAre("0: LINESTRING (0 0 7.5,1 0 8)"));
}

TEST_F(LineFiles, BlankingFilesOfSurfer) {
  EXPECT_THAT(featuresOf(file("lake.bln", "4,1,\"Upper Lake\"\n0,0\n9,0\n9,9\n0,0\n2 0\n1 1\n2 2\n")),
              ElementsAre("Upper Lake: LINESTRING (0 0,9 0,9 9,0 0)", ": LINESTRING (1 1,2 2)"));
}

TEST_F(LineFiles, TheCrsIsThatOfAPrjBeside) {
  const std::string path =
      file("coast.ldb", "L1\n4 2\n500000 5600000\n501000 5600000\n501000 5601000\n500000 5600000\n");
  EXPECT_TRUE(coastOf(path).crs.isPlane());
  OGRSpatialReference utm;
  utm.importFromEPSG(32631);
  char* wkt = nullptr;
  utm.exportToWkt(&wkt);
  file("coast.prj", wkt);
  CPLFree(wkt);
  EXPECT_EQ(coastOf(path).crs.authority, "EPSG:32631");
}

TEST_F(LineFiles, ErrorsNameTheLine) {
  EXPECT_THAT(errorOf(file("a.ldb", "L1\n2 2\n0 0\n")), HasSubstr("the block 'L1' ends after 1 of 2 points"));
  EXPECT_THAT(errorOf(file("b.ldb", "L1\n2 2\n0 0\n1 y\n")), AllOf(HasSubstr("b.ldb"), HasSubstr("4")));
  EXPECT_THAT(errorOf(file("c.ldb", "L1\n")), HasSubstr("'L1' has no counts"));
  EXPECT_THAT(errorOf(file("d.ldb", "L1\n2 1\n0\n1\n")), HasSubstr("1 column"));
  EXPECT_THAT(errorOf(file("e.pli", "L1\n99999999999 2\n0 0\n")), HasSubstr("more than the file can hold"));
  EXPECT_THAT(errorOf(file("f.i2s", ":FileType i2s ASCII EnSim 1.0\n2 0\n")), HasSubstr("no :EndHeader"));
  EXPECT_THAT(errorOf(file("g.i2s", ":FileType i2s BINARY EnSim 1.0\n:EndHeader\n")), HasSubstr("binary"));
  EXPECT_THAT(errorOf(file("h.i2s", ":EndHeader\n3 0\n0 0\n1 1\n")), HasSubstr("ends too early"));
  EXPECT_THAT(errorOf(file("i.bln", "2,1\n0,0\n")), HasSubstr("ends too early"));
  EXPECT_THAT(errorOf(file("j.ldb", "")), HasSubstr("empty"));
}

}  // namespace
}  // namespace coastmesh
