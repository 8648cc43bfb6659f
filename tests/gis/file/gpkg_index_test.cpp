#include "gis/file/gpkg_index.hpp"

#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <memory>

#include "gis/format/write_ogr.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

using testing::sampleGrid;
using testing::TemporaryFolder;

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using DatasetPtr = std::unique_ptr<GDALDataset, CloseDataset>;

DatasetPtr open(const std::string& path) {
  GDALAllRegister();
  return DatasetPtr(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE));
}

std::string ask(GDALDataset& dataset, const std::string& sql) {
  OGRLayer* const result = dataset.ExecuteSQL(sql.c_str(), nullptr, nullptr);
  if (result == nullptr) return CPLGetLastErrorMsg();
  const OGRFeatureUniquePtr row(result->GetNextFeature());
  const std::string value = row ? row->GetFieldAsString(0) : "no row";
  dataset.ReleaseResultSet(result);
  return value;
}

// SQLite's own check of its index.
std::string checkIndex(GDALDataset& dataset, const std::string& layer) {
  return ask(dataset, "SELECT rtreecheck('rtree_" + layer + "_geom')");
}

class GeoPackageIndexTest : public ::testing::TestWithParam<int> {};

// Trees of one, two and three levels.
INSTANTIATE_TEST_SUITE_P(Cells, GeoPackageIndexTest, ::testing::Values(2, 6, 30));

TEST_P(GeoPackageIndexTest, IsSoundAndHasEveryRow) {
  const TemporaryFolder folder;
  const Grid grid = sampleGrid(parseCrs("EPSG:32616"), {448123.4, 4.8e6}, 250.0, GetParam());
  writeGeoPackage(grid, folder / "lakes.gpkg");
  const DatasetPtr dataset = open(folder / "lakes.gpkg");
  ASSERT_NE(dataset, nullptr);
  for (const char* layer : {"triangles", "nodes", "boundaries"}) {
    EXPECT_EQ(checkIndex(*dataset, layer), "ok") << layer;
    const std::string rows = ask(*dataset, std::string("SELECT count(*) FROM ") + layer);
    EXPECT_EQ(ask(*dataset, std::string("SELECT count(*) FROM rtree_") + layer + "_geom"), rows) << layer;
    EXPECT_TRUE(dataset->GetLayerByName(layer)->TestCapability(OLCFastSpatialFilter)) << layer;
  }
}

TEST_P(GeoPackageIndexTest, FindsWhatLiesInABox) {
  const TemporaryFolder folder;
  const Grid grid = sampleGrid(wgs84(), {-87.5, 43.1}, 0.01, GetParam());
  writeGeoPackage(grid, folder / "lakes.gpkg");
  const DatasetPtr dataset = open(folder / "lakes.gpkg");
  ASSERT_NE(dataset, nullptr);
  OGRLayer* const layer = dataset->GetLayerByName("nodes");
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> part(-0.1, 1.1);
  const double width = 0.01 * (2 * GetParam() + 1), height = 0.01 * GetParam();
  for (int i = 0; i < 50; ++i) {
    const double west = -87.5 + width * part(random), south = 43.1 + height * part(random);
    const double east = west + 0.03, north = south + 0.02;
    layer->SetSpatialFilterRect(west, south, east, north);
    const auto inside = [&](const Point& p) { return p.x >= west && p.x <= east && p.y >= south && p.y <= north; };
    std::int64_t found = 0;  // counted one by one: OGR's count uses only the index, whose boxes are rounded
    for (const auto& feature : *layer) found += feature->GetFID() > 0;
    EXPECT_EQ(found, std::ranges::count_if(grid.nodes, inside));
  }
}

// So many rows that several threads sort them, with two levels of merging.
TEST(GeoPackageIndex, OfManyRowsIsSound) {
  const TemporaryFolder folder;
  writeGeoPackage(sampleGrid(wgs84(), {-87.5, 43.1}, 0.0001, 200), folder / "lakes.gpkg", testing::backwards);
  const DatasetPtr dataset = open(folder / "lakes.gpkg");
  const std::string rows = ask(*dataset, "SELECT count(*) FROM triangles");
  EXPECT_GT(std::stoi(rows), 2 * 65536);
  EXPECT_EQ(ask(*dataset, "SELECT count(DISTINCT id) FROM rtree_triangles_geom"), rows);
  EXPECT_EQ(checkIndex(*dataset, "triangles"), "ok");
  // In slices: few nodes of the tree are around any one place.
  const int nodes =
      std::stoi(ask(*dataset,
                    "SELECT count(DISTINCT nodeno) FROM rtree_triangles_geom_rowid WHERE rowid IN (SELECT id FROM "
                    "rtree_triangles_geom WHERE minx < -87.48 AND maxx > -87.481 AND miny < 43.11 AND maxy > 43.109)"));
  EXPECT_GE(nodes, 1);
  EXPECT_LE(nodes, 20);
}

// The index follows edits of the file.
TEST_P(GeoPackageIndexTest, FollowsEdits) {
  const TemporaryFolder folder;
  writeGeoPackage(sampleGrid(wgs84(), {-87.5, 43.1}, 0.01, GetParam()), folder / "lakes.gpkg");
  {
    const DatasetPtr dataset = open(folder / "lakes.gpkg");
    OGRLayer* const layer = dataset->GetLayerByName("nodes");
    for (GIntBig fid : {1, 3, 4}) EXPECT_EQ(layer->DeleteFeature(fid), OGRERR_NONE);
    OGRFeature added(layer->GetLayerDefn());
    const OGRPoint place(10.0, 20.0, 0.0);
    added.SetGeometry(&place);
    EXPECT_EQ(layer->CreateFeature(&added), OGRERR_NONE);
  }
  const DatasetPtr dataset = open(folder / "lakes.gpkg");
  EXPECT_EQ(checkIndex(*dataset, "nodes"), "ok");
  OGRLayer* const layer = dataset->GetLayerByName("nodes");
  layer->SetSpatialFilterRect(9.0, 19.0, 11.0, 21.0);
  EXPECT_EQ(layer->GetFeatureCount(), 1);
}

}  // namespace
}  // namespace coastmesh
