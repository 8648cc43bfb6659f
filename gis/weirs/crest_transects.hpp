#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"
#include "gis/raster/raster_band.hpp"
#include "gis/weirs/weir_crests.hpp"

namespace coastmesh {

// An edge of a weir, beside the lines of the feature that it comes from: it may cut their bends, so that terrain is
// sought across these lines, not across the edge. Lengths are seen from the edge's middle (see LineView).
struct CrestEdge {
  NodePair nodes{};
  const WeirSource* source = nullptr;
  double length = 0.0;          // of the edge
  double metre = 0.0;           // length of a metre on the ground, or of a unit of a plane
  double pixels = 0.0;          // in a length of 1, of the finest raster here; 0 if there is none
  std::vector<bool> rasters{};  // of each raster: it may have values here

  // Transects along the edge, an even number, and places in each: no farther apart than pixels.
  std::uint32_t transects() const;
  std::uint32_t places(double search_m) const;
};

// REQUIRES: the nodes are those of `grid`, and differ.
std::vector<CrestEdge> crestEdges(const Grid& grid, std::span<const std::pair<NodePair, const WeirSource*>> edges,
                                  const std::vector<RasterBand>& rasters, double search_m, const ItemLoop& loop);

// The ends of each of the edge's transects, `search_m` to both sides of the source's lines, in the grid's CRS.
std::vector<std::array<Point, 2>> transectsOf(const Grid& grid, const CrestEdge& edge, double search_m);

}  // namespace coastmesh
