#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "gis/crs/crs.hpp"
#include "gis/grid/grid.hpp"
#include "gis/raster/raster_band.hpp"
#include "gis/raster/raster_parts.hpp"

namespace coastmesh {

// The value of a raster at a place.
struct RasterSample {
  double value = 0.0;
  double share = 0.0;  // share of the pixels used there that have a value; 0 if none has
};

// Places of the grid in the raster's pixels. If the grid is in a plane, or the raster has no CRS, both are assumed to
// have the same. Not finite if a place is outside the raster's CRS.
std::vector<Point> pixelsOf(const Grid& grid, const RasterBand& raster, const ItemLoop& loop);

// The same for other places.
std::vector<Point> pixelsOf(const Crs& crs, std::span<const Point> places, const RasterBand& raster,
                            const ItemLoop& loop);

// Bilinear values at `pixels[i]` for each i of `which`, in its order. Each tile of the raster is read once, several at
// the same time; by `readers` if not null. Throws InputError, Cancelled.
std::vector<RasterSample> sampleBilinear(const RasterBand& raster, std::span<const Point> pixels,
                                         std::span<const std::uint32_t> which, const PixelReaders* readers,
                                         const ItemLoop& loop, const RunControl& control);

// The same with the highest of the four pixels around each place, whose share is 1 if any of them has a value.
std::vector<RasterSample> sampleHighest(const RasterBand& raster, std::span<const Point> pixels,
                                        std::span<const std::uint32_t> which, const ItemLoop& loop,
                                        const RunControl& control);

}  // namespace coastmesh
