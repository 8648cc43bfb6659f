#include <gtest/gtest.h>

#include <iterator>
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
    Domain coarse =
        followSizes(std::move(domain), ConstantSize(2.0), {.strait_min = 0.4, .keep = keep}, oneFeature(), report);
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
      const Domain coarse =
          followSizes(Domain(domain), ConstantSize(2.0), {.strait_min = 0.4, .keep = keep}, oneFeature(), report);
      const bool grazed = side == 12.0 && keep == KeepWater::Modelled;  // areas: 144 of 1744, 400 of 2000
      for (const Point& p : coarse.pslg.points) EXPECT_EQ(p.x < 45.0, grazed) << side;
      addWaterNotes(report, {.keep = keep});
      ASSERT_EQ(report.warnings.size(), 1u);
      EXPECT_NE(report.warnings[0].find(grazed ? "144 (8.3 %) of the water is left out" : "1600"), std::string::npos)
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
      const Domain coarse =
          followSizes(Domain(domain), ConstantSize(2.0), {.strait_min = 0.4, .keep = keep}, coast, report);
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
    EXPECT_EQ(
        parts(followSizes(Domain(domain), ConstantSize(2.0), {.strait_min = 0.4, .keep = keep}, oneFeature(), report)),
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
      const Domain coarse =
          followSizes(std::move(domain), ConstantSize(2.0), {.strait_min = 0.4, .keep = keep}, oneFeature(), report);
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
  const Domain coarse = followSizes(std::move(domain), ConstantSize(2.0), {.strait_min = 0.4, .keep = KeepWater::Open},
                                    oneFeature(), report);
  EXPECT_EQ(countOf(report, EditKind::CutOffWater), 1u);
  for (const Point& p : coarse.pslg.points) EXPECT_GT(p.x, 25.0);
}

// Two seas of side 20 with a common border in the middle, of two features or of one, and behind a strait `width` wide
// in the east a bay of side 6.
Domain twoSeas(double width, bool of_two_features) {
  const double low = 10.0 - width / 2, high = 10.0 + width / 2;
  Domain domain;
  addShore(domain, {{0, 0},
                    {20, 0},
                    {40, 0},
                    {40, low},
                    {42, low},
                    {42, 7},
                    {48, 7},
                    {48, 13},
                    {42, 13},
                    {42, high},
                    {40, high},
                    {40, 20},
                    {20, 20},
                    {0, 20}});
  if (!of_two_features) return domain;
  for (SegmentId s = 1; s < 12; ++s) domain.pslg.segments[s].left = 1;
  domain.pslg.segments.push_back({1, 12, 0, 0, 1});
  return domain;
}

Coastline twoFeatures() {
  Coastline coast = oneFeature();
  coast.features.emplace_back();
  return coast;
}

// Features with a common border are one water, so what is cut off from both is no water of its own.
TEST(FollowSizes, ABayOfOneOfTwoFeaturesWithACommonBorderIsLeftOutAsThatOfOneFeature) {
  for (const bool of_two : {true, false}) {
    const auto outcome = [&](KeepWater keep, bool is_open, CleanReport& report) {
      Domain domain = twoSeas(0.4, of_two);
      if (is_open) domain.pslg.segments[13].tag = kOpenTag;  // the western side
      const Domain coarse =
          followSizes(std::move(domain), ConstantSize(2.0), {.strait_min = 0.4, .keep = keep}, twoFeatures(), report);
      addWaterNotes(report, {.keep = keep});
      return parts(coarse);
    };
    CleanReport largest, open, all;
    EXPECT_EQ(outcome(KeepWater::Largest, false, largest), 1u);
    EXPECT_EQ(countOf(largest, EditKind::CutOffWater), 1u);
    EXPECT_EQ(outcome(KeepWater::Modelled, true, open), 1u);
    EXPECT_EQ(countOf(open, EditKind::CutOffWater), 1u);
    EXPECT_EQ(outcome(KeepWater::All, false, all), 2u);
    ASSERT_EQ(all.warnings.size() + all.notes.size(), 1u);
    const std::string text = all.warnings.empty() ? all.notes[0] : all.warnings[0];
    EXPECT_NE(text.find("behind water 0.4 wide at ("), std::string::npos) << text;
  }
}

TEST(FollowSizes, AStraitToABayOfOneOfTwoFeaturesWithACommonBorderIsWidened) {
  for (const bool of_two : {true, false}) {
    CleanReport report;
    const Domain coarse =
        followSizes(twoSeas(1.8, of_two), ConstantSize(2.0), {.strait_min = 0.4}, twoFeatures(), report);
    EXPECT_EQ(parts(coarse), 1u);
    EXPECT_EQ(countOf(report, EditKind::CutOffWater), 0u);
    EXPECT_EQ(countOf(report, EditKind::WidenedPassage), 1u);
    EXPECT_EQ(countOf(report, EditKind::MovedPoint), 0u);  // widening adds a tenth of a percent
    addWaterNotes(report, {});
    ASSERT_EQ(report.notes.size(), 1u);
    EXPECT_NE(report.notes[0].find("the largest of 1 water: ("), std::string::npos) << report.notes[0];
  }
}

// A border that runs across the sea with many vertices, much closer to one another than elements.
TEST(FollowSizes, AWayToTheMainWaterCrossesABorderOfFeatures) {
  Domain domain = twoSeas(1.2, true);
  domain.pslg.segments.pop_back();
  VertexId last = 1;
  for (double y = 0.25; y < 20.0; y += 0.25) {
    domain.pslg.points.push_back({20, y});
    const auto made = static_cast<VertexId>(domain.pslg.points.size() - 1);
    domain.pslg.segments.push_back({last, made, 0, 0, 1});
    last = made;
  }
  domain.pslg.segments.push_back({last, 12, 0, 0, 1});
  for (VertexId v : {0u, 13u}) domain.pslg.points[v].x = -5.0;  // the western sea is larger
  domain.input_points = domain.pslg.points;
  CleanReport report;
  EXPECT_EQ(parts(followSizes(std::move(domain), ConstantSize(2.0), {.strait_min = 0.4}, twoFeatures(), report)), 1u);
  EXPECT_EQ(countOf(report, EditKind::WidenedPassage), 1u);
}

// Two lakes of two features with their border in the middle of the strait between them, straight or with vertices.
TEST(FollowSizes, ABorderInAStraitLeavesNoPondThere) {
  for (const double width : {0.6, 1.2}) {
    for (const int vertices : {0, 3}) {
      const Domain one = twoLakes(width);
      Domain domain = one;
      const double low = 10.0 - width / 2, high = 10.0 + width / 2;
      domain.pslg.points.insert(domain.pslg.points.end(), {{25, low}, {25, high}});
      domain.pslg.segments.clear();
      const VertexId ring[] = {0, 1, 2, 12, 3, 4, 5, 6, 7, 8, 13, 9, 10, 11};
      for (std::size_t i = 0; i < std::size(ring); ++i)
        domain.pslg.segments.push_back(
            {ring[i], ring[(i + 1) % std::size(ring)], 0, i >= 3 && i < 10 ? 1 : 0, kOutside});
      VertexId last = 12;
      for (int i = 1; i <= vertices; ++i) {
        domain.pslg.points.push_back({25, low + i * width / (vertices + 1)});
        const auto made = static_cast<VertexId>(domain.pslg.points.size() - 1);
        domain.pslg.segments.push_back({last, made, 0, 0, 1});
        last = made;
      }
      domain.pslg.segments.push_back({last, 13, 0, 0, 1});
      domain.input_points = domain.pslg.points;
      CleanReport report;
      const Domain coarse =
          followSizes(std::move(domain), ConstantSize(2.0), {.strait_min = 0.4}, twoFeatures(), report);
      EXPECT_EQ(parts(coarse), width < 1.0 ? 2u : 1u) << vertices;
      EXPECT_EQ(report.waters.apart.count + report.waters.cut_off.count, width < 1.0 ? 1u : 0u) << vertices;
    }
  }
}

}  // namespace
}  // namespace coastmesh
