#include <cpl_conv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "gis/error.hpp"
#include "gis/read/read_coastline.hpp"

namespace coastmesh {
namespace {

using ::testing::HasSubstr;

// A coast of two ways, and islands that are each one way: a plain one; one that is also a place; one that is a member
// of a relation without tags, round a lake; one that is a member of a relation with other tags.
constexpr const char* kOsm = R"(<?xml version="1.0"?><osm version="0.6">
<node id="1" lat="50" lon="5"/><node id="2" lat="50" lon="6"/><node id="3" lat="51" lon="6"/>
<node id="4" lat="51" lon="5"/><node id="11" lat="50.4" lon="8"/><node id="12" lat="50.4" lon="8.2"/>
<node id="13" lat="50.6" lon="8.2"/><node id="21" lat="51.4" lon="8"/><node id="22" lat="51.4" lon="8.2"/>
<node id="23" lat="51.6" lon="8.2"/><node id="24" lat="51.6" lon="8"/><node id="31" lat="51.45" lon="8.05"/>
<node id="32" lat="51.45" lon="8.1"/><node id="33" lat="51.5" lon="8.1"/><node id="41" lat="49.4" lon="8"/>
<node id="42" lat="49.4" lon="8.2"/><node id="43" lat="49.6" lon="8.2"/><node id="51" lat="49.4" lon="7"/>
<node id="52" lat="49.4" lon="7.2"/><node id="53" lat="49.6" lon="7.2"/>
<way id="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><tag k="natural" v="coastline"/></way>
<way id="2"><nd ref="3"/><nd ref="4"/><nd ref="1"/><tag k="natural" v="coastline"/></way>
<way id="3"><nd ref="11"/><nd ref="12"/><nd ref="13"/><nd ref="11"/><tag k="natural" v="coastline"/></way>
<way id="4"><nd ref="21"/><nd ref="22"/><nd ref="23"/><nd ref="24"/><nd ref="21"/>
<tag k="natural" v="coastline"/></way>
<way id="5"><nd ref="31"/><nd ref="32"/><nd ref="33"/><nd ref="31"/><tag k="natural" v="water"/></way>
<way id="6"><nd ref="41"/><nd ref="42"/><nd ref="43"/><nd ref="41"/><tag k="natural" v="coastline"/></way>
<way id="7"><nd ref="51"/><nd ref="52"/><nd ref="53"/><nd ref="51"/><tag k="natural" v="coastline"/>
<tag k="place" v="islet"/></way>
<relation id="1"><member type="way" ref="4" role="outer"/><member type="way" ref="5" role="inner"/>
<tag k="type" v="multipolygon"/></relation>
<relation id="2"><member type="way" ref="6" role="outer"/><tag k="type" v="multipolygon"/>
<tag k="place" v="island"/></relation></osm>
)";
const std::string kCoasts = "natural = 'coastline'";

class OsmWays : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("coastmesh-osm-") + info->name() + "-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    file_ = (folder_ / "coast.osm").string();
    std::ofstream(file_, std::ios::binary) << kOsm;
  }
  void TearDown() override {
    CPLSetConfigOption("OSM_CONFIG_FILE", nullptr);
    std::filesystem::remove_all(folder_);
  }

  std::string said(const Source& source, const ReadFilter& filter) const {
    try {
      ReadReport report;
      readCoastline({source}, filter, report);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_;
  std::string file_;
};

TEST_F(OsmWays, EachWayIsALineOfTheLayerLinesWhateverItsTagsAndRelations) {
  for (const auto& [source, layers] :
       {std::pair{file_, std::vector<std::string>{"lines"}}, std::pair{file_ + "|lines", std::vector<std::string>{}}}) {
    ReadReport report;
    const Coastline coast = readCoastline({{source}}, {layers, kCoasts}, report);
    // The ways of the coast are joined; (x, y) of the first points of the rings.
    EXPECT_EQ(coast.features.size(), 5u);
    std::multiset<double> islands;
    for (const Feature& feature : coast.features)
      for (const Polygon& polygon : feature.polygons)
        for (const Point& p : polygon.outer)
          if (p.x == 8 || p.x == 7) islands.insert(p.y);
    EXPECT_THAT(islands, ::testing::IsSupersetOf({49.4, 50.4, 51.4, 51.6}));
    EXPECT_EQ(islands.count(49.4), 2u);
  }
}

TEST_F(OsmWays, CoastsInSeveralLayersAreRefusedWithWhatReadsThem) {
  const char* const way_out = "--layer lines --where \"natural = 'coastline'\"";
  EXPECT_THAT(said({file_}, {{}, kCoasts}), HasSubstr(way_out));
  EXPECT_THAT(said({file_}, {}), HasSubstr(way_out));
  EXPECT_THAT(said({file_}, {{"lines", "multipolygons"}, "other_tags like '%coastline%'"}), HasSubstr(way_out));
  EXPECT_THAT(said({file_}, {{"lines"}, "other_tags like '%coastline%'"}), HasSubstr(way_out));
}

TEST_F(OsmWays, OtherLayersAreAsGdalHasThem) {
  ReadReport report;
  const Coastline lakes = readCoastline({{file_}}, {{"multipolygons"}, "natural = 'water'"}, report);
  ASSERT_EQ(lakes.features.size(), 1u);
  EXPECT_EQ(lakes.features[0].polygons[0].outer.size(), 3u);
}

TEST_F(OsmWays, AConfigurationOfTheUserIsKept) {
  const std::string configuration = (folder_ / "osmconf.ini").string();
  std::ofstream(configuration) << "closed_ways_are_polygons=natural\n[lines]\nosm_id=yes\nattributes=natural\n"
                               << "[multipolygons]\nosm_id=yes\nattributes=natural\n";
  CPLSetConfigOption("OSM_CONFIG_FILE", configuration.c_str());
  ReadReport report;
  EXPECT_EQ(readCoastline({{file_}}, {{"lines"}, kCoasts}, report).features.size(), 1u);
}

TEST_F(OsmWays, AnUnknownFieldIsAnsweredWithThoseThatExist) {
  EXPECT_THAT(said({file_}, {{"lines"}, "naturl = 'coastline'"}),
              ::testing::AllOf(HasSubstr("\"naturl\""), HasSubstr("its fields are osm_id, name, natural, ")));
  const std::string plain = (folder_ / "plain.geojson").string();
  std::ofstream(plain) << R"({"type":"Feature","properties":{"kind":"sea","area":1},"geometry":
{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]]]}})";
  EXPECT_THAT(said({plain}, {{}, "depth > 5"}), HasSubstr("; its fields are kind, area"));
}

}  // namespace
}  // namespace coastmesh
