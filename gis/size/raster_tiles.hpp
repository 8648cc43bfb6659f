#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "gis/raster/raster_band.hpp"
#include "gis/raster/raster_mosaic.hpp"
#include "gis/size/size_rule.hpp"

namespace coastmesh {

inline constexpr int kTile = 256;  // pixels along a side of a tile, at most; a power of two

// The sizes of a tile as a quadtree over `kTile` by `kTile` pixels, with the tile in its first corner. Its leaves have
// nearly equal sizes, or sides of at most half the smallest. Node 0 is the root.
struct SizeNode {
  float low = 0.0F, high = 0.0F;  // in the cell; `high` is infinite if any part requests nothing, `low` if all does
  float most = 0.0F;              // largest `value` in the cell that is finite
  float value = 0.0F;             // of a leaf
  std::uint32_t below = 0;        // the first of four consecutive children; 0 for a leaf
};
using SizeTile = std::vector<SizeNode>;

// A tile in which nothing is requested.
SizeTile emptyTile();

struct TilePlace {
  PixelRect pixels;
  std::array<double, 2> pixel_m{};  // ground size of a pixel along columns and rows, metres
};

// Pixel values from another reader.
struct PixelPatch {
  PixelRect at;
  std::vector<float> values;  // row by row; NaN if missing
};

// A task for one reader of one raster. Its result depends on nothing else, wherever it is executed.
struct TileTask {
  std::string path;
  int columns = 0, rows = 0;        // of the raster
  std::vector<SizeRule> rules;      // at most one has a margin
  std::vector<TilePlace> tiles;     // to be converted to sizes by each rule
  std::vector<PixelRect> own;       // pixels that may be read for this; empty: all
  std::vector<PixelPatch> patches;  // the other pixels that are needed
  std::vector<PixelRect> strips;    // pixels to be returned unchanged
};

struct TileAnswer {
  std::vector<std::vector<SizeTile>> tiles;  // for each rule, in the order of the task's tiles
  std::vector<PixelPatch> strips;
  RasterUse use;
};

// Executes a task. Throws InputError.
TileAnswer answerTask(const TileTask& task);
// The same with these rules instead of the task's, and with the raster opened before.
TileAnswer answerTask(const RasterBand& band, const TileTask& task, std::span<const TileRule> rules);

// The pixels around a tile that a rule with this margin uses, and one more: columns on either side and rows above and
// below. Columns become narrow towards a pole: half of the raster suffices on either side if it wraps, all of it if
// not. 0 without a margin: files have blocks as large as tiles, and any margin unpacks the blocks around it once more.
// Throws InputError if there are too many rows.
std::array<int, 2> marginOf(const TilePlace& tile, double margin_m, const RasterGeometry& raster);

}  // namespace coastmesh
