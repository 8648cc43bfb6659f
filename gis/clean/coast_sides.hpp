#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gis/clean/clean_nodes.hpp"
#include "gis/geometry/planar_map.hpp"

namespace coastmesh {

// An edge of the map, as used by coasts.
struct CoastEdge {
  VertexId low = kNone, high = kNone;
  bool parts = false;  // a coast runs along it: water on one side, land on the other
  // Number of coasts that run upwards along it (from low to high) minus those that run downwards: usually 0, 1 or -1.
  int direction = 0;
  bool line = false;          // an open line of a coast
  bool of_frame = false;      // on the boundary of the frame
  std::uint32_t feature = 0;  // of the coast
};

struct CoastMap {
  const PlanarMap& map;
  std::vector<CoastEdge> edges;  // as numbered in the map
  std::vector<char> framed;      // by face: true if water may lie there; without a frame, all but the unbounded one
  std::optional<std::uint32_t> seed;  // a face that is water
};

// Returns for each face whether it is water. Crossing a coast leads from water to land or back; the seed decides which
// is which, otherwise OpenStreetMap's rule: water is to the right of a coast. Decisions go to `report.notes`. Throws
// InputError for a coast that ends without meeting another or the frame, for lines that do not agree on the rule, and
// for a frame without a coast.
std::vector<char> findWater(const CoastMap& coast, const CleanVertices& vertices, const Coastline& coastline,
                            const Projection& projection, CleanReport& report);

}  // namespace coastmesh
