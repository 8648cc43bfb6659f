#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// The number of a boundary in formats that have a single one: ten times its number, counted from 1, plus 1 for land, 2
// for an island, 3 for open water, 4 for a river.
std::int64_t boundaryMarker(std::size_t index, BoundaryRole role);

// The same for a line: plus 5 for a constraint, 6 for a weir, 7 for a region's border. The numbers of lines continue
// those of the boundaries.
std::int64_t lineMarker(std::size_t index, LineKind kind);

// What the markers of a file mean, one by one. Other programs use the same numbers for other things: nothing is
// believed unless at least half of the different markers are of the above, each with an index of its own that is below
// twice their number. So edges may be added, removed and listed in another order.
using MarkerKind = std::variant<std::monostate, BoundaryRole, LineKind>;
std::vector<MarkerKind> kindsOfMarkers(std::span<const std::int64_t> markers);

// An edge of a boundary or of a line, with its `boundaryMarker` or `lineMarker`: for formats that have a number for
// each edge.
struct MarkedEdge {
  NodePair nodes;
  std::int64_t marker = 0;

  friend bool operator==(const MarkedEdge&, const MarkedEdge&) = default;
};

// The edges of the boundaries, in order, then those of the lines.
std::vector<MarkedEdge> markedEdges(const Grid& grid);

// Makes boundaries and lines of edges with the markers of `markedEdges`, in the order of the markers. Edges with others
// have no role and are ignored.
void takeMarkedEdges(std::span<const MarkedEdge> edges, Grid& grid);

}  // namespace coastmesh
