#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/run_control.hpp"
#include "gis/grid/grid.hpp"
#include "gis/raster/raster_band.hpp"
#include "gis/raster/raster_parts.hpp"

namespace coastmesh {

// What a raster says of a place.
struct RasterSample {
  double value = 0.0;
  double share = 0.0;  // of the pixels that count there, those that have a value; 0 where there is none
};

// Places of the grid in the raster's pixels. A grid in a plane, and a raster without a CRS, are taken to share theirs.
// Not finite where the raster's CRS cannot tell of a place.
std::vector<Point> pixelsOf(const Grid& grid, const RasterBand& raster);

// Bilinear values at `pixels[i]` for each i of `which`, in its order. Tiles of the raster are read one after another,
// each once; by `readers` where they are not null. Throws InputError, Cancelled.
std::vector<RasterSample> sampleBilinear(const RasterBand& raster, std::span<const Point> pixels,
                                         std::span<const std::uint32_t> which, const PixelReaders* readers,
                                         const RunControl& control);

// The mean over the pixels whose centres lie in the triangles round a node, for each node of `which`; `pixels` has one
// entry a node of the grid. Nodes whose triangles hold fewer than `least_pixels` get a share of 0.
std::vector<RasterSample> sampleAverage(const RasterBand& raster, const Grid& grid, std::span<const Point> pixels,
                                        std::span<const std::uint32_t> which, double least_pixels,
                                        const RunControl& control);

}  // namespace coastmesh
