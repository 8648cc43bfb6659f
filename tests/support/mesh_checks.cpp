#include "tests/support/mesh_checks.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace coastmesh {

std::string describe(const std::vector<MeshDefect>& defects) {
  constexpr std::size_t kMost = 20;
  std::ostringstream text;
  text.precision(17);
  for (std::size_t i = 0; i < defects.size() && i < kMost; ++i) {
    const MeshDefect& d = defects[i];
    text << toString(d.kind) << " at " << d.place.x << ", " << d.place.y;
    if (d.triangle != kNone) text << ", triangle " << d.triangle;
    if (d.value != 0.0) text << ", value " << d.value;
    text << '\n';
  }
  if (defects.size() > kMost) text << "and " << defects.size() - kMost << " more\n";
  return text.str();
}

void expectValidMesh(const TriMesh& mesh, const Pslg& pslg, const CheckOptions& options) {
  EXPECT_FALSE(mesh.triangles.empty());
  EXPECT_EQ(mesh.regions.size(), mesh.triangles.size());
  EXPECT_EQ(mesh.input_vertices, pslg.points.size());
  EXPECT_EQ(describe(checkMesh(mesh, &pslg, options)), "");
}

void expectValidMesh(const TriMesh& mesh, const CheckOptions& options) {
  EXPECT_EQ(describe(checkMesh(mesh, nullptr, options)), "");
}

TriMesh meshOf(std::vector<Point> points, const std::vector<std::array<VertexId, 3>>& corners) {
  std::vector<EdgeConflict> conflicts;
  TriMesh mesh = linkTriangles({points.begin(), points.end()}, corners, conflicts);
  EXPECT_TRUE(conflicts.empty());
  return mesh;
}

}  // namespace coastmesh
