#include "gis/read/near_box.hpp"

#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/metric.hpp"
#include "gis/read/read_coastline.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using Fids = std::vector<std::int64_t>;

class NearBox : public ::testing::Test {
 protected:
  // Writes squares of a degree to a layer, each given by its south-western corner, and a feature without a geometry.
  std::string layer(const std::string& name, const std::vector<Point>& corners, OGRwkbGeometryType type = wkbPolygon,
                    const std::string& index = "YES") const {
    GDALAllRegister();
    const std::string path = folder_ / name;
    const std::unique_ptr<GDALDataset> dataset(
        GetGDALDriverManager()->GetDriverByName("GPKG")->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    OGRSpatialReference srs;
    srs.SetFromUserInput("EPSG:4326");
    srs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const std::string option = "SPATIAL_INDEX=" + index;
    const char* options[] = {option.c_str(), nullptr};
    OGRLayer* const made = dataset->CreateLayer("the \"lakes\"", &srs, type, const_cast<char**>(options));
    for (const Point& at : corners) {
      OGRFeature feature(made->GetLayerDefn());
      OGRLinearRing ring;
      for (const Point& p : {at, at + Point{1, 0}, at + Point{1, 1}, at + Point{0, 1}, at}) ring.addPoint(p.x, p.y);
      OGRPolygon polygon;
      polygon.addRing(&ring);
      EXPECT_EQ(feature.SetGeometry(&polygon), OGRERR_NONE);
      EXPECT_EQ(made->CreateFeature(&feature), OGRERR_NONE);
    }
    OGRFeature empty(made->GetLayerDefn());
    EXPECT_EQ(made->CreateFeature(&empty), OGRERR_NONE);
    return path;
  }

  Fids fidsNear(const std::string& path, const Box& box) {
    ReadFilter filter;
    filter.near = box;
    Fids fids;
    report_ = {};
    for (const Feature& feature : readCoastline({Source{.path = path}}, filter, report_).features)
      fids.push_back(feature.fid);
    return fids;
  }

  testing::TemporaryFolder folder_;
  ReadReport report_;
};

TEST_F(NearBox, FeaturesFarAwayAreCountedOnly) {
  const std::string lakes = layer("lakes.gpkg", {{50, 0}, {-179.5, 0}, {0, 0}, {178, 0}, {2, 0}, {0, 30}});
  EXPECT_EQ(fidsNear(lakes, {0.5, 0.5, 0.7, 0.7}), (Fids{3}));
  EXPECT_EQ(report_.not_read, 5u);
  EXPECT_EQ(report_.features, 6u);
  // Framing keeps what lies within a tenth of the box around it.
  EXPECT_EQ(fidsNear(lakes, {-9.0, 0.0, 1.0, 28.0}), (Fids{3, 5, 6}));
  EXPECT_EQ(fidsNear(lakes, {177.0, -1.0, -179.0, 1.0}), (Fids{2, 4}));
  EXPECT_EQ(fidsNear(lakes, {360.2, 0.2, 360.4, 0.4}), (Fids{3}));
  EXPECT_EQ(fidsNear(lakes, {-180.0, 25.0, 180.0, 35.0}), (Fids{6}));
}

TEST_F(NearBox, AllAreReadWhereNoneIsNearOrTheirPlaceIsUnknown) {
  const std::vector<Point> corners{{50, 0}, {0, 0}};
  EXPECT_EQ(fidsNear(layer("none.gpkg", corners), {20, 0, 21, 1}), (Fids{1, 2}));
  EXPECT_EQ(report_.not_read, 0u);
  EXPECT_EQ(fidsNear(layer("any.gpkg", corners, wkbUnknown), {0, 0, 1, 1}), (Fids{1, 2}));
  EXPECT_EQ(fidsNear(layer("plain.gpkg", corners, wkbPolygon, "NO"), {0, 0, 1, 1}), (Fids{1, 2}));
  EXPECT_EQ(fidsNear(layer("turned.gpkg", {{200, 0}, {0, 0}}), {0, 0, 1, 1}), (Fids{1, 2}));
  EXPECT_EQ(fidsNear(layer("odd.gpkg", corners), {0, 1, 1, 0}), (Fids{1, 2}));
}

}  // namespace
}  // namespace coastmesh
