#include "gis/cut/even_cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/metric.hpp"
#include "core/quality.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

using coastmesh::testing::lattice;

using Flags = std::vector<std::uint8_t>;

Flags opposite(Flags flags) {
  for (std::uint8_t& flag : flags) flag = flag == 0;
  return flags;
}

TEST(EvenCut, ATooth) {
  const TriMesh mesh = lattice(6, 6, [](int, int) { return true; });
  Flags taken(mesh.triangles.size());
  for (TriId t = 0; t < taken.size(); ++t) {
    const auto& v = mesh.triangles[t].v;
    const Point middle = centroid(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
    taken[t] = middle.x < 3.0 || (middle.x < 3.5 && middle.y > 2.0 && middle.y < 3.0);
  }
  Flags rest = opposite(taken);
  const Flags before = taken;
  const auto of_part = evenCut(mesh, {}, taken), of_rest = evenCut(mesh, {}, rest);
  ASSERT_TRUE(of_part && of_rest);
  EXPECT_NE(taken, before);
  EXPECT_EQ(of_part->given + of_part->taken_in, 1u);
  EXPECT_EQ(of_part->given, of_rest->taken_in);
  EXPECT_EQ(of_part->taken_in, of_rest->given);
  EXPECT_EQ(taken, opposite(rest));
}

TEST(EvenCut, BothSidesAreTreatedAlike) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const TriMesh mesh = lattice(14, 14, [&](int, int) { return random() % 12 != 0; });
    const std::uint64_t every = 2 + random() % 12;
    std::uniform_real_distribution<double> place(0.0, 14.0);
    const Point a{place(random), 0.0}, b{place(random), 14.0};
    Flags taken(mesh.triangles.size());
    for (TriId t = 0; t < taken.size(); ++t) {
      const auto& v = mesh.triangles[t].v;
      const Point middle = centroid(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
      taken[t] = (signedArea(a, b, middle) > 0.0) != (random() % every == 0);
    }
    Flags rest = opposite(taken), again = taken;
    const auto of_part = evenCut(mesh, {}, taken), of_rest = evenCut(mesh, {}, rest);
    EXPECT_EQ(taken, opposite(rest));
    ASSERT_EQ(of_part.has_value(), of_rest.has_value());
    if (of_part) {
      EXPECT_EQ(of_part->given, of_rest->taken_in);
      EXPECT_EQ(of_part->taken_in, of_rest->given);
    }
    evenCut(mesh, {}, again, testing::backwards);
    EXPECT_EQ(again, taken);
  }
}

TEST(EvenCut, LeavesSingleTrianglesThatAreAllThereIs) {
  const TriMesh mesh = lattice(6, 6, [](int, int) { return true; });
  Flags taken(mesh.triangles.size(), 0);
  taken[30] = 1;
  Flags rest = opposite(taken);
  const Flags before = taken, rest_before = rest;
  EXPECT_FALSE(evenCut(mesh, {}, taken));
  EXPECT_FALSE(evenCut(mesh, {}, rest));
  EXPECT_EQ(taken, before);
  EXPECT_EQ(rest, rest_before);
}

}  // namespace
}  // namespace coastmesh
