#include "core/refine/refine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <string>

#include "core/metric.hpp"
#include "core/quality.hpp"
#include "core/refine/vertex_notes.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/excused_twin.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/mesh_figures.hpp"
#include "tests/support/pslg_parts.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

constexpr Algorithm kAlgorithms[] = {Algorithm::Circumcenter, Algorithm::Offcenter, Algorithm::Optimal,
                                     Algorithm::Relocate};

using Places = std::set<std::pair<double, double>>;

// Properties of every refined mesh, whatever the options.
void expectRefined(const TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, const RefineStats& stats) {
  // A valid mesh of the input, with the same regions.
  expectValidMesh(mesh, pslg);
  EXPECT_EQ(stats.steiner_points, mesh.points.size() - pslg.points.size());
  const auto before = areasByRegion(constrainedDelaunay(pslg)), after = areasByRegion(mesh);
  ASSERT_EQ(after.size(), before.size());
  for (const auto& [region, area] : before) EXPECT_NEAR(after.at(region), area, 1e-9 * area) << "region " << region;

  // Every triangle that misses the bounds is excused or listed; every listed triangle misses them.
  EXPECT_EQ(wrongBoundViolations(mesh, pslg, options, stats.unresolved), "");

  // The checker finds the same triangles, except those within rounding of the bound.
  if (!std::isinf(options.size_max)) return;
  constexpr double kHair = 1e-5;
  Places listed;
  for (const BoundViolation& s : stats.unresolved) listed.insert({s.place.x, s.place.y});
  const auto defects =
      checkMesh(mesh, &pslg, {.min_angle_deg = options.min_angle_deg, .max_angle_deg = options.max_angle_deg});
  std::size_t clear = 0;
  for (const BoundViolation& s : stats.unresolved)
    clear += s.min_angle_deg < options.min_angle_deg - kHair || s.max_angle_deg > options.max_angle_deg + kHair;
  EXPECT_GE(defects.size(), clear);
  for (const MeshDefect& d : defects) {
    EXPECT_EQ(d.kind, DefectKind::AngleBelowBound);
    EXPECT_TRUE(listed.contains({d.place.x, d.place.y})) << d.place.x << ", " << d.place.y;
  }
}

struct Refined {
  TriMesh mesh;
  RefineStats stats;
};

Refined refined(const Pslg& pslg, const RefineOptions& options, const RunControl& control = {}) {
  Refined result{constrainedDelaunay(pslg), {}};
  result.stats = refine(result.mesh, pslg, options, control);
  return result;
}

std::string describe(const RefineOptions& o) {
  const char* names[] = {"circumcenter", "offcenter", "optimal", "relocate"};
  std::ostringstream text;
  text << names[static_cast<unsigned>(o.algorithm)] << ", " << o.min_angle_deg << " to " << o.max_angle_deg
       << " degrees, size " << o.size_max;
  return text.str();
}

class RefineOf : public ::testing::TestWithParam<NamedPslg> {
 protected:
  // Without segments, the boundary is the convex hull, whose edges may not be split.
  bool hasSegments() const { return !GetParam().pslg.segments.empty(); }
  // Rays 2 degrees apart, of uneven lengths: at small bounds, one triangle joins the tips of two neighbouring rays,
  // beyond the reach of an excusing angle, and no point repairs it.
  std::size_t mostUnresolved(double angle) const { return GetParam().name == "FanOfAngles" && angle <= 20.0 ? 1 : 0; }

  RefineStats expectRefinedWith(RefineOptions options) {
    SCOPED_TRACE(describe(options));
    // A run that does not terminate must fail, not hang.
    options.max_vertices = 20'000;
    const Refined result = refined(GetParam().pslg, options);
    expectRefined(result.mesh, GetParam().pslg, options, result.stats);
    EXPECT_FALSE(result.stats.budget_reached);
    // The input's spacing or the requested size bounds edges from below.
    constexpr double kShare = 1e-3;
    EXPECT_GE(measureQuality(result.mesh, 0.0).shortest_edge,
              kShare * std::min(smallestSpacing(GetParam().pslg), options.size_max));
    return result.stats;
  }
};

TEST_P(RefineOf, AnyAlgorithmAndAngle) {
  for (const Algorithm algorithm : kAlgorithms) {
    for (const double angle : {0.0, 10.0, 20.0, 30.0, 33.0}) {
      const RefineStats stats = expectRefinedWith({.min_angle_deg = angle, .algorithm = algorithm});
      const bool in_reach = angle <= 20.0 || (angle <= 33.0 && algorithm >= Algorithm::Optimal);
      if (in_reach && hasSegments()) {
        EXPECT_LE(stats.unresolved.size(), mostUnresolved(angle))
            << angle << " degrees, algorithm " << static_cast<unsigned>(algorithm);
      }
      EXPECT_TRUE(angle > 0.0 || stats.steiner_points == 0);
      if (algorithm == Algorithm::Relocate) continue;
      // Without relocation every vertex is accounted for.
      const auto inserted = std::accumulate(stats.by_type.begin(), stats.by_type.end(), std::uint64_t{0});
      EXPECT_EQ(stats.steiner_points, inserted + stats.segment_splits - stats.removals);
      EXPECT_EQ(stats.relocations, 0u);
      EXPECT_EQ(stats.merges, 0u);
      if (algorithm == Algorithm::Circumcenter) {
        EXPECT_EQ(inserted, stats.by_type[3]);
      }
      if (algorithm == Algorithm::Offcenter) {
        EXPECT_EQ(inserted, stats.by_type[0] + stats.by_type[3]);
      }
    }
  }
}

TEST_P(RefineOf, AnglesUpToWhereNoneHasReached) {
  for (const double angle : {38.0, 40.0, 42.0, 45.0}) {
    const RefineStats stats = expectRefinedWith({.min_angle_deg = angle});
    if (angle > 42.0 || !hasSegments()) continue;
    EXPECT_EQ(stats.unresolved.size(), 0u) << angle << " degrees";
  }
}

TEST_P(RefineOf, LargestAngles) {
  for (const auto& [low, high] : {std::pair(20.0, 130.0), {30.0, 100.0}, {0.0, 120.0}, {38.0, 90.0}})
    expectRefinedWith({.min_angle_deg = low, .max_angle_deg = high});
}

TEST_P(RefineOf, Sizes) {
  for (const Algorithm algorithm : kAlgorithms)
    expectRefinedWith({.min_angle_deg = 25.0, .size_max = 0.15, .algorithm = algorithm});
  expectRefinedWith({.min_angle_deg = 0.0, .size_max = 0.2});
}

TEST_P(RefineOf, IsTheSameTwice) {
  for (const Algorithm algorithm : kAlgorithms) {
    const RefineOptions options{.min_angle_deg = 30.0, .algorithm = algorithm};
    const Refined first = refined(GetParam().pslg, options), second = refined(GetParam().pslg, options);
    EXPECT_EQ(digestOf(first.mesh), digestOf(second.mesh));
    EXPECT_EQ(first.mesh.regions, second.mesh.regions);
  }
}

// Scaling by a power of two does not round, so the result must scale exactly.
TEST_P(RefineOf, ScalesExactly) {
  const RefineOptions options{.min_angle_deg = 33.0};
  const Refined once = refined(GetParam().pslg, options);
  for (const double factor : {0x1p-20, 0x1p20}) {
    const Refined other = refined(scaled(GetParam().pslg, factor), options);
    ASSERT_EQ(other.mesh.points.size(), once.mesh.points.size()) << factor;
    for (std::size_t v = 0; v < once.mesh.points.size(); ++v)
      ASSERT_EQ(other.mesh.points[v], factor * once.mesh.points[v]) << factor;
  }
}

TEST_P(RefineOf, BudgetGivesAValidMesh) {
  const Pslg& pslg = GetParam().pslg;
  const std::uint64_t needed = refined(pslg, {.min_angle_deg = 30.0}).mesh.points.size();
  for (const std::uint64_t most :
       {std::uint64_t{1}, std::uint64_t{pslg.points.size()}, (pslg.points.size() + needed) / 2}) {
    for (const Algorithm algorithm : kAlgorithms) {
      const RefineOptions without_budget{.min_angle_deg = 30.0, .algorithm = algorithm};
      RefineOptions options = without_budget;
      options.max_vertices = most;
      SCOPED_TRACE(describe(options));
      const Refined result = refined(pslg, options);
      expectRefined(result.mesh, pslg, options, result.stats);
      EXPECT_LE(result.mesh.points.size(), std::max<std::uint64_t>(most, pslg.points.size()));
      // If the budget is not reached, it does not change the mesh.
      if (!result.stats.budget_reached) {
        EXPECT_EQ(digestOf(result.mesh), digestOf(refined(pslg, without_budget).mesh));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, RefineOf, ::testing::ValuesIn(assortedPslgs()),
                         [](const auto& param_info) { return nameOf(param_info.param); });

// With bounds that cannot be met, refinement ends at the spacing limit set by the input, not at that of double
// precision.
TEST(Refine, HopelessBoundsEnd) {
  const auto expectEnd = [](const Pslg& pslg, RefineOptions options) {
    options.max_vertices = 20'000;
    const Refined result = refined(pslg, options);
    SCOPED_TRACE(describe(options));
    expectValidMesh(result.mesh, pslg);
    EXPECT_FALSE(result.stats.budget_reached);
    EXPECT_GE(measureQuality(result.mesh, 0.0).shortest_edge, 1e-3 * smallestSpacing(pslg));
  };
  expectEnd(combPolygon(11), {.min_angle_deg = 40.0, .algorithm = Algorithm::Circumcenter});
  expectEnd(starPolygon(14, 40), {.min_angle_deg = 41.0, .max_angle_deg = 75.0, .algorithm = Algorithm::Offcenter});
  expectEnd(squareWithHole(), {.min_angle_deg = 30.0, .max_angle_deg = 70.0, .algorithm = Algorithm::Optimal});
  for (const double step_deg : {1.0, 5.0, 29.0})
    for (int rays = 2; rays < 5; ++rays)
      for (const double angle : {25.0, 33.0, 38.0, 44.0})
        expectEnd(fanOfAngles(rays, step_deg), {.min_angle_deg = angle});
}

// The petal of a triangle with the angle aimed at has the triangle's own circumcircle, up to rounding.
TEST(Refine, OptimalReachesTheLongestEdge) {
  for (const double width : {60.0, 63.0, 66.0, 67.0}) {
    Pslg pslg;
    addRing(pslg, {{0.0, 0.0}, {width, 0.0}, {width, 67.0}, {0.0, 67.0}}, kUnlabelled, kUnlabelled);
    const RefineOptions options{.size_max = 2.5, .algorithm = Algorithm::Optimal};
    const Refined result = refined(pslg, options);
    expectRefined(result.mesh, pslg, options, result.stats);
    EXPECT_TRUE(result.stats.unresolved.empty()) << width;
  }
}

// A point on a triangle's own circumcircle leaves the triangle there.
TEST(Refine, TrianglesThatAreOnlyTooObtuseAreTriedAgain) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Pslg coast = fractalCoast(seed, 7, 5);
    const Refined result = refined(coast, {.min_angle_deg = 0.0, .max_angle_deg = 120.0});
    EXPECT_EQ(result.stats.unresolved.size(), 0u) << seed;
  }
}

TEST(Refine, FewPointsWithALargeMeshAreRefinedOnce) {
  const Pslg square = squarePslg();
  const auto isThatOfOneRun = [&](double size_max) {
    const RefineOptions options{.size_max = size_max};
    const Refined result = refined(square, options);
    TriMesh once = constrainedDelaunay(square);
    refine(once, square, options, noteInput(once, boundOf(options)));
    return result.mesh.points == once.points;
  };
  EXPECT_FALSE(isThatOfOneRun(0.1));
  EXPECT_TRUE(isThatOfOneRun(0.02));
}

TEST(Refine, BudgetJustEnoughIsNotReached) {
  const Pslg pslg = fractalCoast(3, 2, 2);
  const RefineOptions options{.min_angle_deg = 30.0, .algorithm = Algorithm::Optimal};
  const std::uint64_t needed = refined(pslg, options).mesh.points.size();
  RefineOptions enough = options, short_by_one = options;
  enough.max_vertices = needed + 1;
  short_by_one.max_vertices = needed - 1;
  EXPECT_FALSE(refined(pslg, enough).stats.budget_reached);
  EXPECT_TRUE(refined(pslg, short_by_one).stats.budget_reached);
}

TEST(Refine, LongestEdgeHoldsTheSize) {
  for (const Pslg& pslg : {squarePslg(), squareWithHole(), twoRegions(), narrowChannel(0.05)}) {
    for (const double size : {0.5, 0.1, 0.04}) {
      const Refined result = refined(pslg, {.min_angle_deg = 28.0, .size_max = size});
      EXPECT_TRUE(result.stats.unresolved.empty());
      const MeshQuality quality = measureQuality(result.mesh, 28.0);
      EXPECT_LE(quality.longest_edge, size);
      // And not with far more triangles than necessary: an equilateral triangle of that size has 0.43 size².
      EXPECT_LT(static_cast<double>(quality.triangles), 40.0 + 8.0 * quality.area / (0.43 * size * size));
    }
  }
}

// The triangle that fills an input angle too small for the bound also obeys the longest edge.
TEST(Refine, LongestEdgeHoldsInSharpCorners) {
  for (const double width : {0.02, 0.1, 0.3}) {
    Pslg pslg;
    pslg.points = {{0, 0}, {1, 0}, {1, width}};
    pslg.segments = {{0, 1}, {1, 2}, {2, 0}};
    for (const double size : {0.3, 0.05}) {
      const Refined result = refined(pslg, {.min_angle_deg = 30.0, .size_max = size});
      EXPECT_TRUE(result.stats.unresolved.empty()) << width << ' ' << size;
      EXPECT_LE(measureQuality(result.mesh, 30.0).longest_edge, size) << width;
    }
  }
}

// A lake whose western end is an angle too small for the bound. The triangle that fills it has its base across the
// water; the point that repairs the triangle beyond the base lies in the filling triangle's circumcircle. The filling
// triangle's sides must be split first.
TEST(Refine, BeyondTheBaseOfATriangleThatFillsACorner) {
  Pslg pslg;
  pslg.points = {{0, 1135}, {1062, 1325}, {1564, 1046}, {1897, 0}, {1062, 378}, {970, 1046}};
  for (VertexId v = 6; v-- > 0;) pslg.segments.push_back({(v + 1) % 6, v, 0, 0, kOutside});
  for (const double angle : {30.0, 33.0}) {
    const RefineOptions options{.min_angle_deg = angle};
    SCOPED_TRACE(describe(options));
    const Refined result = refined(pslg, options);
    expectRefined(result.mesh, pslg, options, result.stats);
    EXPECT_EQ(result.stats.unresolved.size(), 0u);
  }
}

// A channel whose width only the opposite shore reveals.
TEST(Refine, ChannelsOfAnyWidth) {
  for (const double width : {0.03, 0.01, 0.001, 0.0001}) {
    for (const Algorithm algorithm : {Algorithm::Optimal, Algorithm::Relocate}) {
      for (const double angle : {20.0, 30.0}) {
        const RefineOptions options{.min_angle_deg = angle, .algorithm = algorithm};
        SCOPED_TRACE(::testing::Message() << describe(options) << ", width " << width);
        const Pslg pslg = narrowChannel(width);
        const Refined result = refined(pslg, options);
        expectRefined(result.mesh, pslg, options, result.stats);
        EXPECT_EQ(result.stats.unresolved.size(), 0u);
      }
    }
  }
}

// An inlet that narrows to an angle, with land behind its shores, or with water on both sides of the two rays. The rays
// have uneven lengths, and their tips are close together. Only triangles that fill the angle are excused, so all others
// must be good.
Pslg narrowInlet(double angle_deg, bool water_beside) {
  const double along = std::cos(toRadians(angle_deg)), across = std::sin(toRadians(angle_deg));
  Pslg pslg;
  pslg.points = {{-3, -3}, {3, -3}, {3, 3}, {-3, 3}, {-2, 0}, {-2 + 2.27, 0}, {-2 + 2.38 * along, 2.38 * across}};
  pslg.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {4, 6}};
  if (!water_beside) {
    // Land behind the rays, with a tip at the end of each.
    pslg.points.insert(pslg.points.end(), {{-2.2, 1.1}, {-2.2, -0.9}});
    pslg.segments.insert(pslg.segments.end(), {{6, 7}, {7, 8}, {8, 5}});
    pslg.holes = {{-2.15, 0.1}};
  }
  return pslg;
}

TEST(Refine, InletsOfAnyAngle) {
  for (const bool water_beside : {false, true}) {
    for (const double angle : {0.03, 0.12, 0.4, 1.0, 2.0, 4.0, 7.0, 12.0, 20.0}) {
      for (const double min_angle : {25.0, 33.0}) {
        const Pslg pslg = narrowInlet(angle, water_beside);
        const RefineOptions options{.min_angle_deg = min_angle};
        SCOPED_TRACE("an angle of " + std::to_string(angle) + (water_beside ? ", water beside, " : ", ") +
                     std::to_string(min_angle));
        const auto [mesh, stats] = refined(pslg, options);
        expectRefined(mesh, pslg, options, stats);
        // With water on both sides of a ray, good triangles cannot grade from the ray's length down to the width of a
        // tiny angle: around a point of the ray, each can be only a little wider than the one before, and half a turn
        // has room for five. Where the ray's pieces change from long to short, some triangles miss the bound, here
        // beyond the reach of the excusing angle.
        const bool has_limits = water_beside && angle < 1.0;
        EXPECT_LE(stats.unresolved.size(), has_limits ? mesh.triangles.size() / 12 : 0);
        EXPECT_LT(mesh.triangles.size(), 2500u);
      }
    }
  }
}

// At first only one of them has a triangle with the side.
TEST(Refine, PointsCloseToALongSegment) {
  Pslg pslg;
  pslg.points = {{0, 0}, {10000, 0}, {10000, 10000}, {0, 10000}};
  for (VertexId i = 0; i < 4; ++i) pslg.segments.push_back({i, (i + 1) % 4});
  for (int i = 1; i < 20; ++i) {
    const double x = 500.0 * i;
    pslg.points.push_back({x, 0.5 + 0.1 * (i % 7)});
    pslg.points.push_back({x + 3.0, 300.0});
  }
  for (const double min_angle : {25.0, 33.0, 38.0})
    for (const Algorithm algorithm : kAlgorithms) {
      const RefineOptions options{.min_angle_deg = algorithm == Algorithm::Relocate ? min_angle : 25.0,
                                  .algorithm = algorithm};
      SCOPED_TRACE(describe(options));
      const auto [mesh, stats] = refined(pslg, options);
      expectRefined(mesh, pslg, options, stats);
      EXPECT_TRUE(stats.unresolved.empty());
    }
}

// Neither huge nor tiny coordinates nor the input's orientation matter. Each mesh depends on every rounding, so a
// single count says little; sums over several hardly change.
TEST(Refine, ScaleMoveAndTurnHardlyChangeTheCount) {
  for (const Algorithm algorithm : {Algorithm::Optimal, Algorithm::Relocate}) {
    const RefineOptions options{.min_angle_deg = 33.0, .algorithm = algorithm};
    SCOPED_TRACE(describe(options));
    std::map<std::string, double> counts;
    for (unsigned seed = 1; seed <= 4; ++seed) {
      for (const Pslg& pslg : {fractalCoast(seed, 3, 4), randomPointsInBox(seed, 400)}) {
        const double far = 1e7 * smallestSpacing(pslg);
        const std::vector<NamedPslg> variants{{"as it is", pslg},
                                              {"scaled by 1e-6", scaled(pslg, 1e-6)},
                                              {"scaled by 1e6", scaled(pslg, 1e6)},
                                              {"moved", moved(pslg, {far, -0.7 * far})},
                                              {"turned", turned(pslg, 33.0)}};
        for (const auto& [name, variant] : variants) {
          SCOPED_TRACE(name);
          const Refined result = refined(variant, options);
          expectValidMesh(result.mesh, variant);
          counts[name] += static_cast<double>(result.stats.steiner_points);
        }
      }
    }
    const double count = counts["as it is"];
    for (const auto& [name, other] : counts) EXPECT_NEAR(other, count, 0.03 * count) << name;
  }
}

TEST(Refine, OptimalNeedsFewerPointsThanCircumcenters) {
  const Pslg pslg = fractalCoast(5, 3, 3);
  std::vector<std::uint64_t> counts;
  for (const Algorithm algorithm : kAlgorithms)
    counts.push_back(refined(pslg, {.min_angle_deg = 30.0, .algorithm = algorithm}).stats.steiner_points);
  EXPECT_LT(counts[2], counts[0]);
  EXPECT_LT(counts[3], counts[2]);
}

TEST(Refine, CancelledStopsIt) {
  const Pslg pslg = fractalCoast(4, 4, 4);
  for (const Algorithm algorithm : kAlgorithms) {
    int asked = 0;
    RunControl control;
    control.cancelled = [&] { return ++asked == 2; };
    EXPECT_THROW(refined(pslg, {.min_angle_deg = 33.0, .algorithm = algorithm}, control), Cancelled);
    EXPECT_EQ(asked, 2) << "nothing runs on after the answer";
  }
}

TEST(Refine, ControlThatNeverCancelsChangesNothing) {
  const Pslg pslg = fractalCoast(4, 4, 4);
  std::vector<double> shares;
  RunControl control;
  control.cancelled = [] { return false; };
  control.progress = [&](double share) { shares.push_back(share); };
  const Refined watched = refined(pslg, {}, control), alone = refined(pslg, {});
  EXPECT_EQ(digestOf(watched.mesh), digestOf(alone.mesh));
  EXPECT_GT(shares.size(), 1u);
  for (const double share : shares) {
    EXPECT_GE(share, 0.0);
    EXPECT_LE(share, 1.0);
  }
}

TEST(RefineStats, AddUp) {
  RefineStats a, b;
  a.steiner_points = 1;
  b.steiner_points = 10;
  a.by_type = {1, 2, 3, 4};
  b.by_type = {10, 20, 30, 40};
  a.segment_splits = 5;
  b.segment_splits = 50;
  a.relocations = 6;
  b.relocations = 60;
  a.removals = 7;
  b.removals = 70;
  a.merges = 8;
  b.merges = 80;
  b.budget_reached = true;
  a.unresolved = {{{1, 2}, 3, 4}};
  b.unresolved = {{{5, 6}, 7, 8}, {{9, 10}, 11, 12}};
  a.add(b);
  EXPECT_EQ(a.steiner_points, 11u);
  EXPECT_EQ(a.by_type, (std::array<std::uint64_t, 4>{11, 22, 33, 44}));
  EXPECT_EQ(a.segment_splits, 55u);
  EXPECT_EQ(a.relocations, 66u);
  EXPECT_EQ(a.removals, 77u);
  EXPECT_EQ(a.merges, 88u);
  EXPECT_TRUE(a.budget_reached);
  ASSERT_EQ(a.unresolved.size(), 3u);
  EXPECT_EQ(a.unresolved[2].place, (Point{9, 10}));
}

// Near both limits of the range of coordinates, refinement meets the same bounds.
TEST(Refine, AtTheEndsOfTheRangeOfCoordinates) {
  for (const double factor : {1e-68, 1e-40, 1e40, 0.9e70}) {
    SCOPED_TRACE(factor);
    const Pslg pslg = scaled(squareWithHole(), factor);
    const RefineOptions options{.min_angle_deg = 33.0, .max_angle_deg = 110.0};
    TriMesh mesh = constrainedDelaunay(pslg);
    const RefineStats stats = refine(mesh, pslg, options);
    EXPECT_TRUE(stats.unresolved.empty());
    expectRefined(mesh, pslg, options, stats);
  }
}

// A narrow gap between two segments takes more vertices than fit into memory; the error must name a place in it.
TEST(Refine, StopsWhereTheMemoryWouldNotHoldWhatTheInputTakes) {
  Pslg pslg = squarePslg();
  pslg.points.insert(pslg.points.end(), {{0.1, 0.5}, {0.9, 0.5}, {0.1, 0.50001}, {0.9, 0.50001}});
  pslg.segments.insert(pslg.segments.end(), {{4, 5}, {6, 7}});
  for (const std::uint64_t most : {1000u, 5000u}) {
    TriMesh mesh = constrainedDelaunay(pslg);
    const RefineOptions options{.min_angle_deg = 33.0, .most_in_memory = most};
    try {
      refine(mesh, pslg, options);
      FAIL() << most;
    } catch (const OutOfRoom& error) {
      EXPECT_NEAR(error.place.y, 0.5, 0.01);
      EXPECT_TRUE(error.place.x > 0.05 && error.place.x < 0.95) << error.place.x;
    }
  }
  TriMesh mesh = constrainedDelaunay(squareWithHole());
  EXPECT_NO_THROW(refine(mesh, squareWithHole(), {.min_angle_deg = 33.0, .most_in_memory = 1000}));
}

// A gap of 0.001, which needs vertices as close together: with a resolution, none is closer than that.
TEST(Refine, PutsNoVertexNearerThanTheResolution) {
  Pslg pslg = squarePslg();
  pslg.points.insert(pslg.points.end(), {{0.3, 0.5}, {0.5, 0.5}, {0.501, 0.5}, {0.7, 0.5}});
  pslg.segments.insert(pslg.segments.end(), {{4, 5}, {6, 7}});
  const auto least = [&](double resolution) {
    TriMesh mesh = constrainedDelaunay(pslg);
    const RefineOptions options{.min_angle_deg = 33.0, .resolution = resolution};
    const RefineStats stats = refine(mesh, pslg, options);
    expectRefined(mesh, pslg, options, stats);
    double nearest = 1.0;
    for (std::size_t v = pslg.points.size(); v < mesh.points.size(); ++v)
      for (std::size_t w = 0; w < mesh.points.size(); ++w)
        if (w != v) nearest = std::min(nearest, distance(mesh.points[v], mesh.points[w]));
    return nearest;
  };
  EXPECT_LT(least(0.0), 0.01);
  EXPECT_GE(least(0.01), 0.01);
}

// Enough for several blocks of vertices, at an angle at which repairs insert some together: a vertex may be counted to
// the block of one that has none yet.
TEST(Refine, ManyVerticesAreMendedByBlocks) {
  const Pslg pslg = fractalCoast(3, 5, 4);
  ASSERT_GT(pslg.points.size(), 8000u);
  const RefineOptions options{.min_angle_deg = 42.0};
  const Refined result = refined(pslg, options);
  expectRefined(result.mesh, pslg, options, result.stats);
  EXPECT_EQ(digestOf(result.mesh), digestOf(refined(pslg, options).mesh));
}

TEST(Refine, OptionsBeyondTheirRangesAreMisuse) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
  std::vector<RefineOptions> wrong;
  for (const double angle : {-1.0, 45.5, 50.0, kNan, kInfinity}) wrong.push_back({.min_angle_deg = angle});
  for (const double angle : {59.0, 181.0, kNan}) wrong.push_back({.max_angle_deg = angle});
  for (const double size : {0.0, -1.0, kNan, -kInfinity}) wrong.push_back({.size_max = size});
  for (const double resolution : {-1.0, kNan, kInfinity}) wrong.push_back({.resolution = resolution});
  for (const double scale : {0.0, -1.0, kNan, kInfinity}) wrong.push_back({.size_scale = scale});
  const Pslg pslg = squarePslg();
  for (const RefineOptions& options : wrong) {
    TriMesh mesh = constrainedDelaunay(pslg);
    EXPECT_THROW(refine(mesh, pslg, options), std::invalid_argument);
    EXPECT_THROW(coarsen(mesh, pslg, options), std::invalid_argument);
    EXPECT_TRUE(std::ranges::equal(mesh.points, pslg.points)) << "the mesh stays as it was";
  }
}

}  // namespace
}  // namespace coastmesh
