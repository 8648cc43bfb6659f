#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "gis/grid/grid.hpp"
#include "gis/raster/raster_band.hpp"
#include "gis/sample/pixel_classes.hpp"
#include "gis/sample/sample_raster.hpp"

namespace coastmesh {

// How values at nodes are made of pixels.
struct RasterSampling {
  bool average = false;  // over the pixels in a node's triangles; bilinear if these contain fewer than four
  bool nearest = false;  // that of the pixel that holds a node, whatever `average` says
  BandValues kind = BandValues::Lengths;
  const PixelReaders* readers = nullptr;  // readers of the rasters for bilinear values; null: the caller
};

// A raster. With `classes` its pixels are classes: nodes get the average of their values over the pixels in their
// triangles, or the value at the node if these contain fewer than four.
struct RasterSource {
  std::string path;
  const PixelClasses* classes = nullptr;
};

struct RasterCounts {
  std::vector<std::size_t> nodes_of_file;  // for each raster: nodes that took their value from it
  std::size_t averaged = 0;                // of these, by the mean over their triangles
  std::size_t partial = 0;                 // of these, from pixels of which some have no value
  std::vector<std::string> notes;          // how places and values were interpreted
  std::vector<std::string> warnings;
};

// Values of rasters at the nodes of a grid, of the first that has one there; rasters that only some of the pixels at a
// node have a value in come after all others.
class RasterValues {
 public:
  // REQUIRES: `grid` and `loop` outlive it.
  RasterValues(const Grid& grid, const RasterSampling& how, const ItemLoop& loop);

  // The next raster, read block by block, with constant memory. One without a CRS is assumed to be in the grid's.
  // Throws InputError, Cancelled.
  void take(const RasterSource& source, const RunControl& control);
  // The values of all nodes, NaN where no raster has one.
  std::vector<double> finish();
  const RasterCounts& counts() const { return counts_; }

 private:
  std::vector<std::uint32_t> unknownNodes() const;
  std::size_t put(const std::vector<std::uint32_t>& nodes, const std::vector<RasterSample>& samples,
                  double least_share);

  const Grid& grid_;
  RasterSampling how_;
  const ItemLoop& loop_;
  RasterCounts counts_;
  std::vector<double> values_, partial_;
  std::vector<std::size_t> partial_file_;
};

}  // namespace coastmesh
