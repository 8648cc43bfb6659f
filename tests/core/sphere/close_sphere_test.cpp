#include "core/sphere/close_sphere.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/links.hpp"
#include "core/predicates.hpp"
#include "core/sphere/sphere_place.hpp"
#include "tests/support/closed_lattice.hpp"

namespace coastmesh {
namespace {

const Surface kEarth = Surface::sphere(6.371e6);

// Positive if the corners run counter-clockwise as seen from outside the sphere.
double turnOf(const Point& a, const Point& b, const Point& c) {
  const SpacePoint p = placeOnSphere(a, kEarth), q = placeOnSphere(b, kEarth), r = placeOnSphere(c, kEarth);
  return dot(cross(q - p, r - p), p + q + r);
}

TEST(CloseSphere, LeavesNoEdgeWithOneTriangleAlone) {
  const TriMesh mesh = closedLattice({6, 2}, kEarth);
  EXPECT_EQ(findBrokenLink(mesh.triangles), kNone);
  std::size_t edges = 0;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      ASSERT_NE(mesh.twin(e), kNone);
      EXPECT_EQ(mesh.segment(e), kNone);
      if (mesh.twin(e) > e) ++edges;
    }
  }
  EXPECT_EQ(static_cast<long>(mesh.points.size()) - static_cast<long>(edges) + static_cast<long>(mesh.triangles.size()),
            2);
  EXPECT_EQ(mesh.regions.size(), mesh.triangles.size());
  EXPECT_TRUE(isClosed(mesh));
  EXPECT_EQ(eulerNumber(mesh), 2);
}

TEST(CloseSphere, TrianglesFaceOutwardsWhateverThePlaneSays) {
  const TriMesh mesh = closedLattice({6, 2}, kEarth);
  std::size_t turned = 0;
  for (const Triangle& t : mesh.triangles) {
    const Point &a = mesh.point(t.v[0]), &b = mesh.point(t.v[1]), &c = mesh.point(t.v[2]);
    EXPECT_GT(turnOf(a, b, c), 0.01);
    if (orient2d(a, b, c) <= 0) ++turned;
  }
  EXPECT_GT(turned, 0u);
  EXPECT_LE(turned, 5u);  // only those around the apex
}

TEST(CloseSphere, CornersOfARingLieAsFarFromTheApexAsAsked) {
  for (const double distance : {1.0, 1e4, 3e6, 1.2e7}) {
    const SphereCap cap = sphereCap(kEarth, distance, 6);
    ASSERT_EQ(cap.ring.size(), 6u);
    const SpacePoint apex = placeOnSphere(cap.apex, kEarth);
    for (const Point& x : cap.ring)
      EXPECT_NEAR(lengthOf(placeOnSphere(x, kEarth) - apex) * 6.371e6, distance, 1e-6 * distance + 1e-8);
    for (unsigned i = 0; i < 6; ++i) EXPECT_GT(orient2d({0, 0}, cap.ring[i], cap.ring[(i + 1) % 6]), 0);
  }
}

}  // namespace
}  // namespace coastmesh
