#pragma once

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <cerrno>
#include <memory>
#include <string>
#include <vector>

#include "gis/crs/ogr_support.hpp"
#include "gis/file/room_on_disk.hpp"
#include "gis/format/grid_layers.hpp"
#include "gis/grid/map_parts.hpp"

namespace coastmesh {

// How OGR writes layers of a grid, for any file format.
struct OgrWriter {
  const char* driver;
  std::vector<const char*> layer_options;
  bool table_types = false;         // flags and texts in the types of a .dbf
  const char* plane_wkt = nullptr;  // the CRS of a plane; null: none
  bool hides_failures = false;      // OGR does not report when the disk is full
};

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using DatasetPtr = std::unique_ptr<GDALDataset, CloseDataset>;

// A layer of polygons or lines on the map; if any is cut, all are written as multi-part geometries.
struct MapOfLayer {
  MapCutter cutter;
  bool has_parts = false;

  MapOfLayer(const Grid& grid, const GridLayer& layer);
};

// Collects the errors of writing `path`: if there is no room on the disk, that is what they say.
class OgrWriteErrors : public OgrErrors {
 public:
  explicit OgrWriteErrors(const std::string& path) : OgrErrors([path] { return whyNoRoom(path, errno); }) {
    errno = 0;  // it is only set by what fails
  }
};

// All throw OutputError, with the message that OGR gives.
[[noreturn]] void failToWrite(const std::string& path, const OgrErrors& errors);
DatasetPtr createDataset(const OgrWriter& writer, const std::string& path, const OgrErrors& errors);
// Flushes GDAL's buffers; only the collected messages show whether that succeeded.
void closeDataset(DatasetPtr dataset, const std::string& path, const OgrErrors& errors);
// For drivers that hide failures: fails unless the whole file can be read and has `rows` features.
void requireComplete(const std::string& path, std::size_t rows);
// A layer without columns; without a CRS if `srs` is null. `options` end with a null.
OGRLayer& createLayer(GDALDataset& dataset, const std::string& path, const std::string& name,
                      const OGRSpatialReference* srs, OGRwkbGeometryType type, const char* const* options);
// A layer of a grid, with its columns.
OGRLayer& createLayer(GDALDataset& dataset, const std::string& path, const OgrWriter& writer, const Grid& grid,
                      const GridLayer& layer, const std::string& name, const OgrErrors& errors);
// Writes all rows in order; OGR numbers them from its first free fid.
void writeFeatures(OGRLayer& target, const std::string& path, const Grid& grid, const GridLayer& layer,
                   const OgrErrors& errors);

}  // namespace coastmesh
