#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <memory>

#include "gis/format/write_ogr.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using testing::sampleGrid;
using testing::TemporaryFolder;

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};

std::string ask(const std::string& path, const std::string& sql) {
  GDALAllRegister();
  const std::unique_ptr<GDALDataset, CloseDataset> dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR));
  if (!dataset) return "not open";
  OGRLayer* const result = dataset->ExecuteSQL(sql.c_str(), nullptr, nullptr);
  if (result == nullptr) return CPLGetLastErrorMsg();
  const OGRFeatureUniquePtr row(result->GetNextFeature());
  std::string value = row ? row->GetFieldAsString(0) : "no row";
  dataset->ReleaseResultSet(result);
  return value;
}

// What SQLite and OGR store about the rows: their count, the next number, and their bounding box, bit for bit.
TEST(WriteGeoPackage, TheFileKnowsItsRows) {
  const TemporaryFolder folder;
  const std::string path = folder / "lakes.gpkg";
  const Grid grid = sampleGrid(wgs84(), {-87.123456789012345, 43.1}, 0.01, 6);
  writeGeoPackage(grid, path);
  EXPECT_EQ(ask(path, "PRAGMA integrity_check"), "ok");
  for (const std::string layer : {"triangles", "nodes", "boundaries"}) {
    const std::string rows = ask(path, "SELECT count(*) FROM " + layer);
    EXPECT_EQ(ask(path, "SELECT feature_count FROM gpkg_ogr_contents WHERE table_name = '" + layer + "'"), rows);
    EXPECT_EQ(ask(path, "SELECT seq FROM sqlite_sequence WHERE name = '" + layer + "'"), rows);
  }
  for (const std::string layer : {"triangles", "nodes"})
    EXPECT_EQ(ask(path, "SELECT min_x = (SELECT min(ST_MinX(geom)) FROM " + layer +
                            ") AND max_x = (SELECT max(ST_MaxX(geom)) FROM " + layer +
                            ") AND min_y = (SELECT min(ST_MinY(geom)) FROM " + layer +
                            ") AND max_y = (SELECT max(ST_MaxY(geom)) FROM " + layer +
                            ") FROM gpkg_contents WHERE table_name = '" + layer + "'"),
              "1")
        << layer;
}

// Names larger than a page of the file are written by OGR.
TEST(WriteGeoPackage, LongNames) {
  for (const std::size_t length : {std::size_t{1}, std::size_t{2300}, std::size_t{2500}, std::size_t{20000}}) {
    const TemporaryFolder folder;
    const std::string path = folder / "lakes.gpkg";
    Grid grid = sampleGrid(wgs84(), {-87.5, 43.1}, 0.01, 6);
    grid.features = {{7, "lakes.shp", {{"name", std::string(length, 'n')}}}};
    grid.feature_of.assign(grid.triangles.size(), 0);
    writeGeoPackage(grid, path);
    EXPECT_EQ(ask(path, "PRAGMA integrity_check"), "ok");
    EXPECT_EQ(ask(path, "SELECT count(*) FROM triangles WHERE length(name) = " + std::to_string(length)),
              std::to_string(grid.triangles.size()));
    EXPECT_EQ(ask(path, "SELECT rtreecheck('rtree_triangles_geom')"), "ok");
    EXPECT_EQ(ask(path, "SELECT count(*) FROM rtree_triangles_geom"), std::to_string(grid.triangles.size()));
  }
}

}  // namespace
}  // namespace coastmesh
