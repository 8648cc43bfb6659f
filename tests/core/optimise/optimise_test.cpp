#include "core/optimise/optimise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/optimise/exchange_diagonal.hpp"
#include "core/quality.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/excused_twin.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/mesh_figures.hpp"
#include "tests/support/pslgs.hpp"
#include "tests/support/size_cases.hpp"

namespace coastmesh {
namespace {

TriMesh refined(const Pslg& pslg, const RefineOptions& options) {
  TriMesh mesh = constrainedDelaunay(pslg);
  refine(mesh, pslg, options);
  coarsen(mesh, pslg, options);
  return mesh;
}

struct Shapes {
  double mean = 0.0;          // of 4√3 area / Σ edge²
  double least_angle = 60.0;  // degrees, first percentile of the triangles' smallest angles
  double six = 0.0;           // share of the inner vertices with valence 6
  double odd = 0.0;           // share of the inner vertices with valence below 5 or above 7
};

Shapes shapesOf(const TriMesh& mesh) {
  std::vector<double> least;
  std::vector<int> triangles(mesh.points.size(), 0);
  std::vector<bool> inside(mesh.points.size(), true);
  Shapes shapes;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t].v;
    const Point &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]];
    const auto angles = anglesDeg(a, b, c);
    least.push_back(*std::ranges::min_element(angles));
    const double area = 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    const auto square = [](const Point& p, const Point& q) { return std::pow(q.x - p.x, 2) + std::pow(q.y - p.y, 2); };
    shapes.mean += 4.0 * std::sqrt(3.0) * area / (square(a, b) + square(b, c) + square(c, a));
    for (unsigned i = 0; i < 3; ++i) {
      ++triangles[v[i]];
      if (mesh.segment(edgeRef(t, i)) == kNone) continue;
      inside[mesh.origin(edgeRef(t, i))] = inside[mesh.target(edgeRef(t, i))] = false;
    }
  }
  shapes.mean /= static_cast<double>(mesh.triangles.size());
  std::ranges::sort(least);
  shapes.least_angle = least[least.size() / 100];
  double count = 0.0;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (!inside[v]) continue;
    ++count;
    shapes.six += triangles[v] == 6;
    shapes.odd += triangles[v] < 5 || triangles[v] > 7;
  }
  shapes.six /= count;
  shapes.odd /= count;
  return shapes;
}

TEST(Optimise, EdgesComeOutAsWanted) {
  for (const Wanted& wanted : smoothSizes()) {
    for (const double angle : {25.0, 33.0, 38.0}) {
      for (const int sweeps : {kOptimiseSweeps, kMostOptimiseSweeps}) {
        SCOPED_TRACE(wanted.name + " " + std::to_string(angle) + " " + std::to_string(sweeps));
        const Pslg pslg = wideLake();
        const RefineOptions options{.min_angle_deg = angle, .size = &wanted.size};
        TriMesh mesh = refined(pslg, options);
        const RefineStats stats = optimise(mesh, pslg, options, sweeps);
        EXPECT_TRUE(stats.unresolved.empty());
        EXPECT_EQ(wrongBoundViolations(mesh, pslg, options, stats.unresolved), "");
        expectValidMesh(mesh, pslg, {.min_angle_deg = angle});
        const SizeFigures figures = sizeFigures(mesh, wanted.size);
        EXPECT_GE(figures.share_within, 0.98);
        EXPECT_NEAR(figures.median, 1.0, 0.03);
        EXPECT_LE(figures.vertices_share, 1.15);
      }
    }
  }
}

TEST(Optimise, TrianglesComeOutNearlyEquilateral) {
  for (const Wanted& wanted : smoothSizes()) {
    SCOPED_TRACE(wanted.name);
    const Pslg pslg = wideLake();
    const RefineOptions options{.size = &wanted.size};
    TriMesh mesh = refined(pslg, options);
    const Shapes before = shapesOf(mesh);
    optimise(mesh, pslg, options, kOptimiseSweeps);
    const Shapes after = shapesOf(mesh);
    EXPECT_GT(after.mean, before.mean);
    EXPECT_GE(after.mean, 0.975);
    EXPECT_GE(after.least_angle, 40.0);
    EXPECT_GT(after.six, before.six);
    EXPECT_GE(after.six, 0.75);
    EXPECT_LE(after.odd, 0.002);
  }
}

TEST(Optimise, HoldsEveryBound) {
  const SizeOf size(0.01, 0.1, [](const Point& p) { return 0.02 + 0.05 * std::hypot(p.x - 1.0, p.y - 1.0); });
  for (const double largest : {100.0, 120.0}) {
    SCOPED_TRACE(largest);
    const Pslg pslg = wideLake();
    const RefineOptions options{.min_angle_deg = 30.0, .max_angle_deg = largest, .size_max = 0.07, .size = &size};
    TriMesh mesh = refined(pslg, options);
    const std::size_t vertices = mesh.points.size();
    const RefineStats stats = optimise(mesh, pslg, options, kMostOptimiseSweeps);
    EXPECT_GT(stats.relocations, 0u);
    EXPECT_TRUE(stats.unresolved.empty());
    EXPECT_LE(mesh.points.size(), vertices);
    expectValidMesh(mesh, pslg, {.min_angle_deg = 30.0, .max_angle_deg = largest});
    for (const Triangle& t : mesh.triangles)
      for (int i = 0; i < 3; ++i) {
        const Point &a = mesh.points[t.v[i]], &b = mesh.points[t.v[(i + 1) % 3]];
        EXPECT_LE(std::hypot(b.x - a.x, b.y - a.y), 0.07);
      }
  }
}

// Inner triangles with an obtuse angle; inner edges whose circumcentre distance is below a tenth of the mean square
// root of the two areas; the smallest such ratio.
struct Flaws {
  std::size_t obtuse = 0, small_links = 0;
  double least_link = std::numeric_limits<double>::infinity();
};

Flaws flawsOf(const TriMesh& mesh) {
  const auto centreOf = [&](TriId t) {
    const auto& v = mesh.triangles[t].v;
    const Point &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]];
    const double d = 2.0 * (a.x * (b.y - c.y) + b.x * (c.y - a.y) + c.x * (a.y - b.y));
    const double aa = a.x * a.x + a.y * a.y, bb = b.x * b.x + b.y * b.y, cc = c.x * c.x + c.y * c.y;
    return Point{(aa * (b.y - c.y) + bb * (c.y - a.y) + cc * (a.y - b.y)) / d,
                 (aa * (c.x - b.x) + bb * (a.x - c.x) + cc * (b.x - a.x)) / d};
  };
  const auto rootOf = [&](TriId t) {
    const auto& v = mesh.triangles[t].v;
    const Point &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]];
    return std::sqrt(0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)));
  };
  Flaws flaws;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t].v;
    const auto angles = anglesDeg(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
    bool inner = true;
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      inner = inner && mesh.segment(e) == kNone;
      if (mesh.twin(e) == kNone || mesh.twin(e) < e) continue;
      const Point a = centreOf(t), b = centreOf(triOf(mesh.twin(e)));
      const double link = std::hypot(b.x - a.x, b.y - a.y), roots = rootOf(t) + rootOf(triOf(mesh.twin(e)));
      flaws.small_links += link < 0.05 * roots;
      flaws.least_link = std::min(flaws.least_link, 2.0 * link / roots);
    }
    flaws.obtuse += inner && *std::ranges::max_element(angles) > 90.0;
  }
  return flaws;
}

TEST(Optimise, GoalsAreReached) {
  const SizeOf size(0.004, 0.2,
                    [](const Point& p) { return 0.004 + 0.15 * std::abs(std::sin(3.0 * p.x) * std::cos(4.0 * p.y)); });
  const Pslg pslg = wideLake();
  const auto flawsWith = [&](QualityGoal goal) {
    const RefineOptions options{.size = &size, .goal = goal};
    TriMesh mesh = refined(pslg, options);
    optimise(mesh, pslg, options, kMostOptimiseSweeps);
    expectValidMesh(mesh, pslg, {.min_angle_deg = 33.0});
    return flawsOf(mesh);
  };
  ASSERT_GT(flawsOf(refined(pslg, {.size = &size})).small_links, 10u);
  const Flaws usual = flawsWith(QualityGoal::Shape);
  EXPECT_LE(usual.small_links, 1u);
  ASSERT_GT(usual.obtuse, 0u);
  const Flaws linked = flawsWith(QualityGoal::Links);
  EXPECT_GT(linked.least_link, usual.least_link);
  EXPECT_GT(linked.least_link, 0.2);
  EXPECT_EQ(flawsWith(QualityGoal::Centred).obtuse, 0u);
}

// Shape qualities, ascending.
std::vector<double> sortedShapes(const TriMesh& mesh) {
  std::vector<double> shapes;
  for (const Triangle& t : mesh.triangles) {
    const Point &a = mesh.points[t.v[0]], &b = mesh.points[t.v[1]], &c = mesh.points[t.v[2]];
    const auto square = [](const Point& p, const Point& q) { return std::pow(q.x - p.x, 2) + std::pow(q.y - p.y, 2); };
    const double area = 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    shapes.push_back(4.0 * std::sqrt(3.0) * area / (square(a, b) + square(b, c) + square(c, a)));
  }
  std::ranges::sort(shapes);
  return shapes;
}

TEST(Optimise, FewTrianglesAreLeftPoorBesideTheShore) {
  const Pslg pslg = fractalCoast(3, 3, 2);
  const SizeOf size(0.02, 0.02, [](const Point&) { return 0.02; });
  const RefineOptions options{.size = &size};
  const TriMesh before = refined(pslg, options);
  const auto poorOf = [](const TriMesh& m) {
    const std::vector<double> shapes = sortedShapes(m);
    return std::ranges::lower_bound(shapes, 0.9) - shapes.begin();
  };
  TriMesh mesh = before;
  optimise(mesh, pslg, options, kOptimiseSweeps);
  expectValidMesh(mesh, pslg);
  EXPECT_LT(3 * poorOf(mesh), poorOf(before));
  // With a vertex limit, no vertex is inserted, so triangles that need one stay poor.
  TriMesh limited_mesh = before;
  RefineOptions limited = options;
  limited.max_vertices = 1'000'000;
  optimise(limited_mesh, pslg, limited, kOptimiseSweeps);
  expectValidMesh(limited_mesh, pslg);
  EXPECT_LT(poorOf(mesh), poorOf(limited_mesh));
  EXPECT_LE(limited_mesh.points.size(), before.points.size());
}

TEST(Optimise, VerticesSlideAlongSegments) {
  const Pslg pslg = wideLake();
  const SizeOf size(0.02, 0.2, [](const Point& p) { return 0.02 + 0.05 * std::hypot(p.x - 1.0, p.y - 1.0); });
  const RefineOptions options{.size = &size};
  const TriMesh before = refined(pslg, options);
  TriMesh mesh = before;
  optimise(mesh, pslg, options, kOptimiseSweeps);
  expectValidMesh(mesh, pslg, {.min_angle_deg = 33.0});
  const auto isOnSegment = [](const TriMesh& m) {
    std::vector<bool> on(m.points.size(), false);
    for (TriId t = 0; t < m.triangles.size(); ++t)
      for (unsigned i = 0; i < 3; ++i)
        if (const EdgeRef e = edgeRef(t, i); m.segment(e) != kNone) on[m.origin(e)] = on[m.target(e)] = true;
    return on;
  };
  const std::vector<bool> was_on = isOnSegment(before), is_on = isOnSegment(mesh);
  std::size_t elsewhere = 0;
  for (VertexId v = mesh.input_vertices; v < mesh.points.size(); ++v) {
    if (!is_on[v]) continue;
    bool known = false;
    for (VertexId w = before.input_vertices; w < before.points.size() && !known; ++w)
      known = was_on[w] && mesh.points[v] == before.points[w];
    elsewhere += !known;
  }
  EXPECT_GT(elsewhere, 10u);
}

double longestEdge(const TriMesh& mesh) {
  double longest = 0.0;
  for (TriId t = 0; t < mesh.triangles.size(); ++t)
    for (unsigned i = 0; i < 3; ++i)
      longest =
          std::max(longest, distance(mesh.points[mesh.origin(edgeRef(t, i))], mesh.points[mesh.target(edgeRef(t, i))]));
  return longest;
}

// A comb with teeth ten times as high as wide: vertices of its straight sides are removed to improve triangle shapes.
TEST(Optimise, NoEdgeGetsLongerThanAnyMayBe) {
  Pslg comb;
  for (int i = 0; i < 12; ++i)
    for (const Point& p : {Point{0.0, 10.0}, Point{0.0, 0.0}, Point{1.0, 0.0}, Point{1.0, 10.0}})
      comb.points.push_back(p + Point{2.0 * i, 0.0});
  comb.points.push_back({23.0, 12.0});
  comb.points.push_back({0.0, 12.0});
  const auto count = static_cast<VertexId>(comb.points.size());
  for (VertexId v = 0; v < count; ++v) comb.segments.push_back({v, (v + 1) % count, 0, 0, kOutside});
  const ConstantSize size(0.5);
  const RefineOptions options{.size = &size};
  TriMesh mesh = refined(comb, options);
  ASSERT_LE(longestEdge(mesh), kLongestShare * 0.5);
  const RefineStats stats = optimise(mesh, comb, options, kOptimiseSweeps);
  EXPECT_GT(stats.removals, 0u);
  EXPECT_LE(longestEdge(mesh), kLongestShare * 0.5);
}

TEST(Optimise, KeepsAFineCoastAndItsAngles) {
  const Pslg pslg = fractalCoast(3, 3, 2);
  const SizeOf size(0.2, 0.2, [](const Point&) { return 0.2; });
  const RefineOptions options{.min_angle_deg = 33.0, .size = &size};
  TriMesh mesh = constrainedDelaunay(pslg);
  const RefineStats made = refine(mesh, pslg, options);
  const std::size_t before = mesh.points.size();
  coarsen(mesh, pslg, options);
  EXPECT_LT(mesh.points.size(), before);
  const RefineStats stats = optimise(mesh, pslg, options, kMostOptimiseSweeps);
  EXPECT_LE(stats.unresolved.size(), made.unresolved.size());
  EXPECT_EQ(wrongBoundViolations(mesh, pslg, options, stats.unresolved), "");
  expectValidMesh(mesh, pslg);
}

// A shore of steps as long as the target edge length, at changing angles.
Pslg steppedShore() {
  Pslg pslg;
  Point at{0.0, 0.0};
  for (int i = 0; i < 60; ++i) {
    pslg.points.push_back(at);
    const double angle = 1.1 * std::sin(2.3 * i) + 0.4 * std::cos(5.1 * i);
    at = at + Point{std::cos(angle), std::sin(angle)};
  }
  const double right = pslg.points.back().x;
  pslg.points.push_back({right, 12.0});
  pslg.points.push_back({0.0, 12.0});
  for (VertexId v = 0; v < pslg.points.size(); ++v)
    pslg.segments.push_back({v, static_cast<VertexId>((v + 1) % pslg.points.size())});
  return pslg;
}

TEST(Optimise, TriesToLeaveNoEdgesShorterThanTheLeast) {
  const Pslg pslg = steppedShore();
  const ConstantSize size(1.0);
  constexpr double kLeast = 0.7;
  for (const double largest : {180.0, 90.0}) {
    SCOPED_TRACE(largest);
    const auto shortWith = [&](double least_edge) {
      const RefineOptions options{.max_angle_deg = largest,
                                  .size = &size,
                                  .goal = largest > 90.0 ? QualityGoal::Shape : QualityGoal::Centred,
                                  .least_edge = least_edge};
      TriMesh mesh = refined(pslg, options);
      const RefineStats stats = optimise(mesh, pslg, options, kOptimiseSweeps);
      EXPECT_TRUE(stats.unresolved.empty());
      expectValidMesh(mesh, pslg, {.min_angle_deg = 33.0, .max_angle_deg = largest});
      std::vector<double> lengths;
      for (TriId t = 0; t < mesh.triangles.size(); ++t)
        for (unsigned i = 0; i < 3; ++i)
          if (const EdgeRef e = edgeRef(t, i); mesh.twin(e) == kNone || e < mesh.twin(e))
            if (const double d = distance(mesh.points[mesh.origin(e)], mesh.points[mesh.target(e)]); d < kLeast)
              lengths.push_back(d);
      std::ranges::sort(lengths);
      return lengths;
    };
    const std::vector<double> without = shortWith(0.0), with = shortWith(kLeast);
    ASSERT_FALSE(without.empty());
    EXPECT_LE(2 * with.size(), without.size());
    EXPECT_GE(with.empty() ? kLeast : with.front(), without.front());
  }
}

TEST(Optimise, WithoutSizesEvensAnglesOut) {
  const Pslg pslg = fractalCoast(1, 3, 2);
  const RefineOptions options{.min_angle_deg = 30.0};
  TriMesh mesh = constrainedDelaunay(pslg);
  refine(mesh, pslg, options);
  const auto sharp = [](const TriMesh& m) {
    std::size_t count = 0;
    for (const Triangle& t : m.triangles)
      for (const double angle : anglesDeg(m.points[t.v[0]], m.points[t.v[1]], m.points[t.v[2]])) count += angle < 40.0;
    return count;
  };
  const std::size_t before = sharp(mesh), vertices = mesh.points.size();
  const RefineStats stats = optimise(mesh, pslg, options, kMostOptimiseSweeps);
  EXPECT_TRUE(stats.unresolved.empty());
  EXPECT_LE(mesh.points.size(), vertices);
  EXPECT_LT(sharp(mesh), before);
  EXPECT_EQ(wrongBoundViolations(mesh, pslg, options, stats.unresolved), "");
  expectValidMesh(mesh, pslg, {.min_angle_deg = 30.0});
}

// Rows of equilateral triangles, where one pair has the other diagonal of its rhombus: the diagonal's ends are so close
// together that it is Delaunay.
TEST(DiagonalExchange, TakesAwayFivesAndSevens) {
  constexpr int kSide = 8;
  Pslg pslg;
  const auto at = [&](int i, int j) { return static_cast<VertexId>(j * kSide + i); };
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) pslg.points.push_back({i + 0.5 * j, 0.5 * std::sqrt(3.0) * j});
  for (const auto& [from, to] : {std::pair{at(0, 0), at(kSide - 1, 0)},
                                 {at(kSide - 1, 0), at(kSide - 1, kSide - 1)},
                                 {at(kSide - 1, kSide - 1), at(0, kSide - 1)},
                                 {at(0, kSide - 1), at(0, 0)}}) {
    const int steps = kSide - 1;
    const auto step = (static_cast<int>(to) - static_cast<int>(from)) / steps;
    for (int k = 0; k < steps; ++k)
      pslg.segments.push_back({static_cast<VertexId>(from + k * step), static_cast<VertexId>(from + (k + 1) * step)});
  }
  // The rhombus of (3,3), (4,3), (3,4) and (4,4): its short diagonal joins (4,3) and (3,4).
  const VertexId left = at(3, 3), right = at(4, 4), low = at(4, 3), high = at(3, 4);
  const auto towards = [&](VertexId v, VertexId w, double share) {
    const Point a = pslg.points[v], b = pslg.points[w];
    return Point{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
  };
  const Point moved_left = towards(left, right, 0.2), moved_right = towards(right, left, 0.2);
  const Point moved_low = towards(low, high, -0.15), moved_high = towards(high, low, -0.15);
  pslg.points[left] = moved_left;
  pslg.points[right] = moved_right;
  pslg.points[low] = moved_low;
  pslg.points[high] = moved_high;

  TriMesh made = constrainedDelaunay(pslg);
  made.input_vertices = 0;  // all vertices inside the boundary may move
  EditMesh mesh(std::move(made));
  const auto trianglesRound = [&](VertexId v) {
    std::vector<EdgeRef> star;
    mesh.star(v, star);
    return star.size();
  };
  ASSERT_EQ(trianglesRound(left), 7u);
  ASSERT_EQ(trianglesRound(right), 7u);
  ASSERT_EQ(trianglesRound(low), 5u);
  ASSERT_EQ(trianglesRound(high), 5u);
  const TriangleBound bound(30.0, 180.0, std::numeric_limits<double>::infinity());
  const VertexOps ops(mesh, pslg, bound);
  const std::vector<double> wanted(mesh.vertexSlots(), 1.0);
  DiagonalExchange exchange(mesh, ops, bound, wanted);
  std::vector<TriId> touched;
  const std::uint64_t digest = digestOf(releasedCopy(mesh));
  EXPECT_FALSE(exchange.tryExchange(low, left, right, high, touched)) << "that leaves a triangle turned over";
  EXPECT_EQ(digestOf(releasedCopy(mesh)), digest);
  ASSERT_TRUE(exchange.tryExchange(left, right, high, low, touched));
  EXPECT_FALSE(touched.empty());
  for (const VertexId v : {left, right, low, high}) EXPECT_EQ(trianglesRound(v), 6u);
  EXPECT_EQ(describe(checkMesh(releasedCopy(mesh), nullptr, {.min_angle_deg = 50.0})), "");
}

}  // namespace
}  // namespace coastmesh
