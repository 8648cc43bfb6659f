#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/size/raster_frame.hpp"
#include "gis/size/raster_readers.hpp"
#include "gis/size/raster_tiles.hpp"
#include "gis/size/size_rule.hpp"

namespace coastmesh {

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
