#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// The kind of a boundary edge. All edges of one boundary have the same.
struct BoundaryKind {
  BoundaryRole role = BoundaryRole::Land;
  int ibtype = -1;            // as in Boundary
  std::uint32_t segment = 0;  // distinguishes adjacent boundaries of the same role
  std::string name{};         // as in Boundary

  friend bool operator==(const BoundaryKind&, const BoundaryKind&) = default;
};

// True for an open boundary or a river, which water passes.
inline bool isOpening(BoundaryRole role) { return role == BoundaryRole::Open || role == BoundaryRole::River; }
inline bool isOpening(const BoundaryKind& kind) { return isOpening(kind.role); }

// The role that a word of a user stands for, case-insensitive: "ocean" is open, "inflow" a river, "coast" land.
std::optional<BoundaryRole> roleOfWord(const std::string& word);

// The grid's boundary as closed loops of nodes with the mesh to the left; see `boundaryLoops`.
std::vector<std::vector<std::uint32_t>> boundaryLoops(const Grid& grid, const ItemLoop& loop = inOrder);

// Cuts loops into boundaries where the kind of their edges changes. A loop of one kind stays closed; if that is shore,
// `roleOfLoop` decides whether it is land or an island. Shore in other loops is land.
using BoundaryKindOf = std::function<BoundaryKind(std::uint32_t from, std::uint32_t to)>;
std::vector<Boundary> cutLoops(const Grid& grid, const std::vector<std::vector<std::uint32_t>>& loops,
                               const BoundaryKindOf& kind_of);

// The kinds of the edges of a grid's boundaries, in either direction.
class EdgeKinds {
 public:
  explicit EdgeKinds(const Grid& grid);

  // Null for an edge in no boundary. `segment` is the boundary's number.
  const BoundaryKind* find(std::uint32_t a, std::uint32_t b) const&;
  const BoundaryKind* find(std::uint32_t a, std::uint32_t b) const&& = delete;  // would point into what is gone

  bool isOpen(std::uint32_t a, std::uint32_t b) const {
    const BoundaryKind* const kind = find(a, b);
    return kind != nullptr && kind->role == BoundaryRole::Open;
  }

  // The kind for boundaries that are cut anew (`cutLoops`): islands, and edges in no boundary, are land. `segment` is 0
  // unless it separates open boundaries or rivers of one kind that meet at a node.
  BoundaryKind forCutting(std::uint32_t a, std::uint32_t b) const;

 private:
  std::vector<std::pair<NodePair, std::uint32_t>> edges_;  // sorted; the lesser node first
  std::vector<BoundaryKind> kinds_;
  std::vector<std::uint32_t> separators_;  // by boundary
};

// The grid's boundaries for formats without weirs: both shores of each weir, the one across after the first, without
// heights. Edges across that are in another boundary, or not on the mesh's boundary, are left out.
std::vector<Boundary> weirsAsShores(const Grid& grid);

// For files that only mark open nodes: boundary edges between two of them are open, all others are shore. `is_open` has
// one flag for each node.
std::vector<Boundary> boundariesOfOpenNodes(const Grid& grid, const std::vector<bool>& is_open);

}  // namespace coastmesh
