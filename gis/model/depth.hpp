#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

struct PixelReaders;

enum class DepthMethod {
  Bilinear,  // between the four pixels around a node
  Average,   // over the pixels in the node's triangles; bilinear if these contain fewer than four
};
inline constexpr std::array kDepthMethodNames{"bilinear", "average"};

// What to do with nodes for which no raster has a value.
enum class DepthFill {
  Neighbours,  // the mean of the neighbours, like a membrane between the known nodes
  Nearest,     // the value of the nearest node along the mesh's edges
  None,        // left unknown, which formats of models reject
};
inline constexpr std::array kDepthFillNames{"neighbours", "nearest", "none"};

struct DepthOptions {
  std::vector<std::string> files{};  // rasters that GDAL reads, the first with a value is used; empty: no depths
  DepthMethod method = DepthMethod::Bilinear;
  bool positive_down = false;  // the rasters hold depths; otherwise elevations, positive up
  double water_level_m = 0.0;  // metres: height of the still water above the rasters' zero
  double min_depth_m = -std::numeric_limits<double>::infinity();  // metres: shallower nodes are lowered to this
  // Nodes above the water are land on purpose: `min_depth_m` does not lower them, and many are no mistake.
  bool has_land = false;
  // Flags of nodes that are land too, though they may lie below the water, one for each; empty: there are none.
  std::function<std::vector<std::uint8_t>(const Grid&)> landOf{};
  DepthFill fill = DepthFill::Neighbours;
  bool keep_known = false;  // nodes for which no raster has a value keep the z that they have, instead of being filled
  bool keep_land = false;   // with `keep_known`: those above the water before are land, not lowered to `min_depth_m`
  const PixelReaders* readers = nullptr;  // readers of the rasters for bilinear depths; null: the caller
};

struct DepthReport {
  std::vector<std::size_t> nodes_of_file;  // for each file: nodes that took their depth from it
  std::size_t averaged = 0;                // of these, by the mean over their triangles
  std::size_t partial = 0;                 // of these, from pixels of which some have no value
  std::size_t kept = 0;                    // nodes without a value in any raster that kept their z
  std::size_t filled = 0;                  // nodes without a value in any raster, filled from others
  std::size_t unknown = 0;                 // nodes left without a value
  std::size_t lowered = 0;                 // to the minimum depth
  std::size_t above_water = 0;
  double least_m = 0.0;  // depth, positive down; of known nodes
  double greatest_m = 0.0;
  std::vector<std::string> notes;  // how places and values of the rasters were interpreted
  std::vector<std::string> warnings;
};

// True if some z is known and not 0: formats that need a depth at every node have 0 if there is none.
bool hasDepths(const Grid& grid);

// Lowers nodes that are shallower than the minimum depth, but for land if there is any. Returns how many.
std::size_t lowerToMinimum(Grid& grid, const DepthOptions& options);

// Sets the grid's z from rasters in any CRS, to six decimals, read block by block, with constant memory. A raster
// without a CRS is assumed to be in the grid's. Throws InputError, Cancelled.
DepthReport setDepths(Grid& grid, const DepthOptions& options, const RunControl& control = {},
                      const ItemLoop& loop = inOrder);

}  // namespace coastmesh
