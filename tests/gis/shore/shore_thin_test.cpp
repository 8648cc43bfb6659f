#include "gis/shore/shore_thin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/metric.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/shore/shore_graph.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

constexpr double kSize = 1.0;

void addShore(Pslg& pslg, const std::vector<Point>& ring) {
  const auto first = static_cast<VertexId>(pslg.points.size()), count = static_cast<VertexId>(ring.size());
  for (VertexId i = 0; i < count; ++i) {
    pslg.points.push_back(ring[i]);
    pslg.segments.push_back({first + i, first + (i + 1) % count, 0, 0, kOutside});
  }
}

// Adds the way from a to b, without b, in `steps` steps, each displaced sideways by up to `off`.
void addWay(std::vector<Point>& ring, const Point& a, const Point& b, int steps, double off, std::mt19937& random) {
  std::uniform_real_distribution<double> by(-off, off);
  const Point across = 1.0 / distance(a, b) * Point{a.y - b.y, b.x - a.x};
  for (int i = 0; i < steps; ++i)
    ring.push_back(a + (1.0 * i / steps) * (b - a) + (i == 0 ? 0.0 : by(random)) * across);
}

struct Thinned {
  Pslg pslg;
  std::size_t dropped = 0;
  double dropped_area = 0.0;
};

Thinned thin(const Pslg& pslg, bool keeps_narrow_water = false, const ItemLoop& loop = inOrder) {
  ShoreGraph graph{pslg, std::vector<VertexId>(pslg.points.size(), kNone)};
  ShoreChains chains = chainsOf(std::move(graph), ConstantSize(kSize));
  Thinned thinned;
  const auto dropped = [&](VertexId, double area) {
    ++thinned.dropped;
    thinned.dropped_area += area;
  };
  thinShores(
      chains, {{}, keeps_narrow_water, dropped}, [](VertexId) {}, loop);
  thinned.pslg = graphOf(std::move(chains)).pslg;
  return thinned;
}

bool isInWater(const Point& x, const Pslg& pslg) {
  bool inside = false;
  for (const Segment& s : pslg.segments) {
    const Point &a = pslg.points[s.a], &b = pslg.points[s.b];
    if ((a.y > x.y) != (b.y > x.y) && x.x < a.x + (x.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

double toShores(const Point& x, const Pslg& pslg) {
  double least = 1e300;
  for (const Segment& s : pslg.segments)
    least = std::min(least, squaredDistanceToSegment(x, pslg.points[s.a], pslg.points[s.b]));
  return std::sqrt(least);
}

TEST(ThinShores, FineShoresLoseWhatIsNoUse) {
  std::mt19937 random(1);
  std::vector<Point> ring;
  addWay(ring, {0, 0}, {10, 0}, 400, 0.01, random);
  addWay(ring, {10, 0}, {10, 10}, 400, 0.01, random);
  addWay(ring, {10, 10}, {0, 10}, 400, 0.01, random);
  addWay(ring, {0, 10}, {0, 0}, 400, 0.01, random);
  Pslg pslg;
  addShore(pslg, ring);
  const Pslg after = thin(pslg).pslg;
  EXPECT_LT(after.points.size(), 200u);
  for (const Point& p : pslg.points) EXPECT_LE(toShores(p, after), 0.1 * kSize);
  for (const Segment& s : after.segments) EXPECT_LE(distance(after.points[s.a], after.points[s.b]), 0.6 * kSize);
}

TEST(ThinShores, DoesNotDependOnThreads) {
  std::mt19937 random(7);
  std::vector<Point> ring;
  const Point corners[] = {{0.0, 0.0}, {1000.0, 0.0}, {1000.0, 1000.0}, {0.0, 1000.0}};
  for (int side = 0; side < 4; ++side) addWay(ring, corners[side], corners[(side + 1) % 4], 16000, 0.05, random);
  Pslg pslg;
  addShore(pslg, ring);
  const Thinned one = thin(pslg), other = thin(pslg, false, testing::backwards);
  EXPECT_LT(one.pslg.points.size(), ring.size() / 2);
  EXPECT_GT(one.pslg.points.size(), 5000U);  // enough for several stretches
  EXPECT_EQ(one.pslg.points, other.pslg.points);
}

TEST(ThinShores, LinesAcrossThinLandKeepApart) {
  std::mt19937 random(2);
  for (const double width : {0.02, 0.05, 0.2}) {
    // Water on both sides of a wall.
    std::vector<Point> low, high;
    addWay(low, {0, 0}, {8, 0}, 8, 0.0, random);
    low.push_back({8, 0});
    addWay(low, {8, 4}, {0, 4}, 400, 0.3 * width, random);
    low.push_back({0, 4});
    addWay(high, {0, 4 + width}, {8, 4 + width}, 400, 0.3 * width, random);
    high.push_back({8, 4 + width});
    high.push_back({8, 8});
    high.push_back({0, 8});
    Pslg one, other, both;
    addShore(one, low);
    addShore(other, high);
    addShore(both, low);
    addShore(both, high);
    const double before = [&] {
      double least = 1e300;
      for (const Point& p : low) least = std::min(least, toShores(p, other));
      for (const Point& p : high) least = std::min(least, toShores(p, one));
      return least;
    }();
    const Pslg after = thin(both).pslg;
    EXPECT_LT(after.points.size(), both.points.size());
    double least = 1e300;
    for (const Segment& s : after.segments) {
      const bool is_low = after.points[s.a].y < 4 + 0.5 * width;
      for (const Point& p : after.points)
        if ((p.y < 4 + 0.5 * width) != is_low)
          least = std::min(least, std::sqrt(squaredDistanceToSegment(p, after.points[s.a], after.points[s.b])));
    }
    EXPECT_GE(least, 0.6 * before) << width;
  }
}

TEST(ThinShores, SmallIslandsGoUnlessSomethingLiesInThem) {
  const auto island = [](const Point& at, double side) {
    return std::vector<Point>{at, at + Point{0, side}, at + Point{side, side}, at + Point{side, 0}};
  };
  Pslg pslg;
  addShore(pslg, {{0, 0}, {20, 0}, {20, 20}, {0, 20}});
  addShore(pslg, island({5, 5}, 0.5));
  addShore(pslg, island({10, 10}, 3.0));
  EXPECT_EQ(thin(pslg).dropped, 1u);
  EXPECT_NEAR(thin(pslg).dropped_area, 0.25, 1e-12);
  EXPECT_EQ(thin(pslg).pslg.segments.size(), 8u);
  // A pond on the small island.
  addShore(pslg, {{5.1, 5.1}, {5.4, 5.1}, {5.4, 5.4}, {5.1, 5.4}});
  EXPECT_EQ(thin(pslg).dropped, 0u);
  EXPECT_EQ(thin(pslg).pslg.segments.size(), 16u);
}

// Rings with long thin arms that wind around each other.
TEST(ThinShores, NothingCrossesOrChangesSides) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    Pslg pslg;
    addShore(pslg, {{-30, -30}, {30, -30}, {30, 30}, {-30, 30}});
    // Two interleaved spirals of land, clockwise: thin land, or thin water between them.
    const double apart = 0.35 * std::numbers::pi, thin_part = 0.01 + 0.2 * share(random) * share(random);
    const double arm = seed % 2 == 0 ? thin_part : apart - thin_part;
    const double step = 0.02 + 0.2 * share(random), wiggle = share(random);
    for (const double turn : {0.0, std::numbers::pi}) {
      std::vector<Point> out, back;
      for (double angle = 2.0; angle < 16.0; angle += step / angle) {
        const double off = 0.8 * wiggle * thin_part * (share(random) - 0.5), middle = 0.35 * angle + off;
        const Point way{std::cos(angle + turn), std::sin(angle + turn)};
        out.push_back((middle - 0.5 * arm) * way);
        back.push_back((middle + 0.5 * arm) * way);
      }
      std::vector<Point> ring = out;
      ring.insert(ring.end(), back.rbegin(), back.rend());
      addShore(pslg, ring);
    }
    ASSERT_NO_THROW(constrainedDelaunay(pslg)) << seed;
    for (const bool keeps_narrow : {false, true}) {
      const Pslg after = thin(pslg, keeps_narrow).pslg;
      EXPECT_LT(after.points.size(), pslg.points.size()) << seed;
      ASSERT_NO_THROW(constrainedDelaunay(after)) << seed;
      std::uniform_real_distribution<double> place(-7.0, 7.0);
      for (int i = 0; i < 300; ++i) {
        const Point x{place(random), place(random)};
        if (toShores(x, pslg) < 0.101 * kSize) continue;
        EXPECT_EQ(isInWater(x, after), isInWater(x, pslg)) << seed;
      }
    }
  }
}

}  // namespace
}  // namespace coastmesh
