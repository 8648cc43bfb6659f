#pragma once

#include <vector>

#include "apps/plot/plot_canvas.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// A boundary that ADCIRC's files have as a weir.
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

// Those of the grid, in the order in which they are drawn: islands where there is an open boundary to tell from, lines
// to keep, weirs (lines, and boundaries with a height), rivers, and open boundaries. Kinds that it has none of are left
// out.
std::vector<PlotLines> colouredLines(const Grid& grid);

}  // namespace coastmesh
