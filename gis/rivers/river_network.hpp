#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/point.hpp"
#include "gis/rivers/plane_river.hpp"

namespace coastmesh {

// Centre lines between two nodes of the network, joined end to end.
struct RiverReach {
  std::uint32_t from = 0, to = 0;
  std::vector<Point> points;           // both nodes included
  std::vector<std::uint32_t> line_of;  // for each edge: the river that it belongs to
};

// Where reaches end: free ends, with one reach, and junctions. A ring of reaches without any has one node of two.
struct RiverNetwork {
  std::vector<Point> nodes;
  std::vector<RiverReach> reaches;
  std::vector<std::uint32_t> within;  // lines that are within wider ones, or given before: they have no reach
};

// Lines become a network where they cross, and where one ends so close to another that, as wide as they are, they
// touch. Parts of lines within wider ones (`piecesOf`), and those shorter than half their width at such places, are
// dropped.
RiverNetwork riverNetwork(std::span<const PlaneRiver> rivers);

}  // namespace coastmesh
