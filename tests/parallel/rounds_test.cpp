#include "parallel/rounds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "core/metric.hpp"
#include "core/refine/bound_violations.hpp"
#include "core/triangulate/delaunay.hpp"
#include "core/triangulate/label_regions.hpp"
#include "parallel/workers.hpp"
#include "tests/support/excused_twin.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/pslgs.hpp"
#include "tests/support/size_figures.hpp"

namespace coastmesh {
namespace {

struct Case {
  std::string name;
  Pslg pslg;
  RefineOptions options;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

// Large enough to be cut into several pieces.
std::vector<Case> cases() {
  std::vector<Case> all;
  all.push_back({"Coast", fractalCoast(1, 6, 8), {.min_angle_deg = 30.0}});
  all.push_back({"CoastWithSize", fractalCoast(2, 3, 3), {.min_angle_deg = 30.0, .size_max = 0.01}});
  all.push_back({"Square", squarePslg(), {.min_angle_deg = 33.0, .size_max = 0.012}});
  all.push_back({"TwoRegions", twoRegions(), {.min_angle_deg = 28.0, .size_max = 0.01}});
#ifdef COASTMESH_SANITIZED
  all = {all.back()};  // a run takes ten times as long
#endif
  return all;
}

struct Meshed {
  TriMesh mesh;
  RoundsReport refined, coarsened;
};

VertexNotes notesOf(const TriMesh& mesh, const Case& c) { return noteInput(mesh, boundOf(c.options)); }

Meshed runInRounds(const Case& c, int threads) {
  Meshed run;
  withThreads({.threads = threads}, [&] {
    run.mesh = constrainedDelaunay(c.pslg);
    RoundsWorkspace workspace;
    run.refined = refineInRounds(run.mesh, c.pslg, c.options, notesOf(run.mesh, c), {}, workspace);
    run.coarsened = coarsenInRounds(run.mesh, c.pslg, c.options, {}, workspace);
  });
  return run;
}

// Regions are labelled after all rounds, not by them.
void expectValid(TriMesh mesh, const Pslg& pslg, const CheckOptions& options = {}) {
  labelRegions(mesh, pslg);
  expectValidMesh(mesh, pslg, options);
}

class InRounds : public ::testing::TestWithParam<Case> {};

TEST_P(InRounds, IsOneMeshWithoutASeam) {
  const Case& c = GetParam();
  const Meshed run = runInRounds(c, 2);
  EXPECT_GT(run.refined.pieces, 1u) << "nothing was cut";
  EXPECT_GT(run.coarsened.pieces, 1u);
  expectValid(run.mesh, c.pslg, {.min_angle_deg = c.options.min_angle_deg});
  EXPECT_TRUE(findBoundViolations(run.mesh, c.options).empty());
  EXPECT_EQ(wrongBoundViolations(run.mesh, c.pslg, c.options, {}), "");
}

TEST_P(InRounds, ThreadsChangeNoBit) {
  const Case& c = GetParam();
  const std::uint64_t digest = digestOf(runInRounds(c, 1).mesh);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(digestOf(runInRounds(c, threads).mesh), digest) << threads;
}

TEST_P(InRounds, HasAsManyVerticesAsOnePiece) {
  const Case& c = GetParam();
  const Meshed run = runInRounds(c, 2);
  TriMesh whole = constrainedDelaunay(c.pslg);
  refine(whole, c.pslg, c.options);
  coarsen(whole, c.pslg, c.options);
  const auto count = static_cast<double>(whole.points.size());
  EXPECT_NEAR(static_cast<double>(run.mesh.points.size()), count, 0.03 * count);
}

TEST_P(InRounds, KeepsToTheBudgetOfVertices) {
  Case c = GetParam();
  const std::size_t wanted = runInRounds(c, 2).mesh.points.size();
  c.options.max_vertices = c.pslg.points.size() + (wanted - c.pslg.points.size()) / 2;
  std::uint64_t digest = 0;
  for (const int threads : {1, 3}) {
    TriMesh mesh = constrainedDelaunay(c.pslg);
    RoundsReport report;
    RoundsWorkspace workspace;
    withThreads({.threads = threads},
                [&] { report = refineInRounds(mesh, c.pslg, c.options, notesOf(mesh, c), {}, workspace); });
    EXPECT_TRUE(report.stats.budget_reached);
    EXPECT_LE(mesh.points.size(), c.options.max_vertices);
    expectValid(mesh, c.pslg);
    if (threads == 1) digest = digestOf(mesh);
    EXPECT_EQ(digestOf(mesh), digest);
  }
}

// Pieces near the origin, where lengths are small, need more vertices than their shares of the budget.
TEST(RefineInRounds, UsesTheBudgetWhereverItIsNeeded) {
  const SizeOf size(0.002, 1.0, [](const Point& p) { return std::min(1.0, 0.002 + 0.03 * distance(p, {0.0, 0.0})); });
  Case c{"GradedCoast", fractalCoast(1, 6, 5), {.min_angle_deg = 33.0, .size = &size}};
  const auto refined = [&](TriMesh& mesh) {
    RoundsWorkspace workspace;
    RoundsReport report;
    mesh = constrainedDelaunay(c.pslg);
    withThreads({.threads = 2},
                [&] { report = refineInRounds(mesh, c.pslg, c.options, notesOf(mesh, c), {}, workspace); });
    return report;
  };
  TriMesh mesh;
  refined(mesh);
  const auto needed = static_cast<double>(mesh.points.size());
  for (const double share : {0.99, 0.9995, 1.0, 1.0002, 1.03}) {
    c.options.max_vertices = static_cast<std::uint64_t>(share * needed);
    const RoundsReport report = refined(mesh);
    EXPECT_LE(mesh.points.size(), c.options.max_vertices);
    EXPECT_TRUE(report.stats.budget_reached || findBoundViolations(mesh, c.options).empty()) << share;
    EXPECT_FALSE(share > 1.02 && report.stats.budget_reached);
  }
}

TEST_P(InRounds, EndsWhereTheBoundIsOutOfReach) {
  Case c = GetParam();
  c.options.min_angle_deg = 44.5;
  c.options.max_vertices = 20000;
  const Meshed run = runInRounds(c, 2);
  expectValid(run.mesh, c.pslg);
}

TEST_P(InRounds, WritesDownItsWork) {
  const Meshed run = runInRounds(GetParam(), 2);
  for (const WorkLog* log : {&run.refined.log, &run.coarsened.log}) {
    EXPECT_GT(log->criticalPath(), 0.0);
    EXPECT_LE(log->criticalPath(), log->work());
    EXPECT_LE(log->timeOn(64), log->timeOn(2));
    EXPECT_NEAR(log->timeOn(1), log->work(), 1e-9 * log->work());
  }
}

TEST_P(InRounds, ProgressRises) {
  const Case& c = GetParam();
  std::vector<double> shares;
  const RunControl control{{}, [&](double share) { shares.push_back(share); }};
  TriMesh mesh = constrainedDelaunay(c.pslg);
  RoundsWorkspace workspace;
  withThreads({.threads = 2}, [&] { refineInRounds(mesh, c.pslg, c.options, notesOf(mesh, c), control, workspace); });
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_LT(shares.front(), 0.2);
  EXPECT_GT(shares.back(), 0.5);
  EXPECT_LE(shares.back(), 1.0);
  EXPECT_GT(std::set(shares.begin(), shares.end()).size(), 5u);
}

TEST_P(InRounds, CanBeCancelled) {
  const Case& c = GetParam();
  for (const int most : {0, 3, 20}) {
    int asked = 0;
    RunControl control;
    control.cancelled = [&] { return asked++ >= most; };
    TriMesh mesh = constrainedDelaunay(c.pslg);
    RoundsWorkspace workspace;
    const auto run = [&] { refineInRounds(mesh, c.pslg, c.options, notesOf(mesh, c), control, workspace); };
    withThreads({.threads = 1}, [&] { EXPECT_THROW(run(), Cancelled) << most; });
  }
}

INSTANTIATE_TEST_SUITE_P(All, InRounds, ::testing::ValuesIn(cases()),
                         [](const auto& param_info) { return param_info.param.name; });

}  // namespace
}  // namespace coastmesh
