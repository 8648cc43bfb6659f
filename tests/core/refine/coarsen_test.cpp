#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

#include "core/metric.hpp"
#include "core/quality.hpp"
#include "core/refine/refine.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/excused_twin.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/mesh_figures.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

struct BothRuns {
  TriMesh refined;
  TriMesh coarsened;
  RefineStats refine_stats;
  RefineStats coarsen_stats;
};

BothRuns runBoth(const Pslg& pslg, RefineOptions options) {
  // Stops runs that do not terminate; refine_test checks termination.
  options.max_vertices = std::min<std::uint64_t>(options.max_vertices, 20'000);
  BothRuns run;
  run.refined = constrainedDelaunay(pslg);
  run.refine_stats = refine(run.refined, pslg, options);
  run.coarsened = run.refined;
  run.coarsen_stats = coarsen(run.coarsened, pslg, options);
  return run;
}

// The total edge length of each segment, summed over both sides.
std::vector<double> lengthsOfSegments(const TriMesh& mesh, std::size_t segments) {
  std::vector<double> lengths(segments, 0.0);
  for (TriId t = 0; t < mesh.triangles.size(); ++t)
    for (unsigned i = 0; i < 3; ++i)
      if (const EdgeRef e = edgeRef(t, i); mesh.segment(e) != kNone)
        lengths[mesh.segment(e)] += distance(mesh.points[mesh.origin(e)], mesh.points[mesh.target(e)]);
  return lengths;
}

class CoarsenOf : public ::testing::TestWithParam<NamedPslg> {
 protected:
  void expectCoarsened(const RefineOptions& options) {
    const Pslg& pslg = GetParam().pslg;
    const BothRuns run = runBoth(pslg, options);
    // Fewer vertices, the same domain.
    expectValidMesh(run.coarsened, pslg);
    EXPECT_LE(run.coarsened.points.size(), run.refined.points.size());
    const std::uint64_t inserted = std::accumulate(run.coarsen_stats.by_type.begin(), run.coarsen_stats.by_type.end(),
                                                   run.coarsen_stats.segment_splits);
    EXPECT_EQ(run.coarsened.points.size() + run.coarsen_stats.removals + run.coarsen_stats.merges,
              run.refined.points.size() + inserted);
    const auto before = areasByRegion(run.refined), after = areasByRegion(run.coarsened);
    ASSERT_EQ(after.size(), before.size());
    for (const auto& [region, area] : before) EXPECT_NEAR(after.at(region), area, 1e-9 * area) << "region " << region;
    // Segments stay complete, on both sides.
    const auto whole = lengthsOfSegments(run.refined, pslg.segments.size());
    const auto kept = lengthsOfSegments(run.coarsened, pslg.segments.size());
    for (std::size_t s = 0; s < whole.size(); ++s) EXPECT_NEAR(kept[s], whole[s], 1e-12 * whole[s]) << "segment " << s;
    // No more bound violations than before.
    EXPECT_LE(run.coarsen_stats.unresolved.size(), run.refine_stats.unresolved.size());
    const auto defects = checkMesh(run.coarsened, &pslg,
                                   {.min_angle_deg = options.min_angle_deg, .max_angle_deg = options.max_angle_deg});
    EXPECT_LE(defects.size(), run.coarsen_stats.unresolved.size());
    EXPECT_EQ(wrongBoundViolations(run.coarsened, pslg, options, run.coarsen_stats.unresolved), "");
    // The result is reproducible.
    const BothRuns again = runBoth(pslg, options);
    EXPECT_EQ(digestOf(again.coarsened), digestOf(run.coarsened));
  }
};

TEST_P(CoarsenOf, AnyAngle) {
  for (const double angle : {20.0, 30.0, 33.0, 38.0}) {
    SCOPED_TRACE(angle);
    expectCoarsened({.min_angle_deg = angle});
  }
}

TEST_P(CoarsenOf, AnyAlgorithm) {
  for (const Algorithm algorithm : {Algorithm::Circumcenter, Algorithm::Offcenter, Algorithm::Optimal}) {
    SCOPED_TRACE(static_cast<unsigned>(algorithm));
    expectCoarsened({.min_angle_deg = 30.0, .algorithm = algorithm});
  }
}

TEST_P(CoarsenOf, LargestAngleAndSize) {
  expectCoarsened({.min_angle_deg = 30.0, .max_angle_deg = 100.0});
  expectCoarsened({.min_angle_deg = 25.0, .size_max = 0.2});
}

TEST_P(CoarsenOf, MeshOfABudgetThatWasReached) {
  expectCoarsened({.min_angle_deg = 33.0, .max_vertices = GetParam().pslg.points.size() + 10});
}

INSTANTIATE_TEST_SUITE_P(All, CoarsenOf, ::testing::ValuesIn(assortedPslgs()),
                         [](const auto& param_info) { return nameOf(param_info.param); });

TEST(Coarsen, TakesOutWhatTheBoundDoesNotNeed) {
  // Refined for 34 degrees; 20 need far fewer.
  const Pslg pslg = fractalCoast(6, 3, 3);
  TriMesh mesh = constrainedDelaunay(pslg);
  refine(mesh, pslg, {.min_angle_deg = 34.0});
  const std::size_t before = mesh.points.size() - pslg.points.size();
  coarsen(mesh, pslg, {.min_angle_deg = 20.0});
  expectValidMesh(mesh, pslg, {.min_angle_deg = 20.0});
  EXPECT_LT(mesh.points.size() - pslg.points.size(), before / 2);
}

TEST(Coarsen, NeedlessVertexInASquareGoes) {
  const Pslg pslg = squarePslg();
  TriMesh mesh = constrainedDelaunay(pslg);
  refine(mesh, pslg, {.min_angle_deg = 30.0, .size_max = 0.3});
  ASSERT_GT(mesh.points.size(), 10u);
  coarsen(mesh, pslg, {.min_angle_deg = 30.0});
  EXPECT_EQ(mesh.points.size(), 4u) << "two triangles of 45 degrees are left";
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

TEST(Coarsen, MeshWithoutSteinerPointsStays) {
  const Pslg pslg = randomPointsInBox(2, 50);
  TriMesh mesh = constrainedDelaunay(pslg);
  const TriMesh before = mesh;
  const RefineStats stats = coarsen(mesh, pslg, {.min_angle_deg = 0.0});
  EXPECT_EQ(mesh.points, before.points);
  EXPECT_EQ(mesh.triangles.size(), before.triangles.size());
  expectValidMesh(mesh, pslg);
  EXPECT_EQ(stats.removals + stats.merges, 0u);
}

TEST(Coarsen, CancelledStopsIt) {
  const Pslg pslg = fractalCoast(4, 4, 4);
  TriMesh mesh = constrainedDelaunay(pslg);
  refine(mesh, pslg, {});
  int asked = 0;
  RunControl control;
  control.cancelled = [&] { return ++asked == 2; };
  EXPECT_THROW(coarsen(mesh, pslg, {}, control), Cancelled);
  EXPECT_EQ(asked, 2);
}

TEST(Coarsen, ProgressIsAShare) {
  const Pslg pslg = fractalCoast(4, 4, 4);
  TriMesh mesh = constrainedDelaunay(pslg);
  refine(mesh, pslg, {});
  std::vector<double> shares;
  RunControl control;
  control.progress = [&](double share) { shares.push_back(share); };
  coarsen(mesh, pslg, {}, control);
  ASSERT_GT(shares.size(), 1u);
  EXPECT_GE(std::ranges::min(shares), 0.0);
  EXPECT_LE(std::ranges::max(shares), 1.0);
}

}  // namespace
}  // namespace coastmesh
