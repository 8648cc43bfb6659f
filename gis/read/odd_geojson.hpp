#pragma once

#include <optional>
#include <string>

namespace coastmesh {

// The first geometry of a GeoJSON file that is none, in words: "feature 7: polygon 1, outer ring, vertex 2, is not a
// place ([4, null])". OGR leaves such a ring, polygon or feature out, or gives an error that does not say where. A
// feature is numbered by its integer `id`, or else from 0 on, as OGR does. `path` is anything that GDAL can open; none
// where nothing is odd, and where it is not one text of JSON.
std::optional<std::string> oddGeojson(const std::string& path);

}  // namespace coastmesh
