#pragma once

#include <optional>
#include <string>

namespace coastmesh {

// Describes the first invalid geometry of a GeoJSON file: "feature 7: polygon 1, outer ring, vertex 2, is not a place
// ([4, null])". OGR drops such a ring, polygon or feature, or reports an error without its place. A feature is numbered
// by its integer `id`, or else from 0, as by OGR. `path` is anything that GDAL can open. Returns nullopt if no geometry
// is invalid, or the file is not a single JSON text.
std::optional<std::string> oddGeojson(const std::string& path);

}  // namespace coastmesh
