#pragma once

#include <gdal_priv.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/point.hpp"

namespace coastmesh {

// The box of a feature.
struct IndexEntry {
  std::int64_t fid = 0;
  Point low;
  Point high;
};

// The spatial index of a GeoPackage's layer, made whole from all boxes at once: entering rows one by one, as OGR before
// 3.7 does, takes five times as long as writing the features. Between construction, with the layer empty, and `fill`,
// with all features in it, the index knows none of them. Both return false where SQLite fails, whose message GDAL
// gives.
class GeoPackageIndex {
 public:
  GeoPackageIndex(GDALDataset& dataset, const std::string& layer, const std::string& geometry_column);

  bool create();
  bool fill(std::vector<IndexEntry> entries);

 private:
  bool run(const std::string& sql);
  std::string ask(const std::string& sql);  // the first value of the first row; empty where there is none

  GDALDataset& dataset_;
  std::string layer_;
  std::string column_;
  std::string index_;           // the name of its table
  std::string insert_trigger_;  // the SQL that makes it
};

}  // namespace coastmesh
