#include "gis/size/node_sizes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/refine/refine.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/pslgs.hpp"
#include "tests/support/size_figures.hpp"

namespace coastmesh {
namespace {

TEST(NodeSizes, NoTwoNeighboursDifferMore) {
  const Pslg pslg = squarePslg();
  const SizeOf size(0.01, 1.0, [](const Point& p) { return 0.02 + 0.4 * std::hypot(p.x - 0.3, p.y - 0.3); });
  TriMesh mesh = constrainedDelaunay(pslg);
  refine(mesh, pslg, {.min_angle_deg = 30.0, .size = &size});
  constexpr double kGradation = 0.2, kScale = 2.0;
  const std::vector<double> sizes = nodeSizes(mesh, size, kGradation, [](VertexId) { return kScale; });
  ASSERT_EQ(sizes.size(), mesh.points.size());
  bool lowered = false;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const VertexId a = mesh.origin(edgeRef(t, i)), b = mesh.target(edgeRef(t, i));
      EXPECT_LE(std::abs(sizes[a] - sizes[b]), kGradation * distance(mesh.points[a], mesh.points[b]) / kScale);
      EXPECT_LE(sizes[a], size.at(mesh.points[a]) / kScale + 1e-12);
      lowered |= sizes[a] < 0.9 * size.at(mesh.points[a]) / kScale;
    }
  }
  EXPECT_TRUE(lowered);
}

}  // namespace
}  // namespace coastmesh
