#include "core/sphere/sphere_lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/links.hpp"
#include "core/metric.hpp"
#include "core/quality.hpp"
#include "core/sphere/clear_places.hpp"
#include "core/sphere/sphere_place.hpp"
#include "tests/support/closed_lattice.hpp"

namespace coastmesh {
namespace {

TEST(SphereLattice, ComesNearToTheLengthAsked) {
  for (const double edge : {2.0, 1.0, 0.3, 0.08, 0.0157, 0.004}) {
    const SphereLattice lattice = sphereLattice(edge);
    EXPECT_LE(lattice.k, lattice.h);
    const double wanted = 4.0 * std::numbers::pi / (0.25 * std::numbers::sqrt3 * edge * edge);
    const double off = std::abs(static_cast<double>(lattice.triangles()) - std::max(20.0, wanted));
    EXPECT_LT(off, edge > 0.1 ? 40.0 : 0.02 * wanted) << edge;
  }
}

TEST(SphereLattice, TheFinestHasAsManyTrianglesAsCanBeNumbered) {
  EXPECT_LT(sphereLattice(kLeastLatticeEdge).triangles(), std::int64_t{kNone / 4});
}

TEST(SphereLattice, ItsPlacesAreTheVerticesOfEvenTrianglesRoundTheWholeSphere) {
  for (const SphereLattice lattice :
       {SphereLattice{1, 0}, SphereLattice{1, 1}, SphereLattice{2, 1}, SphereLattice{5, 0}, SphereLattice{4, 4},
        SphereLattice{7, 2}, SphereLattice{13, 11}}) {
    const std::vector<SpacePoint> places = placesOf(lattice);
    ASSERT_EQ(static_cast<std::int64_t>(places.size()), lattice.vertices());
    for (const SpacePoint& p : places) EXPECT_NEAR(lengthOf(p), 1.0, 1e-15);
    const TriMesh mesh = closedLattice(lattice, Surface::sphere(1.0));
    EXPECT_EQ(static_cast<std::int64_t>(mesh.triangles.size()), lattice.triangles());
    double least = 180.0, shortest = 2.0, longest = 0.0;
    std::array<int, 7> degrees{};
    std::vector<unsigned> degree(mesh.points.size(), 0);
    for (const Triangle& t : mesh.triangles) {
      std::array<SpacePoint, 3> p;
      for (unsigned i = 0; i < 3; ++i) {
        p[i] = placeOnSphere(mesh.point(t.v[i]), Surface::sphere(1.0));
        ++degree[t.v[i]];
      }
      for (unsigned i = 0; i < 3; ++i) {
        const SpacePoint u = p[next3(i)] - p[i], v = p[prev3(i)] - p[i];
        least = std::min(least, toDegrees(std::atan2(lengthOf(cross(u, v)), dot(u, v))));
        shortest = std::min(shortest, lengthOf(u));
        longest = std::max(longest, lengthOf(u));
      }
    }
    for (const unsigned d : degree) ++degrees[std::min(d, 6u)];
    EXPECT_EQ(degrees[5], 12) << lattice.h << " " << lattice.k;
    EXPECT_EQ(degrees[6], static_cast<int>(mesh.points.size()) - 12);
    EXPECT_GT(least, lattice.k == 0 ? 53.9 : 49.0) << lattice.h << " " << lattice.k;
    EXPECT_LT(longest / shortest, 1.25) << lattice.h << " " << lattice.k;
  }
}

TEST(SphereLattice, ItsMeshHasTheTrianglesOfADelaunayTriangulation) {
  const Surface surface = Surface::sphere(1.0);
  for (const std::int64_t h : {2, 3, 7, 20}) {
    const TriMesh mesh = meshOf({h, 0}, surface), other = closedLattice({h, 0}, surface);
    EXPECT_EQ(findBrokenLink(mesh.triangles), kNone);
    ASSERT_EQ(mesh.points, other.points) << h;
    // Rotated to begin at the smallest vertex.
    const auto cornersOf = [](const TriMesh& of) {
      std::vector<std::array<VertexId, 3>> all;
      for (const Triangle& t : of.triangles) {
        std::array<VertexId, 3> v = t.v;
        std::ranges::rotate(v, std::ranges::min_element(v));
        all.push_back(v);
      }
      std::ranges::sort(all);
      return all;
    };
    EXPECT_EQ(cornersOf(mesh), cornersOf(other)) << h;
  }
}

TEST(SphereLattice, LeavesOutWhatLiesTooNearToSegmentsAndPoints) {
  const Surface surface = Surface::sphere(6.371e6);
  const std::vector<SpacePoint> places = placesOf(sphereLattice(0.05));
  const SphereCap cap = latticeCap(places, surface);
  Pslg pslg;
  pslg.points = {{0.0, 0.0}, {9e6, 1e6}, {-1.5e7, -2e7}};
  pslg.segments = {{0, 1, 0, 0, 0}};
  const double clearance = 0.6 * 0.05 * 6.371e6;
  const std::vector<Point> clear = clearPlaces(places, pslg, cap.ring, surface, clearance);
  EXPECT_LT(clear.size(), places.size() - 6);
  EXPECT_GT(clear.size(), places.size() - 80);
  const auto distanceTo = [&](const Point& x, double share) {
    return surface.chord(x, pslg.points[0] + share * (pslg.points[1] - pslg.points[0]));
  };
  std::size_t further = 0;
  for (const SpacePoint& place : places) {
    if (place.z <= -1.0) continue;
    const Point x = planeOf(place, surface);
    double nearest = surface.chord(x, pslg.points[2]);
    for (double share = 0.0; share <= 1.0; share += 1e-4) nearest = std::min(nearest, distanceTo(x, share));
    const bool is_clear = std::ranges::any_of(clear, [&](const Point& c) { return c == x; });
    if (is_clear) {
      EXPECT_GT(nearest, 0.96 * clearance);
    }
    if (!is_clear && nearest > 1.01 * clearance) ++further;
  }
  EXPECT_EQ(further, 5u);  // the ring's own corners
}

TEST(SphereLattice, IsTheSameForAnyNumberOfThreads) {
  const SphereLattice lattice = sphereLattice(0.02);
  const ItemLoop backwards = [](std::size_t count, const auto& work) {
    for (std::size_t i = count; i-- > 0;) work(i);
  };
  const auto one = placesOf(lattice), other = placesOf(lattice, backwards);
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(distance(one[i], other[i]), 0.0);
}

}  // namespace
}  // namespace coastmesh
