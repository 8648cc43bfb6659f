#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/clean/domain.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Tells the land of flood plains from the water, by the coastline: whatever the heights, and whether or not the coast
// is a line of the mesh.
class PlainLand {
 public:
  // `waters`: as they are cleaned without the flood plain.
  explicit PlainLand(const std::vector<Domain>& waters);

  // True for a place, in the coordinates of the input, in none of the waters.
  bool isLand(const Point& place) const;

 private:
  struct Water;
  std::vector<std::shared_ptr<const Water>> waters_;
  BoxTree boxes_;  // of the waters
};

// One flag for each node and triangle of a grid; empty if there is no flood plain.
struct LandFlags {
  std::vector<std::uint8_t> nodes;      // on land, with all triangles at the node: those at the coast are water
  std::vector<std::uint8_t> triangles;  // whose middle is on land

  bool isLandNode(std::size_t node) const { return !nodes.empty() && nodes[node] != 0; }
};

// Empty if `land` is null.
LandFlags landFlags(const Grid& grid, const PlainLand* land, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
