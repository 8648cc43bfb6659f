// Oceans whose shore lies in a small part of one hemisphere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/sphere/sphere_place.hpp"
#include "parallel/mesh_regions.hpp"
#include "tests/support/ocean_around.hpp"

namespace coastmesh {
namespace {

using namespace coastmesh::testing;

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
