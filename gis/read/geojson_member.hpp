#pragma once

#include <optional>
#include <string>

namespace coastmesh {

// A member of the outermost object of a GeoJSON file, as JSON; nullopt if there is none, or the file is not one JSON
// text. The file is read up to that member. `path` is anything that GDAL can open.
std::optional<std::string> geojsonMember(const std::string& path, const std::string& name);

// True if the file is one geometry, neither a feature nor a collection of features.
bool isBareGeometry(const std::string& path);

}  // namespace coastmesh
