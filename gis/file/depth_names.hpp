#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace coastmesh {

// What a name in a file of a model means at nodes.
enum class DepthName { Elevation, Depth, None };

// Elevations of the bed, positive up, and depths, positive down, as models name them: "depth",
// "bed_level", D-Flow FM's "node_z".
inline DepthName depthNameOf(const std::string_view lower_case) {
  using namespace std::string_view_literals;
  constexpr std::array kElevations{"node_z"sv,   "netnode_z"sv, "z"sv,      "bed_level"sv,
                                   "bedlevel"sv, "elevation"sv, "bottom"sv, "bed_elevation"sv};
  constexpr std::array kDepths{"depth"sv, "h"sv, "bathymetry"sv, "node_depth"sv};
  if (std::ranges::count(kElevations, lower_case) > 0) return DepthName::Elevation;
  return std::ranges::count(kDepths, lower_case) > 0 ? DepthName::Depth : DepthName::None;
}

}  // namespace coastmesh
