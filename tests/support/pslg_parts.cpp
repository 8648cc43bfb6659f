#include "tests/support/pslg_parts.hpp"

namespace coastmesh {

VertexId addPoint(Pslg& pslg, const Point& p) {
  pslg.points.push_back(p);
  return static_cast<VertexId>(pslg.points.size() - 1);
}

void addSegment(Pslg& pslg, VertexId a, VertexId b, RegionId left, RegionId right) {
  pslg.segments.push_back({a, b, static_cast<std::int32_t>(pslg.segments.size() + 1), left, right});
}

void closeRing(Pslg& pslg, const std::vector<VertexId>& ring, RegionId left, RegionId right) {
  for (std::size_t i = 0; i < ring.size(); ++i) addSegment(pslg, ring[i], ring[(i + 1) % ring.size()], left, right);
}

std::vector<VertexId> addRing(Pslg& pslg, const std::vector<Point>& points, RegionId left, RegionId right) {
  std::vector<VertexId> ring;
  ring.reserve(points.size());
  for (const Point& p : points) ring.push_back(addPoint(pslg, p));
  closeRing(pslg, ring, left, right);
  return ring;
}

}  // namespace coastmesh
