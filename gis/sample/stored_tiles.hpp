#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "gis/raster/raster_band.hpp"

namespace coastmesh {

// A tile of a raster as its file stores it.
struct StoredTile {
  std::int64_t row = 0;
  std::int64_t column = 0;

  friend auto operator<=>(const StoredTile&, const StoredTile&) = default;
};

// The tile of a pixel.
StoredTile tileAt(const RasterBand& raster, std::int64_t column, std::int64_t row);

// The end of each tile's items, for items ordered by tile. `tile_of(i)` is the tile of item i.
std::vector<std::size_t> endsOfTiles(std::size_t count, const std::function<StoredTile(std::size_t i)>& tile_of);

// Calls `use(raster, first, last)` for the items of each tile, `first` up to `last`. If there are more items than
// `least_items`, tiles are read concurrently by separately opened rasters, since a GDAL data set serves one thread
// only. Throws what `use` throws, InputError, and Cancelled.
void forEachTile(const RasterBand& raster, const std::vector<std::size_t>& ends, std::size_t least_items,
                 const ItemLoop& loop, const RunControl& control,
                 const std::function<void(const RasterBand& raster, std::size_t first, std::size_t last)>& use);

}  // namespace coastmesh
