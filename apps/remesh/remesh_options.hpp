#pragma once

#include <cstdint>
#include <vector>

#include "gis/model/depth.hpp"
#include "gis/size/size_source.hpp"
#include "parallel/mesh_regions.hpp"

namespace coastmesh {

// How a part of a grid is meshed anew.
struct RemeshOptions {
  SizeOptions sizes;   // besides those that the triangles around the part ask for; coasts are kept
  MeshOptions mesh;    // its sizes are set from `sizes`
  DepthOptions depth;  // of new nodes; those without a value in any raster keep that of the old triangles
  // Empty, or a flag for each triangle: it stays in any case. Then all that are wanted are replaced, also those that
  // `tidyCut` would leave out.
  std::vector<std::uint8_t> stay{};
};

}  // namespace coastmesh
