// Oceans whose shore lies in a small part of one hemisphere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/sphere/sphere_place.hpp"
#include "parallel/mesh_regions.hpp"

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

// An island about as large as an edge, of which all triangles seem to be.
TEST(OceanAroundIsland, AsLargeAsAnEdge) {
  for (const double radius_deg : {0.5, 1.0, 2.0, 5.0}) {
    MeshOptions options;
    options.refine.surface = kEarth;
    options.refine.size_max = std::max(3e5, 8.5e4 * radius_deg);
    const MeshedRegion region = meshRegion(oceanAround(radius_deg), options, {});
    double covered = 0.0, longest = 0.0;
    for (const Triangle& t : region.mesh.triangles) {
      const auto at = [&](unsigned i) { return placeOnSphere(region.mesh.points[t.v[i]], kEarth); };
      covered += solidAngle(at(0), at(1), at(2));
      for (unsigned i = 0; i < 3; ++i)
        longest = std::max(longest, kEarth.chord(region.mesh.points[t.v[i]], region.mesh.points[t.v[(i + 1) % 3]]));
    }
    EXPECT_NEAR(covered, 2.0 * std::numbers::pi * (1.0 + std::cos(radius_deg * std::numbers::pi / 180.0)), 0.02);
    EXPECT_LE(longest, 1.001 * options.refine.size_max);
    EXPECT_TRUE(region.stats.unresolved.empty()) << radius_deg;
  }
}

}  // namespace
}  // namespace coastmesh
