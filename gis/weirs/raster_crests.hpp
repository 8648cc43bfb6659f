#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"
#include "gis/weirs/weir_crests.hpp"

namespace coastmesh {

// Rasters with the terrain at weirs.
struct CrestRasters {
  std::vector<std::string> files{};  // heights, positive up; of several the first with a value at a place counts
  double search_m = 30.0;            // metres, 0 or more: the crest is the highest terrain so far from a line
  double zero_m = 0.0;               // metres: the height of the zero of the grid's depths in terms of the rasters
};

// The crests that rasters have along weirs.
struct RasterCrests {
  // The lowest crest of the half of each edge at its lesser node, and of the other half: metres above the zero of the
  // grid's depths. By `edgeKey`; edges with an unknown half are left out.
  std::map<NodePair, std::array<double, 2>> of_edges;
  bool searched = false;  // there are rasters, and `warnings` has the lines without a value in them
  std::vector<std::string> notes, warnings;
};

// The crests of the lines of the grid that are weirs without a height of their own. A line is followed from pixel to
// pixel; at each the crest is the highest terrain across it, by which a line beside its levee finds the crest, and gaps
// of two pixels and more in the levee are seen. ADCIRC computes the flow per metre of width at each pair of nodes, from
// the one height that it has, so that a pair stands for half of each edge at it: its height has to be the lowest crest
// there, or a mesh with large elements holds water back that flows through the lowest place of a levee. Throws
// InputError, Cancelled.
RasterCrests findRasterCrests(const Grid& grid, const std::vector<WeirSource>& sources, const CrestRasters& rasters,
                              const RunControl& control, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
