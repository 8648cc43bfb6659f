#pragma once

#include <cstdint>
#include <set>
#include <unordered_map>
#include <vector>

#include "core/point.hpp"
#include "core/point_hash.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// The nodes at each place: a file may have several (both shores of a wall, say). Places are compared bit for bit,
// except that 0 equals -0.
class NodesByPlace {
 public:
  void add(const Point& place, std::uint32_t node);

  std::uint32_t firstAt(const Point& place) const;  // kNone if there is none
  std::vector<std::uint32_t> allAt(const Point& place) const;

 private:
  std::unordered_map<Point, std::uint32_t, PointHash> first_;
  std::vector<std::uint32_t> next_;  // for each node: another one at its place
};

// Chooses the nodes of a line where several are at one place: those joined by edges of the mesh.
class LineNodes {
 public:
  enum class Along { Boundary, Inside };  // with the mesh to the left only, or on both sides

  // REQUIRES: `grid` outlives it; no triangle is added meanwhile.
  LineNodes(const Grid& grid, Along along);

  // One node of each set of choices, so that they follow edges of the mesh; if that is impossible, the first of each. A
  // closed line has the same choices at both ends, and ends with its first node if possible. REQUIRES: no set is empty.
  std::vector<std::uint32_t> of(std::vector<std::vector<std::uint32_t>> choices, bool closed);

 private:
  std::vector<std::uint32_t> find(std::vector<std::vector<std::uint32_t>> choices, bool closed) const;
  bool joined(std::uint32_t a, std::uint32_t b) const;
  std::vector<std::uint32_t> follow(const std::vector<std::vector<std::uint32_t>>& choices) const;

  const Grid& grid_;
  Along along_;
  std::set<NodePair> edges_;  // of triangles, in their direction; made when first needed
};

}  // namespace coastmesh
