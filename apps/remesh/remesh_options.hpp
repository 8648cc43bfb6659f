#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gis/grid/grid.hpp"
#include "gis/model/depth.hpp"
#include "gis/size/size_source.hpp"
#include "parallel/mesh_regions.hpp"

namespace coastmesh {

// How a part of a grid is meshed anew.
struct RemeshOptions {
  SizeOptions sizes;   // besides those that the triangles around the part ask for; coasts are kept
  MeshOptions mesh;    // its sizes are set from `sizes`
  DepthOptions depth;  // of new nodes; those without a value in any raster keep that of the old triangles
  // The most new triangles, in all, that are made once more because the part takes in triangles beside it for the sake
  // of angles.
  std::size_t most_again = 300'000;
  // Empty, or a flag for each triangle: it stays in any case. Then all that are wanted are replaced, also those that
  // `tidyCut` would leave out.
  std::vector<std::uint8_t> stay{};
  // Triangles that were here before, of which the grid has some no more: they tell what of the new nodes is on the land
  // of a flood plain. Null: the grid's own triangles do.
  const Grid* before = nullptr;
};

}  // namespace coastmesh
