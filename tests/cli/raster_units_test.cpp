// Rasters whose values are not in metres.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using Json = nlohmann::json;

class RasterUnits : public ProgramTest {
 protected:
  // A raster around the lake with one value and this unit.
  std::string raster(const std::string& value, const std::string& unit) const {
    write("values.asc", "ncols 1\nnrows 1\nxllcorner -88\nyllcorner 41\ncellsize 1\n" + value + "\n");
    return write("values.vrt",
                 "<VRTDataset rasterXSize=\"1\" rasterYSize=\"1\"><SRS>EPSG:4326</SRS>"
                 "<GeoTransform>-88, 1, 0, 42, 0, -1</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\">"
                 "<UnitType>" +
                     unit +
                     "</UnitType><SimpleSource><SourceFilename relativeToVRT=\"1\">values.asc</SourceFilename>"
                     "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>");
  }
};

TEST_F(RasterUnits, OfDepthsAreConvertedAndNoted) {
  const ProgramRun run = runProgram({"mesh", lake(), "--bathymetry", raster("-0.25", "km"), "-o", file("a.14"), "-o",
                                     file("a.nc"), "--report", file("a.json")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_EQ(run.errors, "");
  EXPECT_THAT(run.output, AllOf(HasSubstr("values.vrt' is in km: its values are multiplied by 1000\n"),
                                HasSubstr("depths from 250 to 250 m")));
  const Json depth = Json::parse(readText(file("a.json")))["depth"];
  EXPECT_THAT(depth["notes"], SizeIs(1));
  EXPECT_NEAR(depth["greatest_m"].get<double>(), 250.0, 1e-4);
  const ProgramRun again =
      runProgram({"convert", file("a.nc"), "--bathymetry", raster("-10", "US survey foot"), "-o", file("b.14")});
  EXPECT_THAT(again.output, AllOf(HasSubstr("is in US survey foot"), HasSubstr("depths from 3.04801 to 3.04801 m")));
}

TEST_F(RasterUnits, OfSizesAreConvertedAndNoted) {
  const auto trianglesWith = [&](const std::string& value, const std::string& unit) {
    const ProgramRun run = runProgram({"mesh", lake(), "--size-raster", raster(value, unit), "-o", file("a.14"),
                                       "--report", file("a.json"), "--overwrite"});
    EXPECT_EQ(run.code, 0) << run.errors;
    const Json report = Json::parse(readText(file("a.json")));
    EXPECT_THAT(report["input"]["notes"], SizeIs(unit == "m" ? 0 : 1));
    return report["mesh"]["triangles"].get<int>();
  };
  EXPECT_EQ(trianglesWith("0.25", "km"), trianglesWith("250", "m"));
}

TEST_F(RasterUnits, ThatAreNoLengthsAreRefused) {
  const std::string speeds = raster("-10", "m s-1");
  for (const char* const option : {"--bathymetry", "--size-raster"}) {
    const ProgramRun run = runProgram({"mesh", lake(), option, speeds, "-o", file("a.14")});
    EXPECT_EQ(run.code, 3) << option;
    EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
    EXPECT_THAT(run.errors, AllOf(HasSubstr("values.vrt"), HasSubstr("'m s-1'")));
    EXPECT_THAT(names(), ::testing::Not(::testing::Contains("a.14")));
  }
}

}  // namespace
}  // namespace coastmesh::test
