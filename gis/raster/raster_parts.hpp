#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/raster/raster_band.hpp"
#include "gis/raster/raster_mosaic.hpp"

namespace coastmesh {

inline constexpr int kPartStep = 256;  // pixels: parts of a raster that is one file start at multiples of it

// Divides a raster among several readers: along the edges of its files if it is a mosaic, else into parts that share no
// block. A raster whose rows must be read in order is one part.
PixelCuts partsOf(const RasterGeometry& raster);

// A part of a raster that is read by one reader.
struct RasterPart {
  std::string raster;
  std::size_t number = 0;    // see `ownedAs`
  std::uint64_t pixels = 0;  // to be read
};
// The number of the part that a cell of `partsOf` belongs to: the same for all cells of one file.
std::size_t ownedAs(const RasterGeometry& raster, std::size_t cell);

// Pixels whose values one reader is to read.
struct PixelTask {
  std::string path;
  int columns = 0, rows = 0;       // of the raster
  std::vector<PixelRect> windows;  // small; neighbours in the list should be close in the raster
};
struct PixelAnswer {
  std::vector<double> values;  // one window after another, row by row; NaN where missing
  RasterUse use;
};
// Throws InputError.
PixelAnswer answerTask(const PixelTask& task);

// Several readers of rasters, numbered from 0, the caller. Their creator defines what they are and how they are
// reached.
struct PixelReaders {
  // Returns the reader of each part: always the same for the same part.
  std::function<std::vector<int>(std::span<const RasterPart>)> ownersOf;
  // Runs every task, the i-th by reader `who[i]`, and returns the answers in the tasks' order. `loop` provides the
  // caller's threads. Throws what a task throws.
  std::function<std::vector<PixelAnswer>(std::span<const PixelTask> tasks, std::span<const int> who,
                                         const ItemLoop& loop)>
      read;
};

// Throws InputError if the raster no longer has the size that a task was made for.
void requireSame(const RasterBand& band, int columns, int rows);

}  // namespace coastmesh
