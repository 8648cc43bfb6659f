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

// The nodes at each place: more than one where a file has them (both shores of a wall, say). Places are equal bit for
// bit, but 0 is -0.
class NodesByPlace {
 public:
  void add(const Point& place, std::uint32_t node);

  std::uint32_t firstAt(const Point& place) const;  // kNone where there is none
  std::vector<std::uint32_t> allAt(const Point& place) const;

 private:
  std::unordered_map<Point, std::uint32_t, PointHash> first_;
  std::vector<std::uint32_t> next_;  // one a node: another at its place
};

// Which nodes a line goes along where several are at a place: those that are joined by edges of the mesh.
class LineNodes {
 public:
  enum class Along { Boundary, Inside };  // with the mesh to the left and nothing to the right, or with both

  // REQUIRES: `grid` outlives it; no triangle is added meanwhile.
  LineNodes(const Grid& grid, Along along);

  // One node of each set of choices. What is closed has the same choices at both ends and ends with its first node.
  // Where no choice follows edges of the mesh: the first of each. REQUIRES: there is a choice everywhere.
  std::vector<std::uint32_t> of(std::vector<std::vector<std::uint32_t>> choices, bool closed);

 private:
  std::vector<std::uint32_t> find(std::vector<std::vector<std::uint32_t>> choices, bool closed) const;
  bool joined(std::uint32_t a, std::uint32_t b) const;
  std::vector<std::uint32_t> follow(const std::vector<std::vector<std::uint32_t>>& choices) const;

  const Grid& grid_;
  Along along_;
  std::set<NodePair> edges_;  // of triangles, in their direction; made when a line first has a choice
};

}  // namespace coastmesh
