#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// An edge of a boundary or of a line, with its `boundaryMarker` or `lineMarker`: for formats that have a number for
// each edge.
struct MarkedEdge {
  NodePair nodes;
  std::int64_t marker = 0;

  friend bool operator==(const MarkedEdge&, const MarkedEdge&) = default;
};

// The edges of the boundaries, in order, then those of the lines.
std::vector<MarkedEdge> markedEdges(const Grid& grid);

// Makes boundaries and lines of edges that have the order and markers of `markedEdges`. Makes nothing of other markers,
// which define no roles.
void takeMarkedEdges(std::span<const MarkedEdge> edges, Grid& grid);

}  // namespace coastmesh
