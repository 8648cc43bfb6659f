#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gis/flood_plain/plain_land.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Nodes of a flood plain below the still water.
struct LowLand {
  std::vector<std::uint32_t> apart;  // ascending; without a connection to the water through triangles below it
  std::size_t connected = 0;         // the others
  double lowest_m = 0.0;             // metres below the still water, of those that are apart
  Point lowest;
};

LowLand findLowLand(const Grid& grid, const LandFlags& flags);

// ADCIRC's attribute of nodes that start dry although they lie below the still water: 1 there, 0 elsewhere.
inline constexpr std::string_view kStartsDry = "surface_submergence_state";
// Sets it: 1 at nodes that are apart.
void markStartDry(Grid& grid, const LowLand& low);

// For users; empty if no node is apart. `marked`: they have the attribute.
std::string noteOf(const LowLand& low, bool marked);

}  // namespace coastmesh
