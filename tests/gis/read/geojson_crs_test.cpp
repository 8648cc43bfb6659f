#include "gis/read/geojson_crs.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "gis/error.hpp"
#include "gis/read/read_coastline.hpp"
#include "gis/rivers/river_lines.hpp"
#include "gis/size/size_features.hpp"

namespace coastmesh {
namespace {

class GeojsonCrs : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("coastmesh-crs-") + info->name() + "-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // A file with members before and after its one feature, a square `width` wide.
  std::string write(const std::string& before, const std::string& after, double width) const {
    const std::string w = std::to_string(width);
    const std::string ring = "[[0,0],[" + w + ",0],[" + w + "," + w + "],[0," + w + "],[0,0]]";
    std::string path = (folder_ / "coast.geojson").string();
    std::ofstream(path) << R"({"type":"FeatureCollection",)" << before
                        << R"("features":[{"type":"Feature","properties":{"crs":"none","size":100},"geometry":)"
                        << R"({"type":"Polygon","coordinates":[)" << ring << "]}}]" << after << "}";
    return path;
  }
  static std::string named(const std::string& name) {
    return R"("crs":{"type":"name","properties":{"name":")" + name + R"("}})";
  }
  std::string crsOf(const std::string& path) const {
    ReadReport report;
    return nameOf(readCoastline({path}, report).crs);
  }
  template <typename Read>
  void expectRefused(const std::string& crs, Read&& read) const {
    try {
      read();
      ADD_FAILURE() << "was read";
    } catch (const InputError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("coast.geojson"), std::string::npos) << text;
      EXPECT_NE(text.find(crs + ": correct it"), std::string::npos) << text;
    }
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(GeojsonCrs, OneThatIsNotKnownIsRefused) {
  for (const double width : {1.0, 500000.0}) {
    const auto refuse = [&](const std::string& member, const std::string& words) {
      expectRefused(words, [&] { crsOf(write(member + ",", "", width)); });
      expectRefused(words, [&] { crsOf(write("", "," + member, width)); });
    };
    refuse(named("urn:ogc:def:crs:EPSG::999999"), "'urn:ogc:def:crs:EPSG::999999'");
    refuse(named("EPGS:32631"), "'EPGS:32631'");
    refuse(R"("crs":{"type":"EPSG","properties":{"code":999999}})", "EPSG:999999");
    refuse(R"("crs":{"type":"name","properties":{"name":32631}})", R"({"name":32631},"type":"name"})");
    refuse(R"("crs":"EPSG:32631")", R"("EPSG:32631")");
  }
}

TEST_F(GeojsonCrs, KnownOnesAreTaken) {
  EXPECT_EQ(crsOf(write("", "", 1.0)), "EPSG:4326");
  EXPECT_EQ(crsOf(write(named("urn:ogc:def:crs:OGC:1.3:CRS84") + ",", "", 1.0)), "EPSG:4326");
  EXPECT_EQ(crsOf(write("", "," + named("EPSG:32631"), 5000.0)), "EPSG:32631");
  EXPECT_EQ(crsOf(write(R"("crs":{"type":"EPSG","properties":{"code":32631}},)", "", 5000.0)), "EPSG:32631");
  EXPECT_EQ(crsOf(write(R"("crs":null,)", "", 1.0)), "EPSG:4326");
}

// As another member's part, or behind many others, it does not count.
TEST_F(GeojsonCrs, OnlyTheMemberOfTheFileCounts) {
  EXPECT_EQ(crsOf(write(R"("note":{"crs":"EPGS:1"},"list":["crs",{"crs":1}],)", "", 1.0)), "EPSG:4326");
}

// A file of more than twice the bytes that are searched at each end.
TEST_F(GeojsonCrs, IsFoundAtTheEndOfALargeFile) {
  const std::string long_text(400000, 'x');
  expectRefused("'EPGS:1'", [&] { crsOf(write(R"("note":")" + long_text + R"(",)", "," + named("EPGS:1"), 1.0)); });
}

TEST_F(GeojsonCrs, AllInATakenPlaneMayBeUnknown) {
  ReadReport report;
  ReadFilter filter;
  filter.unsaid_in_plane = true;
  const std::vector<Source> sources{{write(named("a grid of ours") + ",", "", 500000.0)}};
  EXPECT_NO_THROW(readCoastline(sources, filter, report));
}

TEST_F(GeojsonCrs, SizesAndRiversAreRefusedToo) {
  const std::string path = write(named("EPGS:1") + ",", "", 1.0);
  expectRefused("'EPGS:1'", [&] { readSizedFeatures(path, wgs84(), 0.2); });
  expectRefused("'EPGS:1'", [&] { readRiverLines(path, wgs84(), {}, 10.0); });
}

}  // namespace
}  // namespace coastmesh
