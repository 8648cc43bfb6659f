#pragma once

#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/clean/domain.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/flood_plain/flood_options.hpp"

namespace coastmesh {

struct FloodPlain {
  std::vector<Feature> features;  // see `isFloodPlain`; each has one polygon, in the coastline's CRS
  std::vector<std::string> notes;
};

// The land below `height_m` within the coastline's frames, or where rasters have heights if there is none, that is
// connected with the water of `waters` through such land. Its polygons reach into the water beside it, and beyond the
// frame. Land without a height is not part of it; land that is not connected is noted. REQUIRES: a height is given.
// Throws InputError.
FloodPlain floodPlainOf(const Coastline& coastline, const std::vector<Domain>& waters, const FloodOptions& options,
                        const ItemLoop& loop = inOrder);

}  // namespace coastmesh
