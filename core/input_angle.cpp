#include "core/input_angle.hpp"

#include <numbers>

namespace coastmesh {

bool mayBeSmall(const TriMesh& mesh, TriId t, unsigned i, const TriangleBound& bound) {
  if (bound.max_angle < std::numbers::pi) return true;
  constexpr double kHair = 0.01;  // cosine; a bound of 45 degrees cannot divide right angles, rounded or not
  const VertexId v = mesh.triangle(t).v[i];
  const Point along = mesh.point(mesh.triangle(t).v[next3(i)]) - mesh.point(v);
  while (true) {
    const unsigned c = mesh.cornerOf(t, v);
    const Point here = mesh.point(mesh.triangle(t).v[prev3(c)]) - mesh.point(v);
    const double cosine = dot(along, here);
    if (cosine < 0.0 && cosine * cosine > kHair * kHair * squaredLength(along) * squaredLength(here)) return false;
    const EdgeRef in = edgeRef(t, next3(c));
    if (mesh.segment(in) != kNone || mesh.twin(in) == kNone) return true;
    t = triOf(mesh.twin(in));
  }
}

}  // namespace coastmesh
