#include "gis/rivers/fill_junction.hpp"

#include "core/refine/refine.hpp"
#include "core/triangulate/delaunay.hpp"

namespace coastmesh {

JunctionMesh fillJunction(const JunctionOutline& outline, const RefineOptions& options) {
  Pslg pslg;
  pslg.points = outline.points;
  const auto n = static_cast<VertexId>(outline.points.size());
  for (VertexId i = 0; i < n; ++i) {
    Segment& side = pslg.segments.emplace_back();
    side.a = i;
    side.b = (i + 1) % n;
    side.divide = outline.keeps[i] != 0 ? Divide::Never : Divide::Freely;
  }
  TriMesh mesh = constrainedDelaunay(pslg);
  refine(mesh, pslg, options);
  coarsen(mesh, pslg, options);
  JunctionMesh filled;
  filled.points.assign(mesh.points.begin(), mesh.points.end());
  for (const Triangle& t : mesh.triangles) filled.triangles.push_back({t.v[0], t.v[1], t.v[2]});
  return filled;
}

}  // namespace coastmesh
