#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "gis/geometry/edges_below.hpp"
#include "gis/geometry/planar_map.hpp"

namespace coastmesh {

// Finds the face of a plane graph in which a point lies.
class FaceLocator {
 public:
  // REQUIRES: the arguments outlive the locator, which keeps references.
  FaceLocator(const PlanarMap& map, const std::vector<Point>& points,
              const std::vector<std::pair<VertexId, VertexId>>& edges)
      : map_(map), edges_(points, edges) {}

  // The face that contains `place`; for a point on an edge, the face above it; on a vertical edge, either face. Exact.
  std::uint32_t faceAt(const Point& place) const {
    const std::uint32_t below = edges_.at(place);
    if (below == kNone) return PlanarMap::kOuterFace;
    return map_.faceOf(2 * below + (edges_.runsEast(below) ? 0u : 1u));  // to the left of the edge, taken eastwards
  }

 private:
  const PlanarMap& map_;
  EdgesBelow edges_;
};

}  // namespace coastmesh
