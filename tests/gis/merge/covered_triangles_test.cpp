#include "gis/merge/covered_triangles.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/gis/merge/merged.hpp"

namespace coastmesh {
namespace {

using namespace coastmesh::testing;

std::vector<Cover> coverWithout(const TriMesh& mesh, const Outline& outline) {
  const std::vector<std::uint32_t> none(mesh.points.size(), kNone);
  return coverOf(mesh, none, {}, outline);
}

TEST(CoveredTriangles, AgreesWithManyPlacesInThem) {
  const TriMesh mesh = linkGrid(gridOf({20, 20})).mesh;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int run = 0; run < 20; ++run) {
    const Grid other =
        gridOf({5, 4, 0.4 + share(random), {8.0 + share(random), 9.0 + share(random)}, 6.0 * share(random)},
               BoundaryRole::Open);
    const Outline outline(other, linkGrid(other).mesh);
    const std::vector<Cover> cover = coverWithout(mesh, outline);
    for (TriId t = 0; t < mesh.triangles.size(); ++t) {
      const auto& v = mesh.triangles[t].v;
      int inside = 0;
      constexpr int kPlaces = 40;
      for (int i = 0; i < kPlaces; ++i) {
        double a = share(random), b = share(random);
        if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
        const Point p = mesh.points[v[0]] + a * (mesh.points[v[1]] - mesh.points[v[0]]) +
                        b * (mesh.points[v[2]] - mesh.points[v[0]]);
        if (outline.surrounds(p)) ++inside;
      }
      if (cover[t] == Cover::Free) {
        EXPECT_EQ(inside, 0);
      }
      if (cover[t] == Cover::Inside) {
        EXPECT_EQ(inside, kPlaces);
      }
    }
    // Triangles that are met are close to the outline.
    for (TriId t = 0; t < mesh.triangles.size(); ++t) {
      if (cover[t] != Cover::Met) continue;
      const auto& v = mesh.triangles[t].v;
      const Point middle = centroid(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
      double nearest = 1e9;
      for (const Outline::Edge& e : outline.edges())
        nearest = std::min(nearest, squaredDistanceToSegment(middle, outline.place(e.a), outline.place(e.b)));
      EXPECT_LT(nearest, 1.6);
    }
  }
}

TEST(CoveredTriangles, ThoseThatContinueTheOutlineAreFree) {
  const Grid whole = gridOf({10, 10});
  const TriMesh mesh = linkGrid(whole).mesh;
  const Grid part = gridOf({4, 3, 1.0, {3.0, 4.0}}, BoundaryRole::Open);
  const Outline outline(part, linkGrid(part).mesh);
  std::vector<std::uint32_t> same(mesh.points.size(), kNone);
  for (std::uint32_t v = 0; v < same.size(); ++v)
    for (const Outline::Edge& e : outline.edges())
      if (mesh.points[v] == outline.place(e.a)) same[v] = e.a;
  const std::vector<Cover> cover = coverOf(mesh, same, {}, outline);
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t].v;
    const Point middle = centroid(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
    const bool inside = middle.x > 3.0 && middle.x < 7.0 && middle.y > 4.0 && middle.y < 7.0;
    EXPECT_EQ(cover[t] == Cover::Free, !inside) << middle.x << " " << middle.y;
  }
  // Without common nodes all that touch are met.
  const std::vector<Cover> apart = coverWithout(mesh, outline);
  EXPECT_GT(std::ranges::count(apart, Cover::Met), 24);
}

}  // namespace
}  // namespace coastmesh
