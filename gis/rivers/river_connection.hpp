#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gis/rivers/mesh_water.hpp"
#include "gis/rivers/river_network.hpp"

namespace coastmesh {

// How a network is connected with the water of a mesh.
struct RiverConnection {
  std::vector<std::uint8_t> touches;  // of each reach: 1 if a place of it is in the water
  std::size_t extended = 0;           // free ends that were continued
  // Of each reach: of its network, the distance of the nearest free end outside the water from it, plane units;
  // infinite if it is far.
  std::vector<double> gap;
};

// Continues free ends within `reach` of the water, in plane units, or three widths of the river if that is infinite:
// straight, and a width into it.
RiverConnection connectRivers(RiverNetwork& network, std::span<const PlaneRiver> rivers, const MeshWater& water,
                              double reach);

// Of each reach: 1 if it is connected with one that touches the water, through reaches that are not barred.
std::vector<std::uint8_t> connectedReaches(const RiverNetwork& network, std::span<const std::uint8_t> touches,
                                           std::span<const std::uint8_t> barred);

}  // namespace coastmesh
