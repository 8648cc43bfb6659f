#include "gis/sample/stored_tiles.hpp"

#include <algorithm>
#include <optional>

namespace coastmesh {

StoredTile tileAt(const RasterBand& raster, std::int64_t column, std::int64_t row) {
  return {row / raster.tileRows(), column / raster.tileColumns()};
}

std::vector<std::size_t> endsOfTiles(std::size_t count, const std::function<StoredTile(std::size_t i)>& tile_of) {
  std::vector<std::size_t> ends;
  for (std::size_t i = 1; i < count; ++i)
    if (tile_of(i) != tile_of(i - 1)) ends.push_back(i);
  if (count > 0) ends.push_back(count);
  return ends;
}

void forEachTile(const RasterBand& raster, const std::vector<std::size_t>& ends, std::size_t least_items,
                 const ItemLoop& loop, const RunControl& control,
                 const std::function<void(const RasterBand& raster, std::size_t first, std::size_t last)>& use) {
  if (ends.empty()) return;
  // The first tile of each share; shares consist of whole tiles.
  constexpr std::size_t kMostShares = 16;
  const std::size_t length = std::max(least_items, ends.back() / kMostShares + 1);
  const auto beginOf = [&](std::size_t tile) { return tile == 0 ? 0 : ends[tile - 1]; };
  std::vector<std::size_t> shares{0};
  for (std::size_t tile = 1; tile < ends.size(); ++tile)
    if (beginOf(tile) - beginOf(shares.back()) >= length) shares.push_back(tile);
  loop(shares.size(), [&](std::size_t s) {
    std::optional<RasterBand> own;
    if (shares.size() > 1) own.emplace(raster.reopened());
    const std::size_t end = s + 1 < shares.size() ? shares[s + 1] : ends.size();
    for (std::size_t tile = shares[s]; tile < end; ++tile) {
      if (control.cancelled && control.cancelled()) throw Cancelled();
      use(own ? *own : raster, beginOf(tile), ends[tile]);
    }
  });
}

}  // namespace coastmesh
