#pragma once

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <memory>
#include <string>
#include <vector>

#include "gis/crs/ogr_support.hpp"
#include "gis/format/grid_layers.hpp"
#include "gis/grid/map_parts.hpp"

namespace coastmesh {

// How OGR writes layers of a grid, whatever file they go to.
struct OgrWriter {
  const char* driver;
  std::vector<const char*> layer_options;
  bool table_types = false;         // flags and texts as a .dbf has them
  const char* plane_wkt = nullptr;  // what a plane is called; null: nothing
  bool hides_failures = false;      // OGR does not report when the disk is full
};

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using DatasetPtr = std::unique_ptr<GDALDataset, CloseDataset>;

// A layer of polygons or lines on the map; where some are cut, all may have several parts.
struct MapOfLayer {
  MapCutter cutter;
  bool has_parts = false;

  MapOfLayer(const Grid& grid, const GridLayer& layer);
};

// All throw OutputError, with the message that OGR gives.
[[noreturn]] void failToWrite(const std::string& path, const OgrErrors& errors);
DatasetPtr createDataset(const OgrWriter& writer, const std::string& path, const OgrErrors& errors);
// What is left in GDAL's buffers is written now; only the collected messages say whether it went well.
void closeDataset(DatasetPtr dataset, const std::string& path, const OgrErrors& errors);
OGRLayer& createLayer(GDALDataset& dataset, const std::string& path, const OgrWriter& writer, const Grid& grid,
                      const GridLayer& layer, const std::string& name, const OgrErrors& errors);
// One row after another, numbered from the first that OGR has free.
void writeFeatures(OGRLayer& target, const std::string& path, const Grid& grid, const GridLayer& layer,
                   const OgrErrors& errors);

}  // namespace coastmesh
