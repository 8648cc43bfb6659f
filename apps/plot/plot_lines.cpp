#include "apps/plot/plot_lines.hpp"

#include <algorithm>

#include "apps/plot/plot_style.hpp"
#include "gis/grid/grid_lines.hpp"

namespace coastmesh {

std::vector<PlotLines> colouredLines(const Grid& grid) {
  PlotLines islands{PlotLineKind::Island, "island", kIsland, kRolePx / 2, {}};
  PlotLines lines{PlotLineKind::Line, "line", kLine, kRolePx, {}};
  PlotLines weirs{PlotLineKind::Weir, "weir", kWeir, kRolePx, {}};
  PlotLines rivers{PlotLineKind::River, "river", kRiver, kRolePx, {}};
  PlotLines open{PlotLineKind::Open, "open", kOpen, kRolePx, {}};
  const auto add = [](const auto& chain, PlotLines& to) {
    const std::vector<NodePair> edges = edgesOf(chain);
    to.edges.insert(to.edges.end(), edges.begin(), edges.end());
  };
  for (const Boundary& boundary : grid.boundaries) {
    if (isWeir(boundary)) {
      add(boundary, weirs);
    } else if (boundary.role == BoundaryRole::Island) {
      add(boundary, islands);
    } else if (boundary.role == BoundaryRole::River) {
      add(boundary, rivers);
    } else if (boundary.role == BoundaryRole::Open) {
      add(boundary, open);
    }
  }
  for (const GridLine& line : grid.lines) {
    if (line.kind == LineKind::Constraint) add(line, lines);
    if (line.kind == LineKind::Weir) add(line, weirs);
  }
  if (open.edges.empty()) islands.edges.clear();
  std::vector<PlotLines> all;
  for (PlotLines* kind : {&islands, &lines, &weirs, &rivers, &open})
    if (!kind->edges.empty()) all.push_back(std::move(*kind));
  return all;
}

}  // namespace coastmesh
