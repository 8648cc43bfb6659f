#include "core/input_angle.hpp"

#include <numbers>

namespace coastmesh {

bool mayBeSmall(const TriMesh& mesh, TriId t, unsigned i, const TriangleBound& bound) {
  if (bound.max_angle < std::numbers::pi) return true;
  const VertexId v = mesh.triangle(t).v[i];
  const Point along = mesh.point(mesh.triangle(t).v[next3(i)]) - mesh.point(v);
  while (true) {
    const unsigned c = mesh.cornerOf(t, v);
    if (dot(along, mesh.point(mesh.triangle(t).v[prev3(c)]) - mesh.point(v)) <= 0.0) return false;
    const EdgeRef in = edgeRef(t, next3(c));
    if (mesh.segment(in) != kNone || mesh.twin(in) == kNone) return true;
    t = triOf(mesh.twin(in));
  }
}

namespace {

struct Explained {
  std::vector<TriId> inside;  // a sector
  std::vector<TriId> beyond;  // one of its sides, at the far end
};

// The sector that begins with corner i of t, if it is one and cannot be divided.
void explainSector(const TriMesh& mesh, TriId t, unsigned i, const TriangleBound& bound, Explained& explained) {
  const VertexId v = mesh.triangles[t].v[i];
  const EdgeRef right = edgeRef(t, prev3(i));
  if (mesh.segment(right) == kNone && mesh.twin(right) != kNone) return;
  // Only at input vertices do segments meet at an angle.
  if (mesh.input_vertices != 0 && v >= mesh.input_vertices) return;
  if (!mayBeSmall(mesh, t, i, bound)) return;
  const Sector sector = sectorAt(mesh, t, i);
  if (bound.canDivide(sector.angle)) return;
  const auto note = [&](TriId beyond) { explained.beyond.push_back(beyond); };
  forEachBeyond(mesh, sector.right, mesh.target(sector.right), note);
  forEachBeyond(mesh, sector.left, mesh.origin(sector.left), note);
  for (unsigned left = sector.triangles; left > 0; --left) {
    const unsigned c = mesh.cornerOf(t, v);
    const double here =
        angleAt(mesh.point(v), mesh.point(mesh.triangle(t).v[next3(c)]), mesh.point(mesh.triangle(t).v[prev3(c)]));
    // Without a largest angle a triangle whose own angle is good has no excuse here.
    if (bound.max_angle < std::numbers::pi || here < bound.min_angle) explained.inside.push_back(t);
    if (left > 1) t = triOf(mesh.twin(edgeRef(t, next3(c))));
  }
}

}  // namespace

std::vector<bool> explainedTriangles(const TriMesh& mesh, const TriangleBound& bound, const ItemLoop& loop) {
  // Every sector once, from its right side.
  const std::vector<Explained> parts =
      overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
        Explained some;
        for (auto t = static_cast<TriId>(first); t < last; ++t)
          for (unsigned i = 0; i < 3; ++i) explainSector(mesh, t, i, bound, some);
        return some;
      });
  std::vector<bool> explained(mesh.triangles.size(), false);
  for (const Explained& part : parts) {
    for (const TriId t : part.beyond) explained[t] = true;
    for (const TriId t : part.inside) {
      explained[t] = true;
      for (unsigned i = 0; i < 3; ++i)
        if (mesh.triangles[t].adj[i] != kNone) explained[triOf(mesh.triangles[t].adj[i])] = true;
    }
  }
  return explained;
}

}  // namespace coastmesh
