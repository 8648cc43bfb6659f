#include "gis/merge/enclosed_gaps.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/triangulate/delaunay.hpp"
#include "gis/geometry/ring_area.hpp"

namespace coastmesh {

namespace {

std::vector<Point> placesOf(const TriMesh& mesh, const std::vector<VertexId>& ring) {
  std::vector<Point> places;
  for (const VertexId v : ring) places.push_back(mesh.points[v]);
  return places;
}

bool passesNodesOnce(std::vector<VertexId> ring) {
  std::ranges::sort(ring);
  return std::ranges::adjacent_find(ring) == ring.end();
}

}  // namespace

std::vector<std::array<VertexId, 3>> fillEnclosed(const TriMesh& mesh, const std::function<EndKind(EdgeRef)>& kindOf,
                                                  const ItemLoop& loop) {
  std::map<std::pair<VertexId, VertexId>, EndKind> open;
  for (TriId t = 0; t < mesh.triangles.size(); ++t)
    for (unsigned i = 0; i < 3; ++i)
      if (const EdgeRef e = edgeRef(t, i); mesh.twin(e) == kNone)
        if (const EndKind kind = kindOf(e); kind != EndKind::Shore) open[{mesh.origin(e), mesh.target(e)}] = kind;
  std::vector<std::array<VertexId, 3>> triangles;
  if (open.empty()) return triangles;
  for (const std::vector<VertexId>& ring : boundaryLoops(mesh, loop)) {
    bool all_open = true, of_one = false, of_other = false;
    for (std::size_t i = 0; i < ring.size() && all_open; ++i) {
      const auto found = open.find({ring[i], ring[(i + 1) % ring.size()]});
      all_open = found != open.end();
      if (all_open) (found->second == EndKind::OpenOfOne ? of_one : of_other) = true;
    }
    if (!all_open || !of_one || !of_other || !passesNodesOnce(ring)) continue;
    Pslg pslg;
    pslg.points = placesOf(mesh, ring);
    if (signedAreaOf(pslg.points) > 0.0) continue;  // around a mesh
    const auto n = static_cast<VertexId>(ring.size());
    for (VertexId i = 0; i < n; ++i) pslg.segments.push_back({i, (i + 1) % n});
    for (const Triangle& t : constrainedDelaunay(pslg).triangles)
      triangles.push_back({ring[t.v[0]], ring[t.v[1]], ring[t.v[2]]});
  }
  return triangles;
}

}  // namespace coastmesh
