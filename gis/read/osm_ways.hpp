#pragma once

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace coastmesh {

// Coastlines of OpenStreetMap are ways with the tag natural=coastline. As GDAL reads them without a configuration, its
// layer `lines` has no attribute `natural`, and closed ways, such as islands, are polygons: in its layer
// `multipolygons`, or there only as a part of a relation without that tag.

inline constexpr std::string_view kHowToReadOsmCoasts =
    "coastlines of OpenStreetMap are read with --layer lines --where \"natural = 'coastline'\"";

bool isOsm(GDALDataset& dataset);

// If the only layer wanted of an OpenStreetMap file is `lines`, opens it again so that all its ways are in that layer,
// closed or not, with an attribute `natural`. Not if the user configured GDAL's driver (OSM_CONFIG_FILE).
void readWaysAsLines(const std::string& path, const std::vector<std::string>& wanted,
                     std::unique_ptr<GDALDataset>& dataset);

// Throws InputError if the feature is a coastline, and `layers`, those to be read of the OpenStreetMap file `name`, do
// not have all coastlines, or have them both as lines and as polygons.
void refuseOsmCoast(const OGRFeature& feature, const std::vector<OGRLayer*>& layers, const std::string& name);

}  // namespace coastmesh
