#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/crs/crs.hpp"
#include "gis/geometry/box.hpp"
#include "gis/projection/projection.hpp"
#include "gis/raster/raster_band.hpp"
#include "gis/size/raster_frame.hpp"
#include "gis/size/raster_tiles.hpp"
#include "gis/size/size_field.hpp"

namespace coastmesh {

// Sizes from a raster: each tile of pixels is read once, converted to sizes and kept as a quadtree whose leaves have
// nearly equal sizes, or sides of at most half the smallest: memory is proportional to the sizes, not to the raster.
// Between pixel centres sizes are bilinear, except in pixels with much smaller sizes than their neighbours.
class RasterField final : public SizeField {
 public:
  // For the part of the raster that covers `box` of the working plane. `input` is the input CRS of `projection`. Throws
  // InputError.
  RasterField(const RasterGeometry& raster, const Crs& input, const Projection& projection, const Box& box,
              const TileRule& rule, const ItemLoop& loop);
  // From tiles already read: one for each of the frame's places.
  RasterField(std::shared_ptr<const RasterFrame> frame, std::vector<SizeTile>&& tiles);

  void sample(std::span<const Point> places, std::span<double> sizes) const override;
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override;
  double least() const override { return least_; }
  double mostIn(const SizeBox& box) const override;

 private:
  using PixelWindow = std::array<std::int64_t, 4>;  // first column and row, then those after the last

  void findLeast();
  float pixel(std::int64_t x, std::int64_t y) const;
  SizeRange boundBetween(const Box& pixels) const;
  void boundIn(const SizeTile& tile, std::uint32_t node, int x, int y, int side, const PixelWindow& window,
               SizeRange& range) const;
  double mostKnownIn(const SizeTile& tile, std::uint32_t node, int x, int y, int side, const PixelWindow& window,
                     double most) const;
  std::optional<Box> pixelsIn(const SizeBox& box) const;
  template <typename Found>
  void forTiles(const PixelWindow& window, Found&& found) const;

  std::shared_ptr<const RasterFrame> frame_;
  std::vector<SizeTile> tiles_;  // of each place of the frame
  double least_ = std::numeric_limits<double>::infinity();
};

// At each place the first of several fields that covers it is used. A field covers the places where its coverage, a
// field too, is finite; without coverages, those where it is finite itself.
class FirstOfFields final : public SizeField {
 public:
  using Fields = std::vector<std::unique_ptr<SizeField>>;
  // REQUIRES: `coverage` is empty, or has one for each field.
  explicit FirstOfFields(Fields fields, Fields coverage = {})
      : fields_(std::move(fields)), coverage_(std::move(coverage)) {}

  void sample(std::span<const Point> places, std::span<double> sizes) const override;
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override;
  double least() const override;
  double mostIn(const SizeBox& box) const override;

 private:
  Fields fields_, coverage_;
};

}  // namespace coastmesh
