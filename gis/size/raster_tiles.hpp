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

// The sizes of a tile as a quadtree of `kTile` by `kTile` pixels, of which the tile is the first corner: its cells are
// as large as sizes in them are alike, or as half of what they ask for. The first is the whole.
struct SizeNode {
  float low = 0.0F, high = 0.0F;  // within it; infinite where nothing is wanted
  float value = 0.0F;             // where it is a leaf
  std::uint32_t below = 0;        // the first of four in a row; 0 for a leaf
};
using SizeTile = std::vector<SizeNode>;

// Of a tile of which nothing is wanted.
SizeTile emptyTile();

struct TilePlace {
  PixelRect pixels;
  std::array<double, 2> pixel_m{};  // ground size of a pixel along columns and rows, metres
};

// Values of pixels that someone else read.
struct PixelPatch {
  PixelRect at;
  std::vector<float> values;  // in rows; NaN where there is none
};

// What is to be read of one raster, by one reader. It depends on nothing else, and gives the same wherever it is done.
struct TileTask {
  std::string path;
  int columns = 0, rows = 0;        // that the raster has
  std::vector<SizeRule> rules;      // one margin at most is above 0
  std::vector<TilePlace> tiles;     // to be turned into sizes by each rule
  std::vector<PixelRect> own;       // what may be read for that; empty: all of it
  std::vector<PixelPatch> patches;  // the rest, as far as it is looked at
  std::vector<PixelRect> strips;    // to be given as they are
};

struct TileAnswer {
  std::vector<std::vector<SizeTile>> tiles;  // of each rule, in the order of the task's tiles
  std::vector<PixelPatch> strips;
  RasterUse use;
};

// Throws InputError.
TileAnswer answerTask(const TileTask& task);
// By rules of any kind, in place of the task's.
TileAnswer answerTask(const TileTask& task, std::span<const TileRule> rules);

// As many pixels round a tile as a rule with that margin looks at, and one; none where it looks at none: files have
// blocks as large as tiles, and each margin has those round it unpacked once more. Throws InputError.
int marginOf(const TilePlace& tile, double margin_m, const std::string& file);

}  // namespace coastmesh
