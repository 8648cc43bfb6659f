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
  bool severalSomewhere() const { return several_; }

 private:
  std::unordered_map<Point, std::uint32_t, PointHash> first_;
  std::vector<std::uint32_t> next_;  // one a node: another at its place
  bool several_ = false;
};

// Which nodes a line of places goes along: where several have a place, those that are joined by edges of the mesh.
class LineNodes {
 public:
  enum class Along { Boundary, Inside };  // with the mesh to the left and nothing to the right, or with both

  // REQUIRES: `nodes` outlives it.
  LineNodes(const Grid& grid, const NodesByPlace& nodes, Along along);

  // Empty where there is no node at some place. What is closed ends with its first node.
  std::vector<std::uint32_t> of(const std::vector<Point>& places) const;

 private:
  bool joined(std::uint32_t a, std::uint32_t b) const;
  std::vector<std::uint32_t> follow(const std::vector<std::vector<std::uint32_t>>& choices) const;

  const NodesByPlace& nodes_;
  Along along_;
  std::set<NodePair> edges_;  // of triangles, in their direction; empty where every place has one node
};

}  // namespace coastmesh
