#include "gis/read/osm_ways.hpp"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>

#include <algorithm>

#include "gis/coast/feature_names.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

// A configuration of GDAL's driver in which no closed way is a polygon. The layer `lines` has the attributes that GDAL
// gives it without one, and those of shores and waters.
constexpr std::string_view kWaysAsLines =
    "closed_ways_are_polygons=\n"
    "[points]\nosm_id=yes\nattributes=name\n"
    "[lines]\nosm_id=yes\n"
    "attributes=name,natural,place,water,waterway,man_made,barrier,highway,railway,aerialway\n"
    "[multipolygons]\nosm_id=yes\nattributes=name,type\n"
    "[multilinestrings]\nosm_id=yes\nattributes=name,type\n"
    "[other_relations]\nosm_id=yes\nattributes=name,type\n";

// GDAL takes a configuration as a file only.
const char* configurationFile() {
  constexpr const char* kPath = "/vsimem/coastmesh_osm_ways.ini";
  [[maybe_unused]] static const bool written = [] {
    static std::string text(kWaysAsLines);
    return VSIFCloseL(VSIFileFromMemBuffer(kPath, reinterpret_cast<GByte*>(text.data()), text.size(), FALSE)) == 0;
  }();
  return kPath;
}

bool isConfigured() { return CPLGetConfigOption("OSM_CONFIG_FILE", nullptr) != nullptr; }

std::string_view attributeOf(const OGRFeature& feature, const char* name) {
  const int field = feature.GetFieldIndex(name);
  return field >= 0 && feature.IsFieldSetAndNotNull(field) ? feature.GetFieldAsString(field) : std::string_view();
}

}  // namespace

bool isOsm(GDALDataset& dataset) { return dataset.GetDriverName() == std::string_view("OSM"); }

void readWaysAsLines(const std::string& path, const std::vector<std::string>& wanted,
                     std::unique_ptr<GDALDataset>& dataset) {
  if (wanted != std::vector<std::string>{"lines"} || !isOsm(*dataset) || isConfigured()) return;
  const CPLStringList options(CSLSetNameValue(nullptr, "CONFIG_FILE", configurationFile()));
  constexpr unsigned kHow = GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR;
  dataset.reset(GDALDataset::Open(path.c_str(), kHow, nullptr, options.List()));
}

void refuseOsmCoast(const OGRFeature& feature, const std::vector<OGRLayer*>& layers, const std::string& name) {
  const auto isLines = [](OGRLayer* layer) { return layer->GetName() == std::string_view("lines"); };
  if (layers.size() < 2 || std::ranges::none_of(layers, isLines) || isConfigured()) return;
  if (attributeOf(feature, "natural") != "coastline" &&
      attributeOf(feature, "other_tags").find("\"natural\"=>\"coastline\"") == std::string_view::npos)
    return;
  throw InputError(sourceInWords(name) + ": its coastlines are in several layers, as lines and as polygons; " +
                   std::string(kHowToReadOsmCoasts));
}

}  // namespace coastmesh
