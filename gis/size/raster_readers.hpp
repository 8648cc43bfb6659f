#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/raster/raster_parts.hpp"
#include "gis/size/raster_tiles.hpp"

namespace coastmesh {

// Several who read rasters, numbered from 0, the caller. What is made of a raster does not depend on who reads it.
struct RasterReaders {
  PixelReaders pixels;
  // As `pixels.read` does.
  std::function<std::vector<TileAnswer>(std::span<const TileTask> tasks, std::span<const int> who,
                                        const ItemLoop& loop)>
      read;
};

}  // namespace coastmesh
