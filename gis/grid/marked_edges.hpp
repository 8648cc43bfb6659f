#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// An edge of a boundary or of a line, with its `boundaryMarker` or `lineMarker`: for formats that hold edges with a
// number each.
struct MarkedEdge {
  NodePair nodes;
  std::int64_t marker = 0;

  friend bool operator==(const MarkedEdge&, const MarkedEdge&) = default;
};

// Those of the boundaries in their order, then those of the lines.
std::vector<MarkedEdge> markedEdges(const Grid& grid);

// Makes boundaries and lines of edges in the order and with the markers that `markedEdges` gives them. Others say no
// roles: then nothing is made.
void takeMarkedEdges(std::span<const MarkedEdge> edges, Grid& grid);

}  // namespace coastmesh
