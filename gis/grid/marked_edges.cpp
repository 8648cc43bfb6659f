#include "gis/grid/marked_edges.hpp"

#include <algorithm>
#include <iterator>
#include <variant>

#include "gis/grid/grid_lines.hpp"

namespace coastmesh {

std::vector<MarkedEdge> markedEdges(const Grid& grid) {
  std::vector<MarkedEdge> all;
  const auto add = [&](const std::vector<NodePair>& edges, std::int64_t marker) {
    for (const NodePair& edge : edges) all.push_back({edge, marker});
  };
  for (std::size_t b = 0; b < grid.boundaries.size(); ++b)
    add(edgesOf(grid.boundaries[b]), boundaryMarker(b, grid.boundaries[b].role));
  for (std::size_t i = 0; i < grid.lines.size(); ++i)
    add(edgesOf(grid.lines[i]), lineMarker(grid.boundaries.size() + i, grid.lines[i].kind));
  return all;
}

void takeMarkedEdges(std::span<const MarkedEdge> edges, Grid& grid) {
  // Consecutive edges with the same marker.
  struct Run {
    std::int64_t marker = 0;
    std::variant<BoundaryRole, LineKind> kind;
    std::vector<NodePair> edges;
  };
  std::vector<Run> runs;
  for (const auto& [nodes, marker] : edges) {
    if (runs.empty() || marker != runs.back().marker) {
      if (const auto role = roleOfMarker(marker, runs.size())) {
        runs.push_back({marker, *role, {}});
      } else if (const auto kind = lineKindOfMarker(marker, runs.size())) {
        runs.push_back({marker, *kind, {}});
      } else {
        return;
      }
    }
    runs.back().edges.push_back(nodes);
  }
  std::vector<std::vector<NodePair>> groups(runs.size());
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (const LineKind* const kind = std::get_if<LineKind>(&runs[k].kind))
      std::ranges::move(linesAlong(runs[k].edges, *kind, {}), std::back_inserter(grid.lines));
    else
      groups[k] = std::move(runs[k].edges);
  }
  keepBoundaryEdges(grid.triangles, groups);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    for (Boundary& chain : chainEdges(groups[k])) {
      chain.role = std::get<BoundaryRole>(runs[k].kind);
      grid.boundaries.push_back(std::move(chain));
    }
  }
}

}  // namespace coastmesh
