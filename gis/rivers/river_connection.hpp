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
  std::vector<Point> extended;        // free ends outside the water that were continued to it
  std::vector<Point> left;            // those as close that were not, since the network has another way to the water
  std::vector<Point> led_out;         // ends on land close to the mesh's edge that were continued past it
  // Of each reach: of its network, the distance of the nearest free end outside the water from it, plane units;
  // infinite if it is far.
  std::vector<double> gap;
};

// Continues free ends within `reach` of the water, in plane units: straight, and a width into it. If `reach` is
// infinite, ends within a width of the water are continued, and those within three widths, or the length of an edge
// there, to which the mesh's shore may have been generalised, if they are mouths: of a network that is connected
// otherwise, those at which lines begin or end as most of them do in the water; of others the nearest, those that are
// alike, and those at most twice as far. Ends in the water are continued until both banks are in it, by at most three
// widths.
// `over_land`: rivers have rows on the mesh's land too. Then ends on land with the mesh's edge within some three widths
// ahead are continued until both banks are beyond it, so that they become inflows.
RiverConnection connectRivers(RiverNetwork& network, std::span<const PlaneRiver> rivers, const MeshWater& water,
                              double reach, bool over_land);

// Of each reach: 1 if it is connected with one that touches the water, through reaches that are not barred.
std::vector<std::uint8_t> connectedReaches(const RiverNetwork& network, std::span<const std::uint8_t> touches,
                                           std::span<const std::uint8_t> barred);

}  // namespace coastmesh
