#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/raster/raster_parts.hpp"
#include "gis/size/raster_tiles.hpp"

namespace coastmesh {

// Several readers of rasters, numbered from 0, the caller. Results do not depend on which one reads a raster.
struct RasterReaders {
  PixelReaders pixels;
  // Like `pixels.read`.
  std::function<std::vector<TileAnswer>(std::span<const TileTask> tasks, std::span<const int> who,
                                        const ItemLoop& loop)>
      read;
};

}  // namespace coastmesh
