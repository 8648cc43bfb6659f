#include "gis/flood_plain/low_land.hpp"

#include <algorithm>
#include <cstdio>

#include "core/union_find.hpp"
#include "gis/fields/field_names.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/for_count.hpp"
#include "gis/places.hpp"

namespace coastmesh {

LowLand findLowLand(const Grid& grid, const LandFlags& flags) {
  LowLand low;
  if (flags.nodes.empty() || grid.z.empty()) return low;
  const auto isLow = [&](std::uint32_t node) { return grid.z[node] < 0.0; };
  UnionFind sets(grid.nodes.size());
  for (const auto& corners : grid.triangles) {
    if (!std::ranges::all_of(corners, isLow)) continue;
    sets.unite(corners[0], corners[1]);
    sets.unite(corners[0], corners[2]);
  }
  std::vector<bool> has_water(grid.nodes.size(), false);  // by root
  for (std::uint32_t v = 0; v < grid.nodes.size(); ++v)
    if (!flags.isLandNode(v)) has_water[sets.find(v)] = true;
  for (std::uint32_t v = 0; v < grid.nodes.size(); ++v) {
    if (!flags.isLandNode(v) || !isLow(v)) continue;
    if (has_water[sets.find(v)]) {
      ++low.connected;
      continue;
    }
    low.apart.push_back(v);
    if (0.0 - grid.z[v] <= low.lowest_m) continue;
    low.lowest_m = 0.0 - grid.z[v];
    low.lowest = grid.nodes[v];
  }
  return low;
}

void markStartDry(Grid& grid, const LowLand& low) {
  const std::string name(kStartsDry);
  NodeField* field = findField(grid, name);
  if (field == nullptr) {
    const FieldName* const known = findFieldName(name);
    grid.node_fields.push_back({name, std::string(known->unit), 0, known->usual});
    field = &grid.node_fields.back();
  }
  field->values.assign(grid.nodes.size(), 0.0);
  for (const std::uint32_t v : low.apart) field->values[v] = 1.0;
}

std::string noteOf(const LowLand& low, bool marked) {
  if (low.apart.empty()) return {};
  char depth[40];
  std::snprintf(depth, sizeof depth, "%.3g", low.lowest_m);
  const std::size_t count = low.apart.size();
  return std::to_string(count) +
         forCount(count, " node of the flood plain lies below the still water without a connection to it, by ",
                  " nodes of the flood plain lie below the still water without a connection to it, the lowest by ") +
         depth + " m at " + pointText(low.lowest) + ": " +
         (marked ? std::string(kStartsDry) + " is 1 there, by which ADCIRC starts them dry"
                 : "models start them wet, unless they are told otherwise, as ADCIRC by " + std::string(kStartsDry));
}

}  // namespace coastmesh
