// Meshes a square with the core alone; exit code 1 if the mesh does not meet the options.
#include <cmath>
#include <cstdio>

#include "core/quality.hpp"
#include "core/refine/check.hpp"
#include "core/refine/refine.hpp"
#include "core/triangulate/delaunay.hpp"

int main() {
  using namespace coastmesh;
  Pslg square;
  square.points = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 2}};
  square.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  RefineOptions options;
  options.min_angle_deg = 30;
  TriMesh mesh = constrainedDelaunay(square);
  const RefineStats stats = refine(mesh, square, options);
  const MeshQuality quality = measureQuality(mesh, options.min_angle_deg);
  CheckOptions checks;
  checks.min_angle_deg = options.min_angle_deg;
  const bool sound = checkMesh(mesh, &square, checks).empty();
  std::printf("%zu triangles, smallest angle %.3f degrees, %zu unresolved\n", mesh.triangles.size(),
              quality.min_angle_deg, stats.unresolved.size());
  return sound && std::abs(quality.area - 16.0) < 1e-12 && quality.min_angle_deg >= 30.0 && stats.unresolved.empty()
             ? 0
             : 1;
}
