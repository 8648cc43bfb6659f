#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/crs/crs.hpp"
#include "gis/geometry/box.hpp"
#include "gis/projection/plane_table.hpp"
#include "gis/projection/projection.hpp"
#include "gis/raster/raster_band.hpp"
#include "gis/size/size_field.hpp"

namespace coastmesh {

// A square of pixels while it is looked at, with some of its surroundings.
struct RasterTile {
  int width = 0, height = 0;       // pixels, without the margin
  int margin = 0;                  // pixels on each side
  double pixel_m[2] = {0.0, 0.0};  // ground size of a pixel along columns and rows, metres
  std::vector<float> values;       // rows of width + 2 margin from the top; NaN where there is no data
  std::string file;

  std::size_t stride() const { return static_cast<std::size_t>(width) + 2 * static_cast<std::size_t>(margin); }
  float at(int x, int y) const {
    return values[static_cast<std::size_t>(y + margin) * stride() + static_cast<std::size_t>(x + margin)];
  }
};

// From values to sizes: `sizes` has one a pixel, in rows without margin; infinite where nothing is wanted.
struct TileRule {
  double margin_m = 0.0;  // of surroundings that the rule looks at; 0: a tile has none
  std::function<void(const RasterTile& tile, std::span<float> sizes)> sizes;
};

// Sizes from a raster: each block of pixels is read once, turned into sizes and kept as a quadtree whose cells are as
// large as sizes in them are alike, or as half of what they ask for: memory follows the sizes, not the raster. Between
// pixels' centres sizes are bilinear, but for pixels much smaller than those round them.
class RasterField final : public SizeField {
 public:
  // Of the part of the raster that `box` of the working plane lies in. `input` is the CRS that `projection` starts
  // from. Throws InputError.
  RasterField(const RasterGeometry& raster, const Crs& input, const Projection& projection, const Box& box,
              const TileRule& rule, const ItemLoop& loop);

  void sample(std::span<const Point> places, std::span<double> sizes) const override;
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override;
  double least() const override { return least_; }

 private:
  struct Node {
    float low, high;          // within it; infinite where nothing is wanted
    float value;              // where it is a leaf
    std::uint32_t below = 0;  // the first of four in a row; 0 for a leaf
  };
  using Tile = std::vector<Node>;

  // `pixelSize` is the ground size, metres, of a step from one pixel to another.
  template <typename PixelSize>
  void readTiles(const PixelSize& pixelSize, const TileRule& rule, const ItemLoop& loop);
  Tile compress(const RasterTile& tile, std::span<const float> sizes) const;
  float pixel(std::int64_t x, std::int64_t y) const;
  SizeRange boundBetween(const Box& pixels) const;
  void boundIn(const Tile& tile, std::uint32_t node, int x, int y, int side, const std::array<std::int64_t, 4>& window,
               SizeRange& range) const;

  RasterGeometry raster_;
  std::unique_ptr<PlaneTable> to_pixel_;
  std::array<int, 4> window_{};  // of the tiles kept: first column and row, and the ends
  std::vector<Tile> tiles_;      // in rows
  double least_ = std::numeric_limits<double>::infinity();
};

// The first of several fields that wants anything counts.
class FirstOfFields final : public SizeField {
 public:
  explicit FirstOfFields(std::vector<std::unique_ptr<SizeField>> fields) : fields_(std::move(fields)) {}

  void sample(std::span<const Point> places, std::span<double> sizes) const override;
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override;
  double least() const override;

 private:
  std::vector<std::unique_ptr<SizeField>> fields_;
};

}  // namespace coastmesh
