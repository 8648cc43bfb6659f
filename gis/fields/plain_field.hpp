#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// The nodal attribute by which files of meshes tell the land of a flood plain from the water: 1 at nodes on land with
// all their triangles, 0 elsewhere. So values between nodes are above 0 inside every triangle on land that has one such
// node.
inline constexpr std::string_view kFloodPlain = "flood_plain";

bool hasPlain(const Grid& grid);

// A flag for each node: on the land of a flood plain. Of a grid without the attribute those that start dry below the
// water, by ADCIRC's attribute; empty without either.
std::vector<std::uint8_t> landNodes(const Grid& grid);

// Sets the attribute; `land`: a flag for each node.
void markPlain(Grid& grid, const std::vector<std::uint8_t>& land);

}  // namespace coastmesh
