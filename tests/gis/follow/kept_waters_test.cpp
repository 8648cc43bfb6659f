#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "gis/coast/segment_tags.hpp"
#include "gis/follow/coast_follow.hpp"
#include "tests/support/followed_coasts.hpp"

namespace coastmesh {
namespace {

TEST(FollowSizes, OfWaterThatIsCutApartWhatIsAskedForStays) {
  const auto followed = [](KeepWater keep, bool open_to_the_east) {
    Domain domain = twoLakes(0.6);
    for (const VertexId v : {0u, 11u, 10u})
      domain.pslg.points[v].x -= v == 10 ? 0.0 : 5.0;  // the western one is larger
    domain.input_points = domain.pslg.points;
    if (open_to_the_east) domain.pslg.segments[5].tag = kOpenTag;
    CleanReport report;
    Domain coarse = followSizes(std::move(domain), ConstantSize(2.0), {.keep = keep}, oneFeature(), report);
    addWaterNotes(report, {.keep = keep});
    const std::vector<std::string>& texts = keep == KeepWater::All ? report.notes : report.warnings;
    EXPECT_EQ(texts.size(), 1u);
    EXPECT_NE(texts.front().find("behind water 0.6 wide at ("), std::string::npos) << texts.front();
    EXPECT_NE(texts.front().find("--passages"), std::string::npos) << texts.front();
    EXPECT_EQ(countOf(report, EditKind::CutOffWater), keep == KeepWater::All ? 0u : 1u);
    return coarse;
  };
  EXPECT_EQ(parts(followed(KeepWater::All, true)), 2u);
  const Domain largest = followed(KeepWater::Largest, true), open = followed(KeepWater::Open, true),
               none_open = followed(KeepWater::Open, false);
  for (const Point& p : largest.pslg.points) EXPECT_LT(p.x, 25.0);
  for (const Point& p : open.pslg.points) EXPECT_GT(p.x, 25.0);
  for (const Point& p : none_open.pslg.points) EXPECT_LT(p.x, 25.0);
}

// A large lake, and beside it a lake with an open boundary.
TEST(FollowSizes, AFrameThatGrazesAnotherWaterDoesNotDropTheOneThatIsMeant) {
  for (const double side : {12.0, 20.0}) {
    Domain domain;
    addShore(domain, {{0, 0}, {40, 0}, {40, 40}, {0, 40}});
    addShore(domain, {{50, 0}, {50 + side, 0}, {50 + side, side}, {50, side}});
    domain.pslg.segments[5].tag = kOpenTag;
    for (const KeepWater keep : {KeepWater::Modelled, KeepWater::Open}) {
      CleanReport report;
      const Domain coarse = followSizes(Domain(domain), ConstantSize(2.0), {.keep = keep}, oneFeature(), report);
      const bool grazed = side == 12.0 && keep == KeepWater::Modelled;  // areas: 144 of 1744, 400 of 2000
      for (const Point& p : coarse.pslg.points) EXPECT_EQ(p.x < 45.0, grazed) << side;
      addWaterNotes(report, {.keep = keep});
      ASSERT_EQ(report.warnings.size(), 1u);
      EXPECT_NE(report.warnings[0].find(grazed ? "144 (8.3 %) of the water is left out" : "1.6e+03"), std::string::npos)
          << report.warnings[0];
      EXPECT_EQ(report.warnings[0].find("which has an open boundary") != std::string::npos, grazed);
      EXPECT_NE(report.warnings[0].find("without a connection in the data"), std::string::npos);
    }
  }
}

// Two lakes of two features: each feature is judged separately, whichever comes first.
TEST(FollowSizes, TheLakeOfAnotherFeatureStays) {
  for (const bool large_first : {true, false}) {
    Domain domain;
    addShore(domain, {{0, 0}, {40, 0}, {40, 40}, {0, 40}});
    addShore(domain, {{50, 0}, {62, 0}, {62, 12}, {50, 12}});
    for (SegmentId s = 0; s < 8; ++s) domain.pslg.segments[s].left = (s < 4) == large_first ? 0 : 1;
    Coastline coast = oneFeature();
    coast.features.emplace_back();
    for (const KeepWater keep : {KeepWater::Modelled, KeepWater::Open, KeepWater::Largest}) {
      CleanReport report;
      const Domain coarse = followSizes(Domain(domain), ConstantSize(2.0), {.keep = keep}, coast, report);
      EXPECT_EQ(parts(coarse), 2u);
      EXPECT_EQ(countOf(report, EditKind::CutOffWater), 0u);
    }
  }
}

// The same with open boundaries at both: the small one is dropped, unless all waters with openings are kept.
TEST(FollowSizes, AFrameThatGrazesAWaterBesideTheSeaLeavesOneWater) {
  Domain domain;
  addShore(domain, {{0, 0}, {40, 0}, {40, 40}, {0, 40}});
  addShore(domain, {{50, 0}, {62, 0}, {62, 12}, {50, 12}});
  for (const SegmentId s : {3u, 5u}) domain.pslg.segments[s].tag = kOpenTag;
  for (const KeepWater keep : {KeepWater::Modelled, KeepWater::Open}) {
    CleanReport report;
    EXPECT_EQ(parts(followSizes(Domain(domain), ConstantSize(2.0), {.keep = keep}, oneFeature(), report)),
              keep == KeepWater::Open ? 2u : 1u);
    EXPECT_EQ(countOf(report, EditKind::CutOffWater), keep == KeepWater::Open ? 0u : 1u);
  }
}

// Two waters, each with an open boundary, and a strait between them narrower than an element: it is widened, or
// reported if it is far narrower.
TEST(FollowSizes, WatersThatAreBothKeptAreJoinedOrNamed) {
  for (const double width : {0.6, 1.2}) {
    for (const KeepWater keep : {KeepWater::All, KeepWater::Modelled, KeepWater::Open}) {
      Domain domain = twoLakes(width);
      for (const SegmentId s : {5u, 11u}) domain.pslg.segments[s].tag = kOpenTag;
      CleanReport report;
      const Domain coarse = followSizes(std::move(domain), ConstantSize(2.0), {.keep = keep}, oneFeature(), report);
      EXPECT_EQ(parts(coarse), width < 1.0 ? 2u : 1u);
      EXPECT_EQ(countOf(report, EditKind::CutOffWater), 0u);
      addWaterNotes(report, {.keep = keep});
      if (width > 1.0) {
        EXPECT_TRUE(report.warnings.empty()) << report.warnings[0];
        continue;
      }
      ASSERT_EQ(report.warnings.size(), 1u);
      EXPECT_NE(report.warnings[0].find("the water is meshed in 2 parts without a connection"), std::string::npos);
      EXPECT_NE(report.warnings[0].find("which has an open boundary, behind water 0.6 wide at ("), std::string::npos);
      EXPECT_NE(report.warnings[0].find("--keep-water largest"), std::string::npos);
    }
  }
}

// An opening too short for an element would disappear, so it does not keep its water.
TEST(FollowSizes, AShortOpeningKeepsNoWater) {
  Domain domain = twoLakes(0.6);
  domain.pslg.segments[5].tag = kOpenTag;  // the eastern side of the eastern lake
  const auto count = static_cast<VertexId>(domain.pslg.points.size());
  domain.pslg.points.push_back({0, 10.3});
  domain.pslg.points.push_back({0, 9.7});
  domain.pslg.segments[11].b = count;
  domain.pslg.segments.push_back({count, count + 1, kOpenTag, 0, kOutside});
  domain.pslg.segments.push_back({count + 1, 0, 0, 0, kOutside});
  domain.input_points = domain.pslg.points;
  CleanReport report;
  const Domain coarse =
      followSizes(std::move(domain), ConstantSize(2.0), {.keep = KeepWater::Open}, oneFeature(), report);
  EXPECT_EQ(countOf(report, EditKind::CutOffWater), 1u);
  for (const Point& p : coarse.pslg.points) EXPECT_GT(p.x, 25.0);
}

}  // namespace
}  // namespace coastmesh
