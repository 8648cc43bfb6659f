#include "parallel/mesh_regions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/lattice/lattice.hpp"
#include "core/metric.hpp"
#include "core/triangulate/delaunay.hpp"
#include "parallel/workers.hpp"
#include "tests/support/excused_twin.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

void forEachRegion(std::size_t count, const ParallelOptions& options, const RunControl& control,
                   const std::function<void(std::size_t)>& work) {
  withThreads(options, [&] { forEachItem(count, control, work); });
}

class ForEachRegion : public ::testing::TestWithParam<int> {
 protected:
  ParallelOptions options() const { return {.threads = GetParam()}; }
};

TEST_P(ForEachRegion, DoesEveryItemOnce) {
  for (const std::size_t count : {0u, 1u, 2u, 7u, 1000u}) {
    std::vector<std::atomic<int>> calls(count);
    forEachRegion(count, options(), {}, [&](std::size_t i) { ++calls[i]; });
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(calls[i], 1) << i << " of " << count;
  }
}

TEST_P(ForEachRegion, NeverRunsMoreAtOnceThanThreads) {
  std::mutex mutex;
  std::set<std::thread::id> running, seen;
  std::size_t most = 0;
  forEachRegion(200, options(), {}, [&](std::size_t) {
    {
      const std::lock_guard lock(mutex);
      EXPECT_TRUE(running.insert(std::this_thread::get_id()).second);
      seen.insert(std::this_thread::get_id());
      most = std::max(most, running.size());
    }
    std::this_thread::yield();
    const std::lock_guard lock(mutex);
    running.erase(std::this_thread::get_id());
  });
  EXPECT_LE(most, static_cast<std::size_t>(GetParam()));
  EXPECT_LE(seen.size(), static_cast<std::size_t>(GetParam()));
}

TEST_P(ForEachRegion, RethrowsTheErrorOfTheLeastIndex) {
  // With several threads, all throwing items have started before the first one throws, so every one of them throws.
  for (int repeat = 0; repeat < 20; ++repeat) {
    const auto throwing = static_cast<std::size_t>(GetParam());
    std::atomic<std::size_t> waiting = 0;
    std::string message;
    try {
      forEachRegion(100, options(), {}, [&](std::size_t i) {
        if (i >= throwing) return;
        ++waiting;
        while (waiting < throwing) std::this_thread::yield();
        throw std::runtime_error("item " + std::to_string(i));
      });
    } catch (const std::runtime_error& error) {
      message = error.what();
    }
    EXPECT_EQ(message, "item 0");
  }
}

TEST_P(ForEachRegion, StopsAfterAnError) {
  // The other items continue, slowly, once the first one throws.
  std::atomic<int> calls = 0;
  std::atomic<bool> throws = false;
  EXPECT_THROW(forEachRegion(5000, options(), {},
                             [&](std::size_t i) {
                               ++calls;
                               if (i == 0) {
                                 throws = true;
                                 throw std::invalid_argument("no");
                               }
                               while (!throws) std::this_thread::yield();
                               std::this_thread::sleep_for(std::chrono::milliseconds(1));
                             }),
               std::invalid_argument);
  EXPECT_LT(calls, 5000);
}

TEST_P(ForEachRegion, CanBeUsedAgainAfterAnError) {
  EXPECT_THROW(forEachRegion(3, options(), {}, [](std::size_t) { throw 7; }), int);
  std::atomic<int> calls = 0;
  forEachRegion(50, options(), {}, [&](std::size_t) { ++calls; });
  EXPECT_EQ(calls, 50);
}

TEST_P(ForEachRegion, CancelledThrowsAndStops) {
  std::atomic<int> calls = 0;
  std::atomic<bool> stop = false;
  RunControl control;
  control.cancelled = [&] { return stop.load(); };
  EXPECT_THROW(forEachRegion(100'000, options(), control,
                             [&](std::size_t) {
                               if (++calls == 5) stop = true;
                             }),
               Cancelled);
  // Items that had already started may finish.
  EXPECT_LE(calls, 5 + GetParam());
  stop = true;
  calls = 0;
  EXPECT_THROW(forEachRegion(10, options(), control, [&](std::size_t) { ++calls; }), Cancelled);
  EXPECT_EQ(calls, 0) << "cancelled before it began";
}

TEST_P(ForEachRegion, ProgressRisesToOneFromOneThreadAtATime) {
  std::atomic<int> inside = 0;
  std::vector<double> shares;
  RunControl control;
  control.progress = [&](double share) {
    EXPECT_EQ(++inside, 1);
    shares.push_back(share);
    --inside;
  };
  forEachRegion(300, options(), control, [](std::size_t) {});
  ASSERT_FALSE(shares.empty());
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_GE(shares.front(), 0.0);
  EXPECT_EQ(shares.back(), 1.0);
}

INSTANTIATE_TEST_SUITE_P(Threads, ForEachRegion, ::testing::Values(1, 2, 8));

TEST(ForEachRegionDefault, ZeroThreadsTakesAllCores) {
  std::vector<std::atomic<int>> calls(100);
  forEachRegion(100, {}, {}, [&](std::size_t i) { ++calls[i]; });
  for (const auto& call : calls) EXPECT_EQ(call, 1);
}

TEST(MeshRegions, AnyNumberOfThreadsGivesTheSameMeshes) {
  std::vector<Pslg> regions;
  for (unsigned seed = 1; seed <= 8; ++seed) regions.push_back(fractalCoast(seed, 1 + seed % 3, 2));
  for (unsigned seed = 1; seed <= 8; ++seed) regions.push_back(starPolygon(seed, 30));
  std::vector<std::uint64_t> first;
  for (const int threads : {1, 2, 8}) {
    std::vector<std::uint64_t> digests(regions.size());
    forEachRegion(regions.size(), {.threads = threads}, {},
                  [&](std::size_t i) { digests[i] = digestOf(meshRegion(regions[i], {}).mesh); });
    if (first.empty()) first = digests;
    EXPECT_EQ(digests, first) << threads << " threads";
  }
}

TEST(MeshRegion, IsTriangulateRefineAndCoarsen) {
  const Pslg pslg = fractalCoast(3, 2, 3);
  for (const bool coarsens : {false, true}) {
    const MeshOptions options{.refine = {.min_angle_deg = 34.0}, .coarsen = coarsens};
    const MeshedRegion region = meshRegion(pslg, options);
    TriMesh mesh = constrainedDelaunay(pslg);
    RefineStats stats = refine(mesh, pslg, options.refine);
    if (coarsens) coarsen(mesh, pslg, options.refine);
    EXPECT_EQ(digestOf(region.mesh), digestOf(mesh));
    expectValidMesh(region.mesh, pslg, {.min_angle_deg = 34.0});
    EXPECT_EQ(region.stats.steiner_points, mesh.points.size() - pslg.points.size());
    EXPECT_EQ(region.stats.by_type, stats.by_type);
    EXPECT_TRUE(region.stats.unresolved.empty());
    EXPECT_EQ(wrongBoundViolations(region.mesh, pslg, options.refine, {}), "");
    EXPECT_EQ(region.stats.merges > 0, coarsens);
    EXPECT_GE(region.seconds.refine, 0.0);
  }
}

// A coast with an upper bound on edge length, large enough to be cut and to have lattice cores.
class CappedRegion : public ::testing::TestWithParam<double> {
 protected:
  const Pslg pslg_ = fractalCoast(5, 3, 4);
  MeshOptions options() const { return {.refine = {.min_angle_deg = GetParam(), .size_max = 0.006}}; }
};

TEST_P(CappedRegion, HoldsTheBoundsWithFewTriangles) {
  const MeshedRegion region = meshRegion(pslg_, options());
  EXPECT_GT(region.pieces, 1u);
  EXPECT_TRUE(region.stats.unresolved.empty());
  EXPECT_EQ(region.mesh.input_vertices, pslg_.points.size());
  expectValidMesh(region.mesh, pslg_, {.min_angle_deg = GetParam()});
  EXPECT_EQ(wrongBoundViolations(region.mesh, pslg_, options().refine, {}), "");
  double area = 0.0;
  std::size_t equilateral = 0;
  for (const Triangle& t : region.mesh.triangles) {
    const Point &a = region.mesh.point(t.v[0]), &b = region.mesh.point(t.v[1]), &c = region.mesh.point(t.v[2]);
    const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
    EXPECT_LE(longest, 0.006);
    equilateral += std::min({distance(a, b), distance(b, c), distance(c, a)}) > longest * (1.0 - 1e-9);
    area += 0.5 * cross(b - a, c - a);
  }
  EXPECT_GT(equilateral, region.mesh.triangles.size() / 2);
  // Refinement alone takes 1.5 to 1.6 times as many triangles as equilateral ones that fill the domain.
  EXPECT_LT(static_cast<double>(region.mesh.triangles.size()), 1.5 * area / (0.4330127 * 0.006 * 0.006));
}

TEST_P(CappedRegion, ThreadsChangeNoBit) {
  std::vector<std::uint64_t> digests;
  for (const int threads : {1, 2, 3})
    withThreads({.threads = threads}, [&] { digests.push_back(digestOf(meshRegion(pslg_, options()).mesh)); });
  EXPECT_EQ(digests, std::vector<std::uint64_t>(3, digests.front()));
}

TEST_P(CappedRegion, KeepsToTheBudgetOfVertices) {
  MeshOptions few = options();
  few.refine.max_vertices = 30000;
  const MeshedRegion region = meshRegion(pslg_, few);
  EXPECT_TRUE(region.stats.budget_reached);
  EXPECT_LE(region.mesh.points.size(), 30000u);
}

// Without enough vertices triangles are bad everywhere: where cores were inserted, nothing is refined any more.
TEST_P(CappedRegion, CutShortIsNotMendedBesideCores) {
  MeshOptions few = options();
  few.refine.size_max = 0.01;
  // Enough for the lattice, but not for refinement around it.
  few.refine.max_vertices = meshRegion(pslg_, few).mesh.points.size() * 97 / 100;
  ASSERT_FALSE(layLattices(constrainedDelaunay(pslg_), {.size_max = few.refine.size_max,
                                                        .min_angle_deg = GetParam(),
                                                        .most_places = few.refine.max_vertices - pslg_.points.size()})
                   .empty());
  const MeshedRegion region = meshRegion(pslg_, few);
  ASSERT_TRUE(region.stats.budget_reached);
  std::vector<std::string_view> stages;
  for (const Stage& stage : region.log.stages) stages.push_back(stage.name);
  const auto coarsened = std::ranges::find(stages.rbegin(), stages.rend(), "coarsen").base();
  ASSERT_NE(coarsened, stages.begin());
  EXPECT_EQ(std::ranges::count(coarsened, stages.end(), "refine"), 0);
}

INSTANTIATE_TEST_SUITE_P(Angles, CappedRegion, ::testing::Values(28.0, 33.0, 40.0),
                         [](const auto& named) { return std::to_string(static_cast<int>(named.param)); });

// A basin with long thin islands that wind: more than 300,000 triangles beside the cores, which wait for their
// insertion if they are bad.
Pslg basinWithIslands() {
  constexpr int kIslands = 9, kCorners = 60;
  constexpr double kApart = 0.03;
  Pslg pslg;
  const auto addRing = [&pslg](const std::vector<Point>& ring) {
    const auto first = static_cast<VertexId>(pslg.points.size()), count = static_cast<VertexId>(ring.size());
    for (VertexId i = 0; i < count; ++i) pslg.segments.push_back({first + i, first + (i + 1) % count});
    pslg.points.insert(pslg.points.end(), ring.begin(), ring.end());
  };
  addRing({{0.0, 0.0}, {1.0, 0.0}, {1.0, (kIslands + 1) * kApart}, {0.0, (kIslands + 1) * kApart}});
  for (int k = 1; k <= kIslands; ++k) {
    std::vector<Point> lower, upper;
    for (int i = 0; i < kCorners; ++i) {
      const double x = 0.03 + 0.94 * i / (kCorners - 1), y = k * kApart + 0.004 * std::sin(5.0 * k + 0.9 * i);
      lower.push_back({x, y});
      upper.push_back({x, y + 0.002});
    }
    lower.insert(lower.end(), upper.rbegin(), upper.rend());
    addRing(lower);
    pslg.holes.push_back({0.5 * (lower[0].x + lower[1].x), 0.5 * (lower[0].y + lower[1].y) + 0.001});
  }
  return pslg;
}

TEST(MeshRegion, NothingIsLeftBadBesideManyCores) {
  const Pslg pslg = basinWithIslands();
  const RefineOptions bounds{.min_angle_deg = 33.0, .size_max = 0.001};
  std::vector<std::uint64_t> digests;
  for (const int threads : {1, 3}) {
    withThreads({.threads = threads}, [&] {
      const MeshedRegion region = meshRegion(pslg, {.refine = bounds});
      if (digests.empty()) {
        EXPECT_EQ(wrongBoundViolations(region.mesh, pslg, bounds, region.stats.unresolved), "");
      }
      EXPECT_TRUE(region.stats.unresolved.empty());
      digests.push_back(digestOf(region.mesh));
    });
  }
  EXPECT_EQ(digests[0], digests[1]);
}

TEST(MeshRegion, WhatFallsShortIsListedOnce) {
  // An infeasible bound: violations after coarsening replace those after refinement.
  const Pslg pslg = fractalCoast(3, 1, 1);
  const MeshedRegion region = meshRegion(pslg, {.refine = {.min_angle_deg = 45.0}});
  ASSERT_FALSE(region.stats.unresolved.empty());
  std::set<std::pair<double, double>> places;
  for (const BoundViolation& s : region.stats.unresolved) places.insert({s.place.x, s.place.y});
  EXPECT_EQ(places.size(), region.stats.unresolved.size());
  const auto defects = checkMesh(region.mesh, &pslg, {.min_angle_deg = 45.0});
  EXPECT_LE(defects.size(), region.stats.unresolved.size());
  EXPECT_EQ(wrongBoundViolations(region.mesh, pslg, {.min_angle_deg = 45.0}, region.stats.unresolved), "");
}

TEST(MeshRegion, BadInputAndCancellationComeThrough) {
  Pslg bad = squarePslg();
  bad.points.push_back(bad.points[0]);
  EXPECT_THROW(meshRegion(bad, {}), BadPslg);
  EXPECT_THROW(forEachRegion(4, {.threads = 2}, {}, [&](std::size_t) { meshRegion(bad, {}); }), BadPslg);
  RunControl control;
  control.cancelled = [] { return true; };
  EXPECT_THROW(meshRegion(fractalCoast(1, 4, 3), {}, control), Cancelled);
}

}  // namespace
}  // namespace coastmesh
