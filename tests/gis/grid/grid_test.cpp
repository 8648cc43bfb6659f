#include "gis/grid/grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/bulk_list.hpp"
#include "core/quality.hpp"
#include "gis/clean/geodesic_area.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/grid/one_turn.hpp"
#include "gis/model/make_grid.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/bulk_lists.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using testing::lattice;

using Roles = std::vector<BoundaryRole>;

Roles rolesOf(const std::vector<Boundary>& boundaries) {
  Roles roles;
  for (const Boundary& boundary : boundaries) roles.push_back(boundary.role);
  return roles;
}

TEST(FindBoundaries, ALakeWithAnIsland) {
  const auto boundaries = findBoundaries(lattice(5, 5, [](int i, int j) { return i != 2 || j != 2; }));
  ASSERT_EQ(rolesOf(boundaries), (Roles{BoundaryRole::Land, BoundaryRole::Island}));
  EXPECT_EQ(boundaries[0].nodes.size(), 20u);
  // Clockwise, with the mesh to the left, from the least corner of the island.
  EXPECT_THAT(boundaries[1].nodes, ElementsAre(2 * 6 + 2, 3 * 6 + 2, 3 * 6 + 3, 2 * 6 + 3));
  for (const Boundary& boundary : boundaries) EXPECT_TRUE(boundary.closed);
}

TEST(FindBoundaries, TwoLakes) {
  EXPECT_EQ(rolesOf(findBoundaries(lattice(5, 2, [](int i, int) { return i != 2; }))),
            (Roles{BoundaryRole::Land, BoundaryRole::Land}));
}

TEST(FindBoundaries, ALakeOnAnIsland) {
  const auto wanted = [](int i, int j) { return i == 0 || j == 0 || i == 6 || j == 6 || (i == 3 && j == 3); };
  EXPECT_EQ(rolesOf(findBoundaries(lattice(7, 7, wanted))),
            (Roles{BoundaryRole::Land, BoundaryRole::Island, BoundaryRole::Land}));
}

// Two lakes that share a corner are separate: no edge of a triangle joins them.
TEST(FindBoundaries, LakesThatTouchInAVertex) {
  const auto boundaries = findBoundaries(lattice(2, 2, [](int i, int j) { return i == j; }));
  ASSERT_EQ(rolesOf(boundaries), (Roles{BoundaryRole::Land, BoundaryRole::Land}));
  EXPECT_EQ(boundaries[0].nodes.size(), 4u);
  EXPECT_EQ(boundaries[1].nodes.size(), 4u);
}

// Two islands that touch in a vertex are one loop that passes it twice.
TEST(FindBoundaries, IslandsThatTouchInAVertex) {
  const auto wanted = [](int i, int j) { return !(i == 2 && j == 2) && !(i == 3 && j == 3); };
  const auto boundaries = findBoundaries(lattice(6, 6, wanted));
  ASSERT_EQ(rolesOf(boundaries), (Roles{BoundaryRole::Land, BoundaryRole::Island}));
  EXPECT_EQ(boundaries[1].nodes.size(), 8u);
  EXPECT_EQ(std::ranges::count(boundaries[1].nodes, 3u * 7 + 3), 2);
}

// An island that touches the shore is one loop with it, even if they touch in the loop's least vertex.
TEST(FindBoundaries, AnIslandThatTouchesTheShore) {
  // A square of triangles around a square island, which share corner 0.
  const std::vector<std::array<VertexId, 3>> corners{{0, 1, 6}, {6, 1, 5}, {5, 1, 2}, {5, 2, 3}, {5, 3, 4}, {4, 3, 0}};
  for (const double side : {1.0, -1.0}) {  // 0 is the least vertex, then the greatest
    std::vector<Point> points{{0, 0}, {4, -4}, {8, 0}, {4, 4}, {2, 1}, {3, 0}, {2, -1}};
    for (Point& p : points) p = {side * p.x, side * p.y};
    std::vector<EdgeConflict> conflicts;
    const TriMesh mesh = linkTriangles({points.begin(), points.end()}, corners, conflicts);
    ASSERT_TRUE(conflicts.empty());
    const auto boundaries = findBoundaries(mesh);
    ASSERT_EQ(rolesOf(boundaries), (Roles{BoundaryRole::Land}));
    EXPECT_EQ(std::ranges::count(boundaries[0].nodes, 0u), 2);
    EXPECT_EQ(boundaries[0].nodes.size(), 8u);
  }
}

// A domain with these points, all of them input except the last `steiner`.
struct Lake {
  Coastline coastline;
  Domain domain;
  TriMesh mesh;

  Lake(const std::vector<Point>& lonlat, const std::vector<std::array<VertexId, 3>>& corners, VertexId steiner) {
    coastline.crs = wgs84();
    Feature& feature = coastline.features.emplace_back();
    feature.fid = 12;
    feature.source = "lake.gpkg|lakes";
    feature.attributes = {{"gnis_name", "Lake"}};
    feature.polygons.push_back({lonlat, {}});
    domain.projection = Projection::fitted(coastline, {0});
    std::vector<Point> plane;
    for (const Point& p : lonlat) plane.push_back(domain.projection.forward(p));
    const std::size_t input = lonlat.size() - steiner;
    domain.input_points.assign(lonlat.begin(), lonlat.begin() + input);
    domain.pslg.points.assign(plane.begin(), plane.begin() + input);
    std::vector<EdgeConflict> conflicts;
    mesh = linkTriangles({plane.begin(), plane.end()}, corners, conflicts);
    mesh.input_vertices = static_cast<VertexId>(input);
  }
};

const std::vector<std::array<VertexId, 3>> kFan{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};

TEST(MakeGrid, InputVerticesKeepTheirBits) {
  const std::vector<Point> lonlat{
      {-87.1234567890123, 43.0}, {-86.9, 43.0000000000001}, {-86.9, 43.2}, {-87.1, 0.1 + 43.1}, {-87.0, 43.1}};
  const Lake lake(lonlat, kFan, 1);
  const Grid grid = makeGrid({{&lake.domain, &lake.mesh}}, lake.coastline);
  ASSERT_EQ(grid.nodes.size(), 5u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(grid.nodes[i], lonlat[i]);
  EXPECT_NEAR(grid.nodes[4].x, lonlat[4].x, 1e-12);
  EXPECT_NEAR(grid.nodes[4].y, lonlat[4].y, 1e-12);
  EXPECT_EQ(grid.triangles, kFan);
  EXPECT_EQ(grid.feature_of, (std::vector<std::uint32_t>{0, 0, 0, 0}));
  ASSERT_EQ(grid.features.size(), 1u);
  EXPECT_EQ(grid.features[0].fid, 12);
  EXPECT_EQ(grid.crs.authority, "EPSG:4326");
  for (std::size_t t = 0; t < kFan.size(); ++t) {
    const auto& [a, b, c] = lake.mesh.triangles[t].v;
    const auto angles = anglesDeg(lake.mesh.points[a], lake.mesh.points[b], lake.mesh.points[c]);
    EXPECT_EQ(grid.min_angle_deg[t], std::ranges::min(angles));
  }
}

// A frame across an island makes two boundaries of its shore, an opening and land.
TEST(MakeGrid, OnlyAWholeLoopIsAnIsland) {
  TriMesh mesh = lattice(3, 3, [](int i, int j) { return i != 1 || j != 1; });
  mesh.input_vertices = static_cast<VertexId>(mesh.points.size());
  Domain domain;
  domain.input_points.assign(mesh.points.begin(), mesh.points.end());
  domain.pslg.points = domain.input_points;
  const auto isSouthOfIsland = [](const Point& a, const Point& b) {
    return a.y == b.y && a.y == 1.0 && std::min(a.x, b.x) == 1.0 && std::max(a.x, b.x) == 2.0;
  };
  for (Triangle& triangle : mesh.triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      const VertexId a = triangle.v[next3(i)], b = triangle.v[prev3(i)];
      if (triangle.adj[i] != kNone || !isSouthOfIsland(mesh.points[a], mesh.points[b])) continue;
      triangle.seg[i] = static_cast<SegmentId>(domain.pslg.segments.size());
      domain.pslg.segments.push_back({a, b, kOpenTag});
    }
  }
  ASSERT_EQ(domain.pslg.segments.size(), 1u);
  const Grid grid = makeGrid({{&domain, &mesh}}, {});
  Roles roles = rolesOf(grid.boundaries);
  std::ranges::sort(roles);
  EXPECT_EQ(roles, (Roles{BoundaryRole::Land, BoundaryRole::Land, BoundaryRole::Open}));
}

TEST(MakeGrid, AreasAddUpToThePolygon) {
  for (const double size : {0.01, 0.3, 4.0}) {
    const std::vector<Point> lonlat{{-87.0, 43.0},
                                    {-87.0 + size, 43.0},
                                    {-87.0 + size, 43.0 + size},
                                    {-87.0, 43.0 + size},
                                    {-87.0 + size / 3, 43.0 + size / 2}};
    const Lake lake(lonlat, kFan, 1);
    const Grid grid = makeGrid({{&lake.domain, &lake.mesh}}, lake.coastline);
    Coastline outline = lake.coastline;
    outline.features[0].polygons[0].outer.pop_back();
    const double whole = geodesicArea(outline, {0});
    EXPECT_NEAR(std::accumulate(grid.area_m2.begin(), grid.area_m2.end(), 0.0), whole, 1e-7 * whole) << size;
  }
}

// A lake across the antimeridian, with longitudes past 180 or not: Steiner points follow the input.
TEST(MakeGrid, LongitudesStayNearThoseOfTheInput) {
  const std::vector<Point> past{{179.0, -17.0}, {181.0, -17.0}, {181.0, -16.0}, {179.0, -16.0}, {180.5, -16.5}};
  const Lake lake(past, kFan, 1);
  const Grid grid = makeGrid({{&lake.domain, &lake.mesh}}, lake.coastline);
  EXPECT_NEAR(grid.nodes[4].x, 180.5, 1e-9);

  std::vector<Point> negative = past;
  for (Point& p : negative) p.x -= 360.0;
  const Lake west(negative, kFan, 1);
  EXPECT_NEAR(makeGrid({{&west.domain, &west.mesh}}, west.coastline).nodes[4].x, -179.5, 1e-9);

  const std::vector<Point> wrapped{{179.0, -17.0}, {-179.0, -17.0}, {-179.0, -16.0}, {179.0, -16.0}, {-179.5, -16.5}};
  Lake pieces(past, kFan, 1);
  pieces.domain.input_points.assign(wrapped.begin(), wrapped.begin() + 4);
  EXPECT_NEAR(makeGrid({{&pieces.domain, &pieces.mesh}}, pieces.coastline).nodes[4].x, -179.5, 1e-9);
}

TEST(MakeGrid, PartsAreConcatenatedAndUnusedPointsDropped) {
  Coastline coastline;  // a plane
  coastline.features.resize(4);
  for (std::size_t f = 0; f < 4; ++f) coastline.features[f].fid = 100 + static_cast<std::int64_t>(f);
  std::vector<Domain> domains(2);
  std::vector<TriMesh> meshes;
  // The second part touches the first in a corner, which stays duplicated; both lattices have unused points.
  meshes.push_back(lattice(2, 2, [](int i, int j) { return i == 0 && j == 0; }));
  meshes.push_back(lattice(2, 2, [](int i, int j) { return i == 1 && j == 1; }));
  for (std::size_t p = 0; p < 2; ++p) {
    meshes[p].input_vertices = static_cast<VertexId>(meshes[p].points.size());
    meshes[p].regions.assign(2, p == 0 ? 3 : 1);
    domains[p].input_points.assign(meshes[p].points.begin(), meshes[p].points.end());
    domains[p].pslg.points = domains[p].input_points;
  }
  const Grid grid = makeGrid({{&domains[0], &meshes[0]}, {&domains[1], &meshes[1]}}, coastline);
  EXPECT_EQ(grid.nodes, (std::vector<Point>{{0, 0}, {1, 0}, {0, 1}, {1, 1}, {1, 1}, {2, 1}, {1, 2}, {2, 2}}));
  EXPECT_EQ(grid.triangles, (decltype(grid.triangles){{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}}));
  ASSERT_EQ(grid.features.size(), 2u);
  EXPECT_EQ(grid.features[0].fid, 101);
  EXPECT_EQ(grid.features[1].fid, 103);
  EXPECT_EQ(grid.feature_of, (std::vector<std::uint32_t>{1, 1, 0, 0}));
  EXPECT_EQ(grid.area_m2, (std::vector<double>{0.5, 0.5, 0.5, 0.5}));
  ASSERT_EQ(grid.boundaries.size(), 2u);
  EXPECT_THAT(grid.boundaries[0].nodes, ElementsAre(0, 1, 3, 2));
  EXPECT_THAT(grid.boundaries[1].nodes, ElementsAre(4, 5, 7, 6));
}

// Squares of a quarter of a degree from `west` eastwards, with longitudes in the 360 degrees from `least` on.
Grid across(
    double west, double least, const std::function<bool(int, int)>& wanted = [](int, int) { return true; }) {
  const TriMesh mesh = lattice(22, 4, wanted, [&](int i, int j) {
    const double lon = west + 0.25 * i + 0.015625 * j;
    return Point{lon - 360.0 * std::floor((lon - least) / 360.0), -19.0 + 0.25 * j};
  });
  Grid grid;
  grid.crs = wgs84();
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  return grid;
}

// The largest difference in longitude within a triangle.
double widestIn(std::span<const Point> nodes, const Grid& grid) {
  double widest = 0.0;
  for (const auto& [a, b, c] : grid.triangles) {
    const auto [west, east] = std::minmax({nodes[a].x, nodes[b].x, nodes[c].x});
    widest = std::max(widest, east - west);
  }
  return widest;
}

// Longitudes increase eastwards from the western edge, which stays in place, in data from -180, from 0 and others.
TEST(InOneTurn, GoesOnFromTheWesternEdge) {
  const auto inTwo = [](int i, int) { return i < 18 || i > 19; };  // the second part is entirely east of the jump
  for (const auto& [west, least] : {std::pair{176.0, -180.0}, {356.0, 0.0}, {-190.0, -187.0}, {-2.0, -0.125}}) {
    for (const bool apart : {false, true}) {
      SCOPED_TRACE(west);
      const Grid grid = apart ? across(west, least, inTwo) : across(west, least);
      ASSERT_GT(widestIn(grid.nodes, grid), 300.0);
      const auto turned = inOneTurn(grid.nodes, grid.triangles);
      ASSERT_TRUE(turned);
      ASSERT_EQ(turned->size(), grid.nodes.size());
      const double start = grid.nodes[0].x;
      EXPECT_LT(widestIn(*turned, grid), 0.5);
      for (std::size_t i = 0; i < turned->size(); ++i) {
        const Point &is = (*turned)[i], &was = grid.nodes[i];
        EXPECT_GE(is.x, start);
        EXPECT_LE(is.x, start + 5.6);
        EXPECT_EQ(is.y, was.y);
        EXPECT_EQ(std::remainder(is.x - was.x, 360.0), 0.0);
        EXPECT_TRUE(was.x < start || is == was);
      }
    }
  }
}

TEST(InOneTurn, LeavesWhatNeedNotOrCannotChange) {
  EXPECT_FALSE(inOneTurn({}, {}));
  for (const double west : {-179.0, 5.0, 178.0}) {  // the last continues past 180 already
    const Grid grid = across(west, west - 1.0);
    EXPECT_FALSE(inOneTurn(grid.nodes, grid.triangles));
  }
  // Around a pole: a ring, the pole as a node, and a triangle that contains the pole.
  std::vector<Point> ring;
  for (int k = 0; k < 12; ++k) ring.push_back({-180.0 + 30.0 * k, 70.0});
  std::vector<std::array<std::uint32_t, 3>> belt, fan;
  std::vector<Point> nodes = ring;
  for (const Point& p : ring) nodes.push_back({p.x, 75.0});
  for (std::uint32_t k = 0; k < 12; ++k) {
    const std::uint32_t next = (k + 1) % 12;
    belt.push_back({k, next, 12 + k});
    belt.push_back({next, 12 + next, 12 + k});
    fan.push_back({k, next, 12});
  }
  EXPECT_FALSE(inOneTurn(nodes, belt));
  belt.erase(belt.begin() + 8, belt.begin() + 10);
  const auto turned = inOneTurn(nodes, belt);  // with a gap, it is a regional mesh from -30 on
  ASSERT_TRUE(turned);
  for (const Point& p : *turned) EXPECT_GE(p.x, -30.0);
  ring.push_back({0.0, 90.0});
  EXPECT_FALSE(inOneTurn(ring, fan));
  const std::vector<Point> cap{{-120.0, 80.0}, {0.0, 80.0}, {120.0, 80.0}};
  EXPECT_FALSE(inOneTurn(cap, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}));
}

// A mesh so wide that its eastern end would be beyond the longitudes that readers expect begins one turn earlier.
TEST(InOneTurn, StaysWhereLongitudesAreExpected) {
  std::vector<Point> nodes;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t k = 0; k < 30; ++k) {
    for (const double lat : {0.0, 5.0}) nodes.push_back({std::fmod(350.0 + 10.0 * k, 360.0), lat});
    if (k == 0) continue;
    triangles.push_back({2 * k - 2, 2 * k, 2 * k + 1});
    triangles.push_back({2 * k - 2, 2 * k + 1, 2 * k - 1});
  }
  const auto turned = inOneTurn(nodes, triangles);
  ASSERT_TRUE(turned);
  EXPECT_EQ(turned->front().x, -10.0);
  EXPECT_EQ(turned->back().x, 280.0);
}

// Longitudes with more digits than they can have past 180.
TEST(TurnedNodes, ComeBackBitForBit) {
  Grid grid = across(60.0, 0.0);
  for (Point& p : grid.nodes) p.x = std::remainder(60.0 + 40.1 * (p.x - 60.0), 360.0);
  const BulkList<Point> before = grid.nodes;
  ASSERT_GT(widestIn(before, grid), 180.0);
  const TurnedNodes turned(grid);
  ASSERT_TRUE(turned.any());
  EXPECT_LT(widestIn(grid.nodes, grid), 20.0);
  EXPECT_EQ(turned.putBack({184.0, 1.0}), (Point{-176.0, 1.0}));  // a new node
  turned.putBack(grid);
  EXPECT_EQ(grid.nodes, before);
}

TEST(ToTriMesh, LinksTheTrianglesInThePlane) {
  const Grid grid = testing::sampleGrid(wgs84(), {-87.5, 43.1}, 0.01);
  const Projection utm = Projection::to(wgs84(), parseCrs("EPSG:32616"));
  std::vector<EdgeConflict> conflicts;
  const TriMesh mesh = toTriMesh(grid, utm, conflicts);
  EXPECT_TRUE(conflicts.empty());
  ASSERT_EQ(mesh.triangles.size(), grid.triangles.size());
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) EXPECT_EQ(mesh.points[i], utm.forward(grid.nodes[i]));
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    EXPECT_EQ(mesh.triangles[t].v, grid.triangles[t]);
    EXPECT_EQ(mesh.regions[t], static_cast<RegionId>(grid.feature_of[t]));
  }
  EXPECT_EQ(boundaryLoops(mesh).size(), 3u);
}

}  // namespace
}  // namespace coastmesh
