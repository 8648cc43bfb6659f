#include "core/sphere/far_side.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/sphere/sphere_place.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/ocean_around.hpp"

namespace coastmesh {
namespace {

using namespace coastmesh::testing;

TEST(FarSide, TrianglesWithItsVerticesFaceOutwards) {
  const Pslg pslg = oceanAround(1.0);
  const std::vector<Point> far = farSideVertices(constrainedDelaunay(pslg, kEarth), kEarth);
  ASSERT_FALSE(far.empty());
  Pslg all = pslg;
  all.points.insert(all.points.end(), far.begin(), far.end());
  double covered = 0.0;
  for (const Triangle& t : constrainedDelaunay(all, kEarth).triangles) {
    const auto at = [&](unsigned i) { return placeOnSphere(all.points[t.v[i]], kEarth); };
    EXPECT_GT(dot(at(0), cross(at(1), at(2))), 0.0);
    covered += solidAngle(at(0), at(1), at(2));
  }
  EXPECT_GT(covered, 4.0 * std::numbers::pi - 0.01);
}

TEST(FarSide, OtherMeshesNeedNone) {
  // The input surrounds the domain.
  EXPECT_TRUE(farSideVertices(constrainedDelaunay(oceanAround(110.0), kEarth), kEarth).empty());
  // The domain is a cap of one hemisphere.
  EXPECT_TRUE(farSideVertices(constrainedDelaunay(oceanAround(178.0), kEarth), kEarth).empty());
}

}  // namespace
}  // namespace coastmesh
