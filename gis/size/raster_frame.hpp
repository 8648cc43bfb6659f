#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/crs/crs.hpp"
#include "gis/geometry/box.hpp"
#include "gis/projection/plane_table.hpp"
#include "gis/projection/projection.hpp"
#include "gis/raster/raster_band.hpp"
#include "gis/size/raster_tiles.hpp"

namespace coastmesh {

// The division of a raster's columns, or of its rows, into tiles.
class TileAxis {
 public:
  // A new tile begins at each of `cuts`, which run from 0 to the end; empty: there are no cuts.
  TileAxis(int pixels, const std::vector<int>& cuts);

  int pixels() const { return pixels_; }
  // REQUIRES: pixel >= 0. Pixels beyond the end belong to the last tile, up to its full length, then to the tile after
  // it.
  int tileOf(int pixel) const {
    if (starts_.empty()) return pixel / kTile;
    if (pixel < pixels_) return tile_of_[static_cast<std::size_t>(pixel)];
    return static_cast<int>(starts_.size()) - (pixel - starts_.back() < kTile ? 1 : 0);
  }
  // The first pixel of a tile; the end for the tile after the last.
  int start(int tile) const {
    if (starts_.empty()) return std::min(tile * kTile, pixels_);
    return tile < static_cast<int>(starts_.size()) ? starts_[static_cast<std::size_t>(tile)] : pixels_;
  }

 private:
  int pixels_;
  std::vector<int> starts_;
  std::vector<int> tile_of_;  // of each pixel
};

// The tiles of a raster from which sizes are computed.
struct RasterFrame {
  // The tiles that cover `box` of the working plane. `input` is the CRS that `projection` starts from.
  RasterFrame(const RasterGeometry& of, const Crs& input, const Projection& projection, const Box& box,
              const ItemLoop& loop);

  RasterGeometry raster;
  TileAxis columns, rows;
  std::array<int, 4> window{};    // in tiles: first column and row, and the ends
  std::vector<TilePlace> places;  // row by row; `pixel_m` is 0 beyond the reach of the working plane

  // The pixel at a place of the working plane.
  Point pixelOf(const Point& place) const { return raster.fromEven(to_even_pixel_->at(place)); }
  bool has(int column, int row) const {
    return column >= window[0] && row >= window[1] && column < window[2] && row < window[3];
  }
  std::size_t numberOf(int column, int row) const {
    return static_cast<std::size_t>(row - window[1]) * static_cast<std::size_t>(window[2] - window[0]) +
           static_cast<std::size_t>(column - window[0]);
  }

 private:
  // The pixels that cover a box of the working plane; empty if no place of it has a pixel position.
  Box pixelsIn(const Box& box) const;
  void findWindow(const Box& pixels);

  std::unique_ptr<PlaneTable> to_even_pixel_;
};

}  // namespace coastmesh
