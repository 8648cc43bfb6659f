#include "core/triangulate/triangulation.hpp"

#include "core/predicates.hpp"

namespace coastmesh {

TriId walkTo(const Triangulation& triangulation, const Point& x, TriId from) {
  const LinkedTriangles& mesh = triangulation.mesh;
  const std::span<const Point> points = triangulation.points;
  TriId t = from;
  if (triangulation.isGhost(t)) t = triOf(mesh.triangles[t].adj[mesh.cornerOf(t, triangulation.ghost)]);
  EdgeRef came = kNone;
  for (std::size_t steps = 0; steps <= mesh.triangles.size(); ++steps) {
    EdgeRef onward = kNone;
    for (unsigned i = 0; i < 3 && onward == kNone; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (e != came && orient2d(points[mesh.origin(e)], points[mesh.target(e)], x) < 0) onward = e;
    }
    if (onward == kNone) return t;
    came = mesh.twin(onward);
    t = triOf(came);
    if (triangulation.isGhost(t)) return t;
  }
  return kNone;
}

TriId locate(const Triangulation& triangulation, const Point& x, TriId near) {
  const TriId walked = walkTo(triangulation, x, near);
  if (walked != kNone) return walked;
  const std::span<const Point> points = triangulation.points;
  TriId ghost = kNone;
  for (TriId t = 0; t < triangulation.mesh.triangles.size(); ++t) {
    const auto& v = triangulation.mesh.triangles[t].v;
    if (triangulation.isGhost(t)) {
      ghost = t;
    } else if (orient2d(points[v[0]], points[v[1]], x) >= 0 && orient2d(points[v[1]], points[v[2]], x) >= 0 &&
               orient2d(points[v[2]], points[v[0]], x) >= 0) {
      return t;
    }
  }
  return ghost;
}

}  // namespace coastmesh
