#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// What an edge of the boundary is. Edges of one boundary are alike in all of it.
struct BoundaryKind {
  BoundaryRole role = BoundaryRole::Land;
  int ibtype = -1;            // as in Boundary
  std::uint32_t segment = 0;  // tells boundaries of the same role apart that follow one another

  friend bool operator==(const BoundaryKind&, const BoundaryKind&) = default;
};

// The grid's boundary as closed loops of nodes with the mesh to the left; see `boundaryLoops`.
std::vector<std::vector<std::uint32_t>> boundaryLoops(const Grid& grid);

// Loops cut into boundaries where the kind of their edges changes. A loop of one kind stays closed; one of shore alone
// is land or an island by `roleOfLoop`, whichever the kind says; the shore of a loop that opens somewhere is land.
using BoundaryKindOf = std::function<BoundaryKind(std::uint32_t from, std::uint32_t to)>;
std::vector<Boundary> cutLoops(const Grid& grid, const std::vector<std::vector<std::uint32_t>>& loops,
                               const BoundaryKindOf& kind_of);

// The kinds of edges that the grid's boundaries say, whichever way they go.
class EdgeKinds {
 public:
  explicit EdgeKinds(const Grid& grid);

  // Null for an edge in no boundary. `segment` is the boundary's number.
  const BoundaryKind* find(std::uint32_t a, std::uint32_t b) const;

 private:
  std::vector<std::pair<NodePair, std::uint32_t>> edges_;  // sorted; the lesser node first
  std::vector<BoundaryKind> kinds_;
};

// For files that say open nodes and no more: the boundary's edges between two of them are open, all others are shore.
// `is_open` has one flag a node.
std::vector<Boundary> boundariesOfOpenNodes(const Grid& grid, const std::vector<bool>& is_open);

}  // namespace coastmesh
