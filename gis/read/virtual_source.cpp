#include "gis/read/virtual_source.hpp"

#include <cpl_string.h>
#include <gdal_priv.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string_view>

#include "gis/crs/ogr_support.hpp"

namespace coastmesh {

namespace {

// True if opening the source consumes nothing, unlike a pipe or a stream: a file, or a name that is virtual itself.
bool mayBeLookedAt(const std::string& name) {
  std::error_code error;
  const bool is_text = name.starts_with('<') || name.starts_with("vrt://");
  return is_text || std::filesystem::is_regular_file(name, error) ||
         (name.starts_with("/vsi") && name.ends_with(".vrt"));
}

bool isVirtual(const std::string& name) {
  if (!mayBeLookedAt(name)) return false;
  GDALDriverH driver = GDALIdentifyDriverEx(name.c_str(), GDAL_OF_RASTER | GDAL_OF_VECTOR, nullptr, nullptr);
  const std::string_view kind = driver == nullptr ? "" : GDALGetDriverShortName(driver);
  return kind == "VRT" || kind == "OGR_VRT";
}

}  // namespace

std::vector<std::string> filesBehind(const std::string& name) {
  registerDrivers();
  const OgrErrors caught;  // errors are reported when the source is read
  std::vector<std::string> names{name};
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!isVirtual(names[i])) continue;
    const std::unique_ptr<GDALDataset> dataset(
        GDALDataset::Open(names[i].c_str(), GDAL_OF_RASTER | GDAL_OF_VECTOR | GDAL_OF_READONLY));
    if (!dataset) continue;
    const CPLStringList files(dataset->GetFileList());
    for (int k = 0; k < files.size(); ++k)
      if (std::ranges::find(names, files[k]) == names.end()) names.emplace_back(files[k]);
  }
  names.erase(names.begin());
  return names;
}

}  // namespace coastmesh
