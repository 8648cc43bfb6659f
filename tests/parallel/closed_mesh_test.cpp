#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/links.hpp"
#include "core/metric.hpp"
#include "core/sphere/clear_places.hpp"
#include "core/sphere/sphere_lattice.hpp"
#include "core/sphere/sphere_place.hpp"
#include "parallel/mesh_regions.hpp"
#include "parallel/workers.hpp"
#include "tests/support/closed_lattice.hpp"

namespace coastmesh {
namespace {

constexpr double kRadius = 6.371e6;
const Surface kEarth = Surface::sphere(kRadius);

struct Figures {
  double least_angle = 180.0, area = 0.0;
  double area_near_size = 0.0;  // of triangles whose edges are all 0.7 to 1.4 of the size
};

// Uses chords only.
Figures measure(const TriMesh& mesh, double size) {
  Figures figures;
  for (const Triangle& t : mesh.triangles) {
    std::array<SpacePoint, 3> p;
    for (unsigned i = 0; i < 3; ++i) p[i] = kRadius * placeOnSphere(mesh.point(t.v[i]), kEarth);
    const SpacePoint normal = cross(p[1] - p[0], p[2] - p[0]);
    EXPECT_GT(dot(normal, p[0] + p[1] + p[2]), 0.0);
    const double area = 0.5 * lengthOf(normal);
    bool near = true;
    for (unsigned i = 0; i < 3; ++i) {
      const SpacePoint u = p[next3(i)] - p[i], v = p[prev3(i)] - p[i];
      figures.least_angle = std::min(figures.least_angle, toDegrees(std::atan2(lengthOf(cross(u, v)), dot(u, v))));
      near = near && lengthOf(u) > 0.7 * size && lengthOf(u) < 1.4 * size;
    }
    figures.area += area;
    if (near) figures.area_near_size += area;
  }
  return figures;
}

void expectClosed(const TriMesh& mesh) {
  ASSERT_EQ(findBrokenLink(mesh.triangles), kNone);
  const auto used = usedVertices(mesh);
  EXPECT_EQ(std::ranges::count(used, std::uint8_t{0}), 0);
  for (TriId t = 0; t < mesh.triangles.size(); ++t)
    for (unsigned i = 0; i < 3; ++i) EXPECT_NE(mesh.twin(edgeRef(t, i)), kNone);
  EXPECT_EQ(2 * mesh.points.size(), mesh.triangles.size() + 4);  // Euler's formula for the sphere
  EXPECT_EQ(mesh.regions.size(), mesh.triangles.size());
}

MeshOptions latticeOptions(const Pslg& pslg, double size) {
  MeshOptions options;
  options.refine.surface = kEarth;
  const std::vector<SpacePoint> places = placesOf(sphereLattice(size / kRadius));
  options.cap = latticeCap(places, kEarth);
  options.seeds = clearPlaces(places, pslg, options.cap.ring, kEarth, 0.6 * size);
  return options;
}

MeshOptions freeOptions(const Pslg& pslg, double min_angle_deg) {
  MeshOptions options = latticeOptions(pslg, 0.6 * kRadius);
  options.refine.min_angle_deg = min_angle_deg;
  return options;
}

TEST(ClosedMesh, AnEmptyGlobeIsTheLattice) {
  const Pslg nothing;
  const ConstantSize size(5e5);
  MeshOptions options = latticeOptions(nothing, 5e5);
  options.refine.size = &size;
  options.cap_region = 3;
  const MeshedRegion region = meshRegion(nothing, options);
  expectClosed(region.mesh);
  EXPECT_EQ(static_cast<std::int64_t>(region.mesh.triangles.size()), sphereLattice(5e5 / kRadius).triangles());
  EXPECT_TRUE(region.stats.unresolved.empty());
  EXPECT_TRUE(std::ranges::all_of(region.mesh.regions, [](RegionId r) { return r == 3; }));
  const Figures figures = measure(region.mesh, 5e5);
  EXPECT_GT(figures.least_angle, 48.9);
  EXPECT_EQ(figures.area_near_size, figures.area);
}

TEST(ClosedMesh, ALatticeIsTheResultWhereItKeepsTheBounds) {
  const Pslg nothing;
  MeshOptions options = latticeOptions(nothing, 5e5);
  options.seeds.clear();
  options.cap_region = 2;
  options.lattice = meshOf({20, 0}, kEarth);
  options.cap =
      sphereCap(kEarth, std::vector<Point>(options.lattice.points.begin(), options.lattice.points.begin() + 5));
  const MeshedRegion taken = meshRegion(nothing, options);
  expectClosed(taken.mesh);
  EXPECT_EQ(digestOf(taken.mesh), digestOf(options.lattice));
  EXPECT_TRUE(std::ranges::all_of(taken.mesh.regions, [](RegionId r) { return r == 2; }));
  // The lattice has angles of 72 degrees, at its vertices of valence 5.
  options.refine.max_angle_deg = 71.0;
  options.refine.min_angle_deg = 30.0;
  const MeshedRegion refined = meshRegion(nothing, options);
  expectClosed(refined.mesh);
  EXPECT_NE(digestOf(refined.mesh), digestOf(options.lattice));
  EXPECT_GE(refined.mesh.points.size(), 12u);
}

TEST(ClosedMesh, CoastsAreEdgesBetweenRegions) {
  Pslg pslg;
  // Two islands, one around the projection centre.
  const auto addRing = [&](const SpacePoint& middle, double reach, RegionId region, unsigned corners) {
    const SpacePoint east =
        (1.0 / std::hypot(middle.x, middle.y, 1e-12)) * SpacePoint{-middle.y + 1e-12, middle.x, 0.0};
    const SpacePoint north = cross(middle, east);
    const auto first = static_cast<VertexId>(pslg.points.size());
    for (unsigned i = 0; i < corners; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / corners, out = reach * (1.0 + 0.2 * std::sin(5.0 * angle));
      pslg.points.push_back(
          planeOf(std::cos(out) * middle + std::sin(out) * (std::cos(angle) * east + std::sin(angle) * north), kEarth));
      pslg.segments.push_back({first + i, first + (i + 1) % corners, 0, region, 2});
    }
  };
  addRing({0.0, 0.0, 1.0}, 0.5, 0, 40);
  addRing({std::sin(2.0), 0.0, std::cos(2.0)}, 0.3, 1, 30);
  const double size = 4e5;
  const ConstantSize sizes(size);
  MeshOptions options = latticeOptions(pslg, size);
  options.refine.size = &sizes;
  options.cap_region = 2;
  const MeshedRegion region = meshRegion(pslg, options);
  expectClosed(region.mesh);
  EXPECT_TRUE(region.stats.unresolved.empty());
  EXPECT_GT(measure(region.mesh, size).least_angle, 33.0);
  for (TriId t = 0; t < region.mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      EXPECT_EQ(region.mesh.segment(e) != kNone,
                region.mesh.regions[t] != region.mesh.regions[triOf(region.mesh.twin(e))]);
    }
  }
  EXPECT_EQ(std::ranges::count(region.mesh.regions, 0) > 50, true);
  EXPECT_EQ(std::ranges::count(region.mesh.regions, 1) > 20, true);
  EXPECT_EQ(region.mesh.regions.back(), 2);
}

TEST(ClosedMesh, TwoPointsAMetreApartNeedNotManyMore) {
  Pslg pslg;
  pslg.points = {{0.0, 0.0}, {1.0, 0.2}};
  for (const double angle : {30.0, 38.0, 42.0}) {
    const MeshedRegion region = meshRegion(pslg, freeOptions(pslg, angle));
    expectClosed(region.mesh);
    EXPECT_TRUE(region.stats.unresolved.empty()) << angle;
    EXPECT_GE(measure(region.mesh, 1.0).least_angle, angle);
    if (angle == 30.0) {
      EXPECT_LE(region.mesh.points.size(), 302u);
    }
    RecordProperty("vertices", static_cast<int>(region.mesh.points.size()));
  }
}

TEST(ClosedMesh, IsTheSameForAnyNumberOfThreads) {
  Pslg pslg;
  pslg.points = {{0.0, 0.0}, {3e5, 1e5}, {1e7, -4e6}};
  pslg.segments = {{0, 1, 0, 0, 0}};
  const ConstantSize sizes(8e4);
  std::uint64_t digest = 0;
  for (const int threads : {1, 2, 3}) {
    MeshOptions options = latticeOptions(pslg, 8e4);
    options.refine.size = &sizes;
    MeshedRegion region;
    withThreads({.threads = threads}, [&] { region = meshRegion(pslg, options); });
    expectClosed(region.mesh);
    EXPECT_GT(region.pieces, 1u);
    if (threads == 1) digest = digestOf(region.mesh);
    EXPECT_EQ(digestOf(region.mesh), digest);
  }
}

}  // namespace
}  // namespace coastmesh
