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

inline constexpr int kPartStep = 256;  // pixels: parts of a raster that is one file begin at multiples of it

// How a raster is shared out to several who read it: its files, where it is made of some, else parts that have no block
// of it in common as far as blocks fit `kPartStep`.
PixelCuts partsOf(const RasterGeometry& raster);

// What is read by one alone.
struct RasterPart {
  std::string raster;
  std::size_t number = 0;    // see `ownedAs`
  std::uint64_t pixels = 0;  // of it that are to be read
};
// The number under which a cell of `partsOf` has an owner: cells of one file have the same.
std::size_t ownedAs(const RasterGeometry& raster, std::size_t cell);

// Values of pixels, to be read by one reader.
struct PixelTask {
  std::string path;
  int columns = 0, rows = 0;       // that the raster has
  std::vector<PixelRect> windows;  // small ones, as near to one another in the list as in the raster
};
struct PixelAnswer {
  std::vector<double> values;  // of one window after another, in rows; NaN where there is none
  RasterUse use;
};
// Throws InputError.
PixelAnswer answerTask(const PixelTask& task);

// Several who read rasters, numbered from 0, the caller: who they are, and how they are reached, is known to whoever
// made this.
struct PixelReaders {
  // Who reads each of these parts: always the same one.
  std::function<std::vector<int>(std::span<const RasterPart>)> ownersOf;
  // Has every task done, the i-th by reader `who[i]`, and gives the answers in the tasks' order. `loop` lends the
  // caller's threads. Throws what a task throws.
  std::function<std::vector<PixelAnswer>(std::span<const PixelTask> tasks, std::span<const int> who,
                                         const ItemLoop& loop)>
      read;
};

// Throws InputError where a raster is not the one that a task was made for.
void requireSame(const RasterBand& band, int columns, int rows);

}  // namespace coastmesh
