#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "gis/geometry/box_tree.hpp"
#include "gis/geometry/planar_map.hpp"

namespace coastmesh {

// Finds the face of a plane graph in which a point lies.
class FaceLocator {
 public:
  // REQUIRES: the arguments outlive the locator, which keeps references.
  FaceLocator(const PlanarMap& map, const std::vector<Point>& points,
              const std::vector<std::pair<VertexId, VertexId>>& edges);

  // The face that contains `place`; for a point on an edge, the face above it; on a vertical edge, either face. Exact.
  std::uint32_t faceAt(const Point& place) const;

 private:
  const PlanarMap& map_;
  const std::vector<Point>& points_;
  const std::vector<std::pair<VertexId, VertexId>>& edges_;
  BoxTree tree_;
};

}  // namespace coastmesh
