#pragma once

#include <vector>

#include "apps/plot/plot_canvas.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// True for boundaries that are weirs in ADCIRC's files.
inline bool isWeir(const Boundary& boundary) { return !boundary.back_nodes.empty() || !boundary.weir.empty(); }

// Edges that pictures show in a colour of their own.
enum class PlotLineKind { Island, Line, Weir, River, Open };
struct PlotLines {
  PlotLineKind kind;
  const char* name;  // in the legend
  Color color;
  double width_px;
  std::vector<NodePair> edges;
};

// The lines of the grid, in the order in which they are drawn: islands, if there is an open boundary to distinguish
// them from, constraints, weirs (lines, and boundaries with a height), rivers, and open boundaries. Kinds without edges
// are omitted.
std::vector<PlotLines> colouredLines(const Grid& grid);

}  // namespace coastmesh
