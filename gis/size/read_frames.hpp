#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/raster/raster_parts.hpp"
#include "gis/size/raster_frame.hpp"
#include "gis/size/raster_tiles.hpp"
#include "gis/size/size_rule.hpp"

namespace coastmesh {

// Several readers of rasters, numbered from 0, the caller. Results do not depend on which one reads a raster.
struct RasterReaders {
  PixelReaders pixels;
  // Like `pixels.read`.
  std::function<std::vector<TileAnswer>(std::span<const TileTask> tasks, std::span<const int> who,
                                        const ItemLoop& loop)>
      read;
};

// Sizes of all tiles of several rasters, indexed by rule, frame and place. Pixels are read once for all rules. Throws
// InputError.
using FrameTiles = std::vector<std::vector<std::vector<SizeTile>>>;
FrameTiles readFrames(std::span<const std::shared_ptr<const RasterFrame>> frames, std::span<const TileRule> rules,
                      const ItemLoop& loop);
// The same by several readers, if that pays; null: only the caller. No pixel is read by two of them, except in rasters
// whose files overlap.
FrameTiles readFrames(std::span<const std::shared_ptr<const RasterFrame>> frames, std::span<const SizeRule> rules,
                      const RasterReaders* readers, const ItemLoop& loop);

}  // namespace coastmesh
