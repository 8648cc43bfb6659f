#include "core/sphere/far_side.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/sphere/sphere_place.hpp"
#include "core/triangulate/delaunay.hpp"

namespace coastmesh {
namespace {

const Surface kEarth = Surface::sphere(6.371e6);

// A ring of places at an angle from the point at infinity; the domain is all but what is around that point.
Pslg oceanAround(double from_infinity_deg, VertexId corners = 9) {
  Pslg pslg;
  const double angle = from_infinity_deg * std::numbers::pi / 180.0;
  for (VertexId i = 0; i < corners; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / corners + 0.1;
    pslg.points.push_back(
        planeOf({std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), -std::cos(angle)}, kEarth));
    pslg.segments.push_back({i, (i + 1) % corners});
  }
  return pslg;
}

// The solid angle of a triangle (van Oosterom and Strackee 1983).
double solidAngle(const SpacePoint& a, const SpacePoint& b, const SpacePoint& c) {
  return 2.0 * std::atan2(dot(a, cross(b, c)), 1.0 + dot(a, b) + dot(b, c) + dot(c, a));
}

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
