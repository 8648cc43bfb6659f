#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/geometry/box.hpp"
#include "gis/read/raw_layer.hpp"
#include "gis/read/read_report.hpp"
#include "gis/read/source.hpp"

namespace coastmesh {

// Layers of one source that contain polygons or lines (or points, for constraints), in the file's order; at least one.
// Counts go to `report`.
std::vector<RawLayer> readLayers(const Source& source, const ReadFilter& filter, ReadReport& report);

}  // namespace coastmesh
