#include "core/refine/ring_look.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/quality.hpp"
#include "core/refine/refine.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

constexpr double kNoSize = std::numeric_limits<double>::infinity();

bool areSame(const PetalBox& a, const PetalBox& b) { return a.low == b.low && a.high == b.high; }

TEST(LookEdges, ALoopAndItsPairsHoldEveryEdge) {
  LookEdges edges;
  for (const std::size_t count : {8u, 3u, 5u, 4u}) {
    const auto corner = [&](std::size_t k) {
      const double turn = 1.0 + static_cast<double>(k);
      return Point{std::cos(turn), std::sin(2.0 * turn) + static_cast<double>(count)};
    };
    edges.takeLoop(count, corner);
    ASSERT_EQ(edges.size(), count);
    LookEdges pushed;
    for (std::size_t k = 0; k < count; ++k) {
      const LookEdge e = edges[k];
      EXPECT_EQ(e.from, corner(k == 0 ? count - 1 : k - 1));
      EXPECT_EQ(e.to, corner(k));
      EXPECT_EQ(e.along, e.to - e.from);
      EXPECT_EQ(e.squared, squaredLength(e.along));
      pushed.push(e);
    }
    for (LookEdges* some : {&edges, &pushed}) {
      const auto pairs = some->pairs();
      ASSERT_EQ(pairs.size(), (count + 1) / 2);
      // An odd one fills its pair.
      EXPECT_EQ(pairs.back().to_y[1], corner(count - 1).y);
      EXPECT_EQ(pairs.back().squared[1], edges[count - 1].squared);
    }
  }
}

TEST(Fan, FitsWhereAllAnglesDo) {
  const AngleBound bound(25.0, 180.0);
  Fan fan;
  LookEdges link;
  int good = 0, bad = 0, delaunay = 0, flat = 0;
  for (unsigned seed = 1; seed <= 2000; ++seed) {
    std::mt19937_64 random(seed);
    const std::size_t count = 4 + seed % 5;
    std::vector<Point> corners;
    for (std::size_t k = 0; k < count; ++k) {
      const double at =
          toRadians(360.0 * (static_cast<double>(k) + uniform(random, 0.0, 0.5)) / static_cast<double>(count));
      corners.push_back(uniform(random, 0.7, 1.2) * Point{std::cos(at), std::sin(at)});
    }
    const Point place{uniform(random, -0.3, 0.3), uniform(random, -0.3, 0.3)};
    link.takeLoop(count, [&](std::size_t k) { return corners[k]; });
    double least = 180.0;
    for (std::size_t k = 0; k < count; ++k) {
      const auto angles = anglesDeg(link[k].from, link[k].to, place);
      least = std::min({least, angles[0], angles[1], angles[2]});
    }
    if (std::abs(least - 25.0) < 1e-3) continue;
    const bool fits = fan.fit(link, place, bound);
    EXPECT_EQ(fits, least > 25.0) << "seed " << seed;
    good += fits;
    bad += !fits;
    if (!fits) continue;
    for (std::size_t k = 0; k < count; ++k) {
      const Fan::Triangle t = fan[k];
      const auto angles = anglesDeg(link[k].from, link[k].to, place);
      EXPECT_NEAR(t.area, 2.0 * signedArea(link[k].from, link[k].to, place), 1e-12);
      EXPECT_NEAR(t.at_x / t.area, 1.0 / std::tan(toRadians(angles[0])), 1e-9);
      EXPECT_NEAR(t.at_y / t.area, 1.0 / std::tan(toRadians(angles[1])), 1e-9);
      EXPECT_NEAR(t.at_place / t.area, 1.0 / std::tan(toRadians(angles[2])), 1e-9);
    }
    // Corner k ends edge k and starts the next one: the angles opposite its spoke are at their other ends.
    double most = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      const LookEdge before = link[k], after = link[(k + 1) % count];
      most = std::max(most, anglesDeg(before.from, before.to, place)[0] + anglesDeg(after.from, after.to, place)[1]);
    }
    if (std::abs(most - 180.0) < 1e-6) continue;
    EXPECT_EQ(fan.spokesAreDelaunay(), most < 180.0) << "seed " << seed;
    (most < 180.0 ? delaunay : flat) += 1;
  }
  EXPECT_GT(delaunay, 50);
  EXPECT_GT(flat, 20);
  EXPECT_GT(good, 100);
  EXPECT_GT(bad, 100);
}

TEST(RingLook, ItsBoxesAreThoseOfThePetals) {
  const Pslg pslg = randomPointsInBox(3, 40);
  TriMesh refined = constrainedDelaunay(pslg);
  refine(refined, pslg, {.min_angle_deg = 30.0});
  const EditMesh mesh(std::move(refined));
  const TriangleBound bound(30.0, 180.0, kNoSize);
  const FeasibleRegion region(bound);
  RingLook look;
  Ring ring;
  int rings = 0;
  for (VertexId v = 0; v < mesh.vertexSlots(); ++v) {
    if (mesh.kind(v) != VertexKind::Free) continue;
    ASSERT_TRUE(mesh.ring(v, 100, ring));
    ++rings;
    look.forget();
    const Frame frame(bound.surface, mesh.point(v));
    const LookEdges& edges = look.edges(mesh, frame, ring);
    const std::size_t count = ring.corners.size();
    ASSERT_EQ(edges.size(), count);
    std::vector<PetalBox> petals;
    PetalBox all;
    for (std::size_t k = 0; k < count; ++k) {
      LookEdge edge;
      petals.push_back(
          region.ready(mesh.point(ring.corners[(k + count - 1) % count]), mesh.point(ring.corners[k]), edge));
      all.cut(petals.back());
      EXPECT_EQ(edges[k].to, edge.to);
    }
    EXPECT_TRUE(areSame(look.box(region), all));
    look.prepareBoxes(region);
    EXPECT_TRUE(areSame(look.box(region), all));
    for (std::size_t k = 0; k < count; ++k) {
      PetalBox others;
      std::size_t visited = 0;
      for (std::size_t i = 0; i < count; ++i)
        if (i != k && i != (k + 1) % count) others.cut(petals[i]);
      EXPECT_TRUE(areSame(look.boxWithout(k), others)) << "vertex " << v << ", corner " << k;
      EXPECT_TRUE(look.visitWithout(k, [&](const LookEdge& e) {
        ++visited;
        return e.from != mesh.point(ring.corners[k]) && e.to != mesh.point(ring.corners[k]);
      }));
      EXPECT_EQ(visited, count - 2);
    }
  }
  EXPECT_GT(rings, 10);
}

}  // namespace
}  // namespace coastmesh
