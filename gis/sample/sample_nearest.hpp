#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "gis/raster/raster_band.hpp"
#include "gis/sample/pixel_classes.hpp"
#include "gis/sample/sample_raster.hpp"

namespace coastmesh {

// The value of the pixel that holds `pixels[i]`, or that of its class if there are classes, for each i of `which`, in
// its order. Each tile of the raster is read once, several at the same time. Throws InputError, also for a class
// without a value; Cancelled.
std::vector<RasterSample> sampleNearest(const RasterBand& raster, std::span<const Point> pixels,
                                        std::span<const std::uint32_t> which, const PixelClasses* classes,
                                        const ItemLoop& loop, const RunControl& control);

}  // namespace coastmesh
