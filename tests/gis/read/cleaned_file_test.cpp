// Files of `coastmesh clean` that were edited or damaged.
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gis/error.hpp"
#include "gis/read/cleaned_layers.hpp"
#include "gis/read/read_coastline.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/damaged_geopackage.hpp"

namespace coastmesh {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

class CleanedFile : public ::testing::Test {
 protected:
  using Values = std::vector<std::pair<const char*, std::string>>;

  void SetUp() override {
    GDALAllRegister();
    dataset_.reset(GetGDALDriverManager()->GetDriverByName("GPKG")->Create(path().c_str(), 0, 0, 0, GDT_Unknown, {}));
    addLayer(kPslgLayer, {"region", "left_fid", "right_fid", "left_id", "right_id", "line_id", "first", "last"},
             {"kind"});
    addLayer(kVertexLayer, {"region", "number"}, {});
    addLayer(kRegionLayer, {"feature_id"}, {});
    addLayer(kEditLayer, {"fid_of_feature"}, {"kind"});
    addLayer(kFeatureLayer, {"id", "fid_of_feature"}, {"source"});
    addLayer(kAttributeLayer, {"feature_id"}, {"name", "value"});
  }

  std::string path() const { return folder_ / "cleaned.gpkg"; }

  void addRow(const char* layer, const std::string& wkt, const Values& values) {
    OGRLayer* const to = dataset_->GetLayerByName(layer);
    OGRFeature row(to->GetLayerDefn());
    for (const auto& [field, value] : values) row.SetField(field, value.c_str());
    OGRGeometry* shape = nullptr;
    if (!wkt.empty()) OGRGeometryFactory::createFromWkt(wkt.c_str(), nullptr, &shape);
    row.SetGeometryDirectly(shape);
    EXPECT_EQ(to->CreateFeature(&row), OGRERR_NONE);
  }

  // A triangle of three edges; the last has an additional point. Numbers count from 1.
  void addLake(int number) {
    const std::string id = std::to_string(number), x = std::to_string(number), above = std::to_string(number + 0.5);
    addRow(kFeatureLayer, "", {{"id", id}, {"fid_of_feature", id}, {"source", "lakes"}});
    const auto edge = [&](const std::string& chain, const char* first, const char* last) {
      addRow(kPslgLayer, "LINESTRING(" + chain + ")",
             {{"kind", "shore"},
              {"region", id},
              {"left_fid", id},
              {"right_fid", "-1"},
              {"left_id", id},
              {"right_id", "0"},
              {"first", first},
              {"last", last}});
    };
    edge(x + " 0, " + above + " 0", "0", "1");
    edge(above + " 0, " + x + " 0.5", "1", "2");
    edge(x + " 0.5, " + x + " 0.25, " + x + " 0", "2", "0");
  }

  Coastline read() {
    dataset_.reset();
    return readCoastline(std::vector{path()}, report_);
  }

  std::string refusal(FeatureUse use = FeatureUse::Area) {
    dataset_.reset();
    try {
      readCoastline({{path(), use}}, {}, report_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "it was read";
  }

  ReadReport report_;

 private:
  void addLayer(const char* name, const std::vector<const char*>& numbers, const std::vector<const char*>& texts) {
    OGRLayer* const layer = dataset_->CreateLayer(name, nullptr, wkbUnknown, nullptr);
    const auto add = [&](const char* field, OGRFieldType type) {
      OGRFieldDefn definition(field, type);
      EXPECT_EQ(layer->CreateField(&definition), OGRERR_NONE);
    };
    for (const char* field : numbers) add(field, OFTInteger64);
    for (const char* field : texts) add(field, OFTString);
  }

  TemporaryFolder folder_;
  std::unique_ptr<GDALDataset> dataset_;
};

TEST_F(CleanedFile, IsReadAsAreas) {
  addLake(1);
  addLake(2);
  const Coastline coastline = read();
  EXPECT_TRUE(report_.cleaned);
  ASSERT_EQ(coastline.features.size(), 2u);
  EXPECT_EQ(coastline.features[1].fid, 2);
  ASSERT_EQ(coastline.features[1].polygons.size(), 1u);
  EXPECT_EQ(coastline.features[1].polygons[0].outer.size(), 4u);
  EXPECT_EQ(report_.points, 14u);
  EXPECT_EQ(report_.skipped_empty, 0u);
}

// Its areas must not become part of the domain if it is given for something else.
TEST_F(CleanedFile, IsOnlyAnInputUnlessALayerIsNamed) {
  addLake(1);
  addRow(kRegionLayer, "POLYGON((1 0, 1.25 0, 1 0.25, 1 0))", {{"feature_id", "1"}});
  for (const FeatureUse use : {FeatureUse::Constraint, FeatureUse::Weir, FeatureUse::Frame})
    EXPECT_THAT(refusal(use), HasSubstr("name it, such as " + path() + "|pslg"));
  EXPECT_THAT(refusal(FeatureUse::Region), HasSubstr("name it, such as " + path() + "|regions"));
  const Coastline named = readCoastline(
      {{path() + "|regions"}, {path() + "|pslg", FeatureUse::Constraint}, {path() + "|pslg", FeatureUse::Frame}}, {},
      report_);
  EXPECT_FALSE(report_.cleaned);
  ASSERT_EQ(named.features.size(), 5u);
  EXPECT_EQ(named.features[0].use, FeatureUse::Area);
  EXPECT_EQ(named.features[1].use, FeatureUse::Frame);
  EXPECT_EQ(named.features[1].polygons.at(0).outer.size(), 4u);
  for (std::size_t i = 2; i < 5; ++i) EXPECT_EQ(named.features[i].use, FeatureUse::Constraint);
}

TEST_F(CleanedFile, WithADamagedPageIsRefused) {
  for (int i = 1; i <= 400; ++i) addLake(i);
  ASSERT_EQ(read().features.size(), 400u);
  testing::damageRowsWith("shore", path());
  EXPECT_THAT(refusal(), AllOf(HasSubstr("cleaned.gpkg': cannot be read to its end"), HasSubstr("malformed")));
}

TEST_F(CleanedFile, EmptyShapesAreSkipped) {
  addLake(1);
  addRow(kPslgLayer, "LINESTRING EMPTY", {{"kind", "shore"}});
  addRow(kVertexLayer, "POINT EMPTY", {{"region", "1"}, {"number", "7"}});
  addRow(kRegionLayer, "POLYGON EMPTY", {{"feature_id", "1"}});
  addRow(kEditLayer, "POINT EMPTY", {{"kind", "crossing"}, {"fid_of_feature", "1"}});
  addRow(kRegionLayer, "", {{"feature_id", "1"}});
  addRow(kRegionLayer, "POLYGON((1 0, 1.25 0, 1 0.25, 1 0))", {{"feature_id", "1"}});
  addRow(kEditLayer, "POINT(1 0)", {{"kind", "crossing"}, {"fid_of_feature", "1"}});
  const Coastline coastline = read();
  ASSERT_EQ(coastline.features.size(), 2u);
  EXPECT_EQ(coastline.features[0].polygons.size(), 1u);
  EXPECT_EQ(coastline.features[1].use, FeatureUse::Region);
  ASSERT_EQ(coastline.features[1].polygons.size(), 1u);
  EXPECT_EQ(coastline.features[1].polygons[0].outer, (Ring{{1, 0}, {1.25, 0}, {1, 0.25}}));
  EXPECT_EQ(report_.edits.size(), 1u);
  EXPECT_EQ(report_.skipped_empty, 5u);
}

class CleanedFileBeyondAllPlaces : public CleanedFile,
                                   public ::testing::WithParamInterface<std::pair<const char*, const char*>> {};

TEST_P(CleanedFileBeyondAllPlaces, IsRefused) {
  const auto& [layer, wkt] = GetParam();
  addLake(1);
  addRow(layer, wkt, {});
  EXPECT_THAT(refusal(), AllOf(HasSubstr(std::string("cleaned.gpkg|") + layer + "', feature "),
                               HasSubstr("is not a place (1e+300, 2)")));
}

INSTANTIATE_TEST_SUITE_P(All, CleanedFileBeyondAllPlaces,
                         ::testing::Values(std::pair{kPslgLayer, "LINESTRING(0 0, 1e300 2)"},
                                           std::pair{kVertexLayer, "POINT(1e300 2)"},
                                           std::pair{kRegionLayer, "POLYGON((0 0, 1 0, 1e300 2, 0 0))"},
                                           std::pair{kEditLayer, "POINT(1e300 2)"}),
                         [](const auto& param_info) { return std::string(param_info.param.first); });

}  // namespace
}  // namespace coastmesh
