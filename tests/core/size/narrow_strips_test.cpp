// The expected number of vertices in narrow strips, compared with that of a mesh.
#include "core/size/narrow_strips.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "core/refine/refine.hpp"
#include "core/triangulate/delaunay.hpp"

namespace coastmesh {
namespace {

Pslg ringOf(std::vector<Point> points) {
  Pslg pslg;
  pslg.points = std::move(points);
  const auto count = static_cast<VertexId>(pslg.points.size());
  for (VertexId v = 0; v < count; ++v) pslg.segments.push_back({v, (v + 1) % count});
  return pslg;
}

// The strip from 0 to `length`, `width` wide, with its shores in as many pieces.
Pslg strip(double length, double width, int below, int above) {
  std::vector<Point> points;
  for (int i = 0; i <= below; ++i) points.push_back({length * i / below, 0.0});
  for (int i = above; i >= 0; --i) points.push_back({length * i / above, width});
  return ringOf(std::move(points));
}

NarrowStrips stripsOf(const Pslg& pslg, double worth) { return narrowStrips(constrainedDelaunay(pslg), worth); }

double verticesOf(const Pslg& pslg) {
  TriMesh mesh = constrainedDelaunay(pslg);
  refine(mesh, pslg, {});
  coarsen(mesh, pslg, {});
  return static_cast<double>(mesh.points.size());
}

TEST(NarrowStrips, TakeAsManyVerticesAsExpected) {
  constexpr double kLength = 3000.0, kWidth = 1.5, kWorth = 500.0;
  for (const Pslg& pslg : {strip(kLength, kWidth, 1, 1), strip(kLength, kWidth, 1, 200), strip(kLength, kWidth, 60, 1),
                           strip(kLength, kWidth, 100, 91)}) {
    const NarrowStrips strips = stripsOf(pslg, kWorth);
    const double made = verticesOf(pslg);
    EXPECT_GT(strips.vertices, 0.5 * made) << pslg.points.size();
    EXPECT_LT(strips.vertices, 2.0 * made) << pslg.points.size();
    EXPECT_NEAR(strips.length, kLength, 0.3 * kLength) << pslg.points.size();
    EXPECT_NEAR(strips.width, kWidth, 1e-9) << pslg.points.size();
    EXPECT_GE(strips.place.y, 0.0);
    EXPECT_LE(strips.place.y, kWidth);
  }
}

// A funnel: the least width counts most.
TEST(NarrowStrips, HaveThePlaceWhereTheyAreNarrowest) {
  const Pslg pslg = ringOf({{0, 0}, {3000, 0}, {3000, 100}, {1000, 1}, {0, 100}});
  const NarrowStrips strips = stripsOf(pslg, 20.0);
  const double made = verticesOf(pslg);
  EXPECT_GT(strips.vertices, 0.3 * made);
  EXPECT_LT(strips.vertices, 3.0 * made);
  EXPECT_NEAR(strips.place.x, 1000.0, 1.0);
  EXPECT_NEAR(strips.width, 1.0, 0.01);
}

// Triangles grow with the distance from a vertex beside a long side.
TEST(NarrowStrips, AVertexBesideALongSideIsNone) {
  const Pslg pslg = ringOf({{0, 0}, {1e5, 0}, {1e5, 5e4}, {5e4 + 1, 5e4}, {5e4, 0.1}, {5e4 - 1, 5e4}, {0, 5e4}});
  EXPECT_EQ(stripsOf(pslg, 5000.0).vertices, 0.0);
  EXPECT_LT(verticesOf(pslg), 5000.0);
}

// Refinement does not divide what is too sharp for the bounds in any case.
TEST(NarrowStrips, ASharpCornerIsNone) {
  const Pslg pslg = ringOf({{0, 0}, {3000, 0}, {6000, 1}, {3000, 1}});
  EXPECT_EQ(stripsOf(pslg, 100.0).vertices, 0.0);
  EXPECT_LT(verticesOf(pslg), 100.0);
}

TEST(NarrowStrips, AreNothingIfTheyAreNotWorthIt) {
  EXPECT_EQ(stripsOf(strip(3000.0, 1.5, 1, 1), 1e5).vertices, 0.0);
  EXPECT_EQ(stripsOf(strip(3000.0, 1.5, 2000, 2000), 500.0).vertices, 0.0);  // shores as fine as that already
  EXPECT_EQ(stripsOf(ringOf({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), 0.0).vertices, 0.0);
}

}  // namespace
}  // namespace coastmesh
