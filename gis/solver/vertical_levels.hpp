#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "gis/grid/grid.hpp"

namespace coastmesh {

class Elements;

// Depths of FESOM2's levels in metres, positive down and ascending: an element has the layers whose middle is above the
// mean depth of its nodes, a node as many as the deepest element around it.
struct FesomLevels {
  std::vector<double> depths_m;
};

// SCHISM's vgrid.in with ivcor = 2: S layers down to the first of the depths, below it a Z layer between two of them.
struct SzLevels {
  std::uint64_t s_layers = 1;
  std::vector<double> depths_m;  // positive down, ascending
};

// SCHISM's vgrid.in with ivcor = 1 (LSC2), of today's form or the older one: the layers of each node.
struct NodeLayers {
  std::vector<std::uint64_t> layers;
};

// The vertical grid of a model.
struct VerticalLevels {
  std::string file;  // empty: not read from one
  std::variant<FesomLevels, SzLevels, NodeLayers> levels;
};

// True for the name of a file that `readVerticalLevels` can read: one that ends in "aux3d.out" or "vgrid.in".
bool isLevelFile(const std::string& path);

// Reads FESOM2's aux3d.out, or SCHISM's vgrid.in. Throws InputError. REQUIRES: `isLevelFile(path)`.
VerticalLevels readVerticalLevels(const std::string& path);

// How many layers of water there are at each element and at each node, as the model counts them before it changes any
// depth: 1 or more. Throws InputError if a depth is unknown, and if the levels are those of a grid with another number
// of nodes.
std::vector<double> layersOfElements(const Grid& grid, const Elements& elements, const VerticalLevels& levels);
std::vector<double> layersOfNodes(const Grid& grid, const Elements& elements, const VerticalLevels& levels);

}  // namespace coastmesh
