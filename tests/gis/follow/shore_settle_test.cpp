#include "gis/follow/shore_settle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <utility>

#include "core/links.hpp"
#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

struct Ones final : SizeFunction {
  double at(const Point&) const override { return 1.0; }
  double least() const override { return 1.0; }
  double most() const override { return 1.0; }
};

// Irregular, so that no four corners of the sea and of the frame around it are cocircular.
const std::array<Point, 4> kCorners = {Point{0.0, 0.0}, Point{10.0, 0.3}, Point{9.7, 10.2}, Point{-0.2, 9.9}};

// A sea with vertices of the domain in it.
ShoreGraph sea(std::mt19937& random, std::size_t places) {
  ShoreGraph graph;
  graph.pslg.points.assign(kCorners.begin(), kCorners.end());
  for (VertexId i = 0; i < 4; ++i) graph.pslg.segments.push_back({i, (i + 1) % 4, 0, 0, kOutside});
  std::uniform_real_distribution<double> within(0.4, 9.6);
  while (graph.pslg.points.size() < places + 4) graph.pslg.points.push_back({within(random), within(random)});
  for (VertexId v = 0; v < graph.pslg.points.size(); ++v) graph.source.push_back(v);
  return graph;
}

// Changes patches that are connected in some places and pinched in others.
void changeSome(ShoreTriangles& t, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const double drawn = share(random);
  for (TriId i = 0; i < t.mesh.triangles.size(); ++i) {
    const auto& v = t.mesh.triangles[i].v;
    const Point x = centroid(t.mesh.point(v[0]), t.mesh.point(v[1]), t.mesh.point(v[2]));
    bool is_inside = std::ranges::all_of(v, [](VertexId w) { return w >= 4; });  // the sea keeps its extent
    for (std::size_t k = 0; k < 4; ++k) is_inside = is_inside && orient2d(kCorners[k], kCorners[(k + 1) % 4], x) > 0;
    if (is_inside && share(random) < 0.3 && std::sin(3.0 * x.x + 6.0 * drawn) * std::sin(2.0 * x.y) > 0.2)
      t.mesh.regions[i] = share(random) < 0.6 ? t.land : 0;
  }
}

using Edge = std::array<double, 4>;

Edge edgeOf(const TriMesh& mesh, EdgeRef e) {
  Point a = mesh.point(mesh.origin(e)), b = mesh.point(mesh.target(e));
  if (lexLess(b, a)) std::swap(a, b);
  return {a.x, a.y, b.x, b.y};
}

std::set<Edge> edgesOf(const ShoreTriangles& t, bool segments) {
  std::set<Edge> edges;
  for (TriId i = 0; i < t.mesh.triangles.size(); ++i)
    for (unsigned k = 0; k < 3; ++k)
      if (!segments || t.mesh.triangles[i].seg[k] != kNone) edges.insert(edgeOf(t.mesh, edgeRef(i, k)));
  return edges;
}

// Expects the same as triangulating from scratch.
void expectSettled(const ShoreTriangles& t) {
  ASSERT_EQ(findBrokenLink(t.mesh.triangles), kNone);
  ASSERT_EQ(t.mesh.regions, t.region_was);
  double area = 0.0;
  for (TriId i = 0; i < t.mesh.triangles.size(); ++i) {
    const auto& v = t.mesh.triangles[i].v;
    ASSERT_GT(orient2d(t.mesh.point(v[0]), t.mesh.point(v[1]), t.mesh.point(v[2])), 0);
    area += 0.5 * cross(t.mesh.point(v[1]) - t.mesh.point(v[0]), t.mesh.point(v[2]) - t.mesh.point(v[0]));
    for (unsigned k = 0; k < 3; ++k) {
      const EdgeRef e = edgeRef(i, k), back = t.mesh.twin(e);
      ASSERT_NE(t.home[v[k]], kNone);
      if (back == kNone) continue;
      ASSERT_EQ(t.mesh.segment(e) != kNone, t.mesh.regions[i] != t.mesh.regions[triOf(back)]);
      if (t.mesh.segment(e) != kNone) continue;
      const Point& beyond = t.mesh.point(t.mesh.apex(back));
      EXPECT_LE(inCircle(t.mesh.point(v[0]), t.mesh.point(v[1]), t.mesh.point(v[2]), beyond), 0);
    }
  }
  EXPECT_NEAR(area, (3.0 * 10.2) * (3.0 * 10.2), 1e-9);  // the frame is three times as wide and as high as the sea
  for (VertexId v = 0; v < t.mesh.points.size(); ++v) {
    if (t.home[v] == kNone || (t.use[v] & kAround) != 0) continue;
    int changes = 0;
    RegionId last = kUnlabelled;
    bool is_corner = false;
    forTrianglesRound(t, v, [&](TriId i) {
      is_corner = is_corner || t.mesh.triangles[i].v[t.mesh.cornerOf(i, v)] == v;
      if (last != kUnlabelled && last != t.mesh.regions[i]) ++changes;
      last = t.mesh.regions[i];
    });
    EXPECT_TRUE(is_corner);
    EXPECT_LE(changes, 2);
    EXPECT_EQ(t.use[v], useOf(t, v));
    EXPECT_TRUE((t.use[v] & kLoose) == 0 || (t.source[v] != kNone && t.mesh.regions[t.home[v]] != t.land));
  }
  const ShoreTriangles anew = triangulateShores(graphOf(t), Ones());
  EXPECT_EQ(edgesOf(anew, false), edgesOf(t, false));
  EXPECT_EQ(edgesOf(anew, true), edgesOf(t, true));
  double widths = 0.0, widths_anew = 0.0;
  for (const double width : t.width) widths += std::min(width, 100.0);
  for (const double width : anew.width) widths_anew += std::min(width, 100.0);
  EXPECT_NEAR(widths, widths_anew, 1e-6 * widths);
}

TEST(ShoreSettle, IsWhatTriangulatingAnewMakes) {
  std::mt19937 random(7);
  for (int run = 0; run < 40; ++run) {
    SCOPED_TRACE(run);
    ShoreTriangles t = triangulateShores(sea(random, 10 + 8 * static_cast<std::size_t>(run)), Ones());
    for (int round = 0; round < 5; ++round) {
      changeSome(t, random);
      settleShores(t, Ones());
      ASSERT_NO_FATAL_FAILURE(expectSettled(t));
    }
  }
}

TEST(ShoreSettle, DoesNotDependOnThreads) {
  const auto settled = [](const ItemLoop& loop) {
    std::mt19937 random(11);
    ShoreTriangles t = triangulateShores(sea(random, 9000), Ones());  // enough for several stretches
    for (int round = 0; round < 2; ++round) {
      changeSome(t, random);
      settleShores(t, Ones(), loop);
    }
    return t;
  };
  const ShoreTriangles one = settled(inOrder), other = settled(testing::backwards);
  EXPECT_GT(one.mesh.triangles.size(), 2u * 8192);
  EXPECT_EQ(one.mesh.points, other.mesh.points);
  EXPECT_EQ(one.mesh.regions, other.mesh.regions);
  EXPECT_EQ(one.use, other.use);
  EXPECT_EQ(edgesOf(one, false), edgesOf(other, false));
}

// Nearly every vertex of such shores is where water touches itself, among thin triangles: a vertex that is put beside
// one may lie across the way of the next.
TEST(ShoreSettle, VerticesBesideOthersFindRoom) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int run = 0; run < 300; ++run) {
    SCOPED_TRACE(run);
    ShoreGraph graph = sea(random, 40);
    for (std::size_t v = 4; v < graph.pslg.points.size(); ++v)
      graph.pslg.points[v].y = 5.0 + 0.02 * graph.pslg.points[v].y;
    ShoreTriangles t = triangulateShores(std::move(graph), Ones());
    for (TriId i = 0; i < t.mesh.triangles.size(); ++i)
      if (std::ranges::all_of(t.mesh.triangles[i].v, [](VertexId v) { return v >= 4 && v < 44; }))
        t.mesh.regions[i] = share(random) < 0.5 ? t.land : 0;
    settleShores(t, Ones());
    ASSERT_EQ(findBrokenLink(t.mesh.triangles), kNone);
    for (const Triangle& triangle : t.mesh.triangles)
      ASSERT_GT(orient2d(t.mesh.point(triangle.v[0]), t.mesh.point(triangle.v[1]), t.mesh.point(triangle.v[2])), 0);
  }
}

TEST(ShoreSettle, HelpersStayOnShoresAlone) {
  std::mt19937 random(11);
  for (int run = 0; run < 20; ++run) {
    SCOPED_TRACE(run);
    ShoreTriangles t = triangulateShores(sea(random, 100), Ones());
    std::uniform_real_distribution<double> within(-5.0, 15.0);
    std::vector<Point> helpers{midpoint(kCorners[0], kCorners[3]),
                               t.mesh.point(7)};  // on the shore, and at a vertex: both are skipped
    const std::size_t before = t.mesh.points.size();
    for (int i = 0; i < 200; ++i) helpers.push_back({within(random), within(random)});
    helpers.push_back(midpoint(t.mesh.point(7), t.mesh.point(t.mesh.triangles[t.home[7]].v[0])));
    insertPoints(t, helpers, Ones());
    EXPECT_GE(t.mesh.points.size(), before + 200);
    EXPECT_LE(t.mesh.points.size(), before + 201);
    changeSome(t, random);
    settleShores(t, Ones());
    expectSettled(t);
  }
}

TEST(ShoreSettle, NothingChangesWhereNothingHasChanged) {
  std::mt19937 random(3);
  ShoreTriangles t = triangulateShores(sea(random, 60), Ones());
  changeSome(t, random);
  settleShores(t, Ones());
  const TriMesh before = t.mesh;
  settleShores(t, Ones());
  EXPECT_EQ(digestOf(t.mesh), digestOf(before));
}

}  // namespace
}  // namespace coastmesh
