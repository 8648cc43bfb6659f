#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "gis/grid/grid.hpp"
#include "gis/raster/raster_band.hpp"
#include "gis/sample/pixel_classes.hpp"
#include "gis/sample/sample_raster.hpp"

namespace coastmesh {

// The mean over the pixels with centres in the triangles around a node, for each node of `which`; `pixels` has the
// place of each node of the grid (see pixelsOf). Nodes whose triangles contain fewer than `least_pixels` get a share of
// 0. With `classes` the pixels' values are those of their classes, and each must have one. Each tile of the raster is
// read once, several at the same time. Throws InputError, Cancelled.
std::vector<RasterSample> sampleAverage(const RasterBand& raster, const Grid& grid, std::span<const Point> pixels,
                                        std::span<const std::uint32_t> which, double least_pixels, const ItemLoop& loop,
                                        const RunControl& control, const PixelClasses* classes = nullptr);

}  // namespace coastmesh
