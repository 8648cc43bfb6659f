#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/follow/coast_follow.hpp"
#include "tests/support/followed_coasts.hpp"
#include "tests/support/size_figures.hpp"

namespace coastmesh {
namespace {

// A square sea of side 20 with an open lower side of short segments.
Domain seaWithFineOpening() {
  Domain sea;
  std::vector<Point> ring;
  for (int i = 0; i < 40; ++i) ring.push_back({0.5 * i, 0.0});
  for (const Point& p : {Point{20, 0}, Point{20, 20}, Point{0, 20}}) ring.push_back(p);
  addShore(sea, ring);
  for (int i = 0; i < 40; ++i) sea.pslg.segments[static_cast<std::size_t>(i)].tag = kOpenTag;
  return sea;
}

// A lake with a fine winding shore and a fine island, and one island too small for an element.
Domain fineLake() {
  Domain lake;
  addRing(lake, {0.0, 0.0}, 100.0, 4000, false, 0.0004);
  addRing(lake, {10.0, 0.0}, 20.0, 800, true, 0.001);
  addRing(lake, {-60.0, 0.0}, 0.5, 40, true);
  return lake;
}

TEST(ThinToLeast, TakesOutWhatIsFinerAndIsKnownAfterwards) {
  const Domain lake = fineLake();
  for (const double size : {2.0, 4.0}) {
    CleanReport thinning, report, plain;
    FollowStart start;
    Domain thin = thinToLeast(Domain(lake), 2.0, {}, oneFeature(), {}, thinning, start);
    EXPECT_EQ(start.thinned_m, 2.0);
    EXPECT_LT(thin.pslg.points.size(), lake.pslg.points.size() / 5);
    EXPECT_EQ(countOf(thinning, EditKind::SmallIsland), 1u);
    // The removed island's 40 vertices count as one edit, not as simplified points.
    EXPECT_EQ(countOf(thinning, EditKind::SimplifiedPoint), lake.pslg.points.size() - thin.pslg.points.size() - 40u);
    EXPECT_NEAR(start.gained.at(0), areaOf(thin) - areaOf(lake), 1e-6 * areaOf(lake));
    const std::size_t left = thin.pslg.points.size();
    const Domain after = followSizes(std::move(thin), ConstantSize(size), {}, oneFeature(), report, {}, inOrder, start);
    const Domain at_once = followSizes(Domain(lake), ConstantSize(size), {}, oneFeature(), plain);
    EXPECT_NEAR(areaOf(after) / areaOf(lake), 1.0, 0.005);
    EXPECT_NEAR(static_cast<double>(after.pslg.points.size()) / static_cast<double>(at_once.pslg.points.size()), 1.0,
                0.25);
    EXPECT_EQ(countOf(plain, EditKind::SmallIsland), 1u);
    EXPECT_EQ(countOf(report, EditKind::SmallIsland), 0u);
    EXPECT_LT(after.pslg.points.size(), left);
  }
}

TEST(ThinToLeast, LeavesWhatIsHardlyFiner) {
  CleanReport report;
  FollowStart start;
  const Domain lake = fineLake();
  const Domain same = thinToLeast(Domain(lake), 0.2, {}, oneFeature(), {}, report, start);
  EXPECT_EQ(start.thinned_m, 0.0);
  EXPECT_EQ(same.pslg.points, lake.pslg.points);
  EXPECT_TRUE(report.edits.empty());
}

TEST(FollowSizes, LargerSizesAtOpenBoundariesMakeTheseCoarserAlone) {
  const Domain sea = seaWithFineOpening();
  const SizeOf before(0.5, 20.0, [](const Point& p) { return p.y < 1.0 ? 0.5 : 20.0; });
  const SizeOf after(4.0, 20.0, [](const Point& p) { return p.y < 1.0 ? 4.0 : 20.0; });
  // The corners belong to both, and count as shore.
  EXPECT_EQ(growthOf(sea.pslg, before, before).elsewhere, 1.0);
  EXPECT_EQ(growthOf(sea.pslg, before, after).elsewhere, 8.0);
  const SizeOf inland(0.5, 40.0, [](const Point& p) { return p.y < 10.0 ? 0.5 : 40.0; });
  EXPECT_EQ(growthOf(sea.pslg, before, inland).elsewhere, 1.0);
  EXPECT_EQ(growthOf(sea.pslg, before, inland).shore, 2.0);
  CleanReport report;
  const Domain coarse = coarsenFurther(Domain(sea), after, oneFeature(), report);
  EXPECT_LE(coarse.pslg.points.size(), 12u);
  EXPECT_EQ(countOf(report, EditKind::SimplifiedPoint), sea.pslg.points.size() - coarse.pslg.points.size());
  EXPECT_DOUBLE_EQ(areaOf(coarse), 400.0);
  double open = 0.0;
  for (const Segment& s : coarse.pslg.segments)
    if (s.tag == kOpenTag) open += distance(coarse.pslg.points[s.a], coarse.pslg.points[s.b]);
  EXPECT_DOUBLE_EQ(open, 20.0);
}

}  // namespace
}  // namespace coastmesh
