// Writes a PSLG with gis, reads it back and meshes it with parallel; exit code 1 if anything was lost on the way.
#include <cstdio>

#include "core/quality.hpp"
#include "gis/format/poly_io.hpp"
#include "parallel/mesh_regions.hpp"
#include "parallel/workers.hpp"

int main() {
  using namespace coastmesh;
  Pslg square;
  square.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.3, 0.1}};
  square.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  writePoly(square, "square.poly");
  const Pslg read = readPoly("square.poly");
  if (read.points != square.points || read.segments.size() != square.segments.size()) return 1;

  MeshedRegion region;
  withThreads(ParallelOptions{}, [&] { region = meshRegion(read, MeshOptions{}); });
  const MeshQuality quality = measureQuality(region.mesh, MeshOptions{}.refine.min_angle_deg);
  std::printf("%zu triangles, smallest angle %.3f degrees\n", region.mesh.triangles.size(), quality.min_angle_deg);
  return quality.bounds.below == 0 && quality.triangles > 0 ? 0 : 1;
}
