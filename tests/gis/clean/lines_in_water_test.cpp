#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gis/clean/clean.hpp"
#include "gis/coast/group_features.hpp"
#include "gis/coast/segment_tags.hpp"
#include "tests/support/gis_shapes.hpp"
#include "tests/support/pslg_check.hpp"

namespace coastmesh {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The number of segments that belong to lines of `use`.
std::ptrdiff_t segmentsOf(const Domain& domain, FeatureUse use) {
  return std::ranges::count_if(domain.pslg.segments, [&](const Segment& s) {
    return isLineTag(s.tag) && domain.lines.at(lineOfTag(s.tag)).use == use;
  });
}

// Where lines overlap, a weir takes precedence over a constraint, and a constraint over a region's border.
TEST(Constraints, OverlappingLines) {
  Feature wall = lineFeature(1, {{1, 5}, {9, 5}}), weir = lineFeature(2, {{3, 5}, {5, 5}});
  wall.use = FeatureUse::Constraint;
  weir.use = FeatureUse::Weir;
  Feature region = polygonFeature(3, square(4, 5, 4));
  region.use = FeatureUse::Region;
  const Coastline coastline = coastlineOf({polygonFeature(0, square(0, 0, 10)), wall, weir, region});
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, allMembers(coastline), Projection::plane(), {0.0}, report);
  const auto lengthOf = [&](FeatureUse use, bool border) {
    double sum = 0;
    for (const Segment& s : domain.pslg.segments) {
      if (!isLineTag(s.tag)) continue;
      const DomainLine& line = domain.lines.at(lineOfTag(s.tag));
      const Point &a = domain.pslg.points[s.a], &b = domain.pslg.points[s.b];
      if (line.use == use && line.borders_region == border) sum += std::hypot(b.x - a.x, b.y - a.y);
    }
    return sum;
  };
  EXPECT_DOUBLE_EQ(lengthOf(FeatureUse::Weir, false), 1);
  EXPECT_DOUBLE_EQ(lengthOf(FeatureUse::Weir, true), 1);
  EXPECT_DOUBLE_EQ(lengthOf(FeatureUse::Constraint, false), 3);
  EXPECT_DOUBLE_EQ(lengthOf(FeatureUse::Constraint, true), 3);
  EXPECT_DOUBLE_EQ(lengthOf(FeatureUse::Region, true), 12);
}

TEST(Constraints, LinesPointsAndRegionsInTheWater) {
  Feature wall = lineFeature(1, {{1, 1}, {3, 1}, {30, 1}}), weir = lineFeature(2, {{1, 2}, {3, 2}});
  wall.use = FeatureUse::Constraint;
  wall.points = {{50, 50}, {5, 5}, {5, 5}};  // the first is outside, and repeats are ignored
  wall.attributes = {{"Name", "wall"}};
  weir.use = FeatureUse::Weir;
  Feature region = polygonFeature(3, square(6, 6, 20));
  region.use = FeatureUse::Region;
  const Coastline coastline = coastlineOf({polygonFeature(0, square(0, 0, 10)), wall, weir, region});
  CleanReport report;
  const auto groups = groupFeatures(coastline);
  ASSERT_EQ(groups.size(), 1u);
  const Domain domain = cleanFeatures(coastline, groups[0], Projection::plane(), {0.0}, report);
  EXPECT_EQ(defectOfLabelled(domain.pslg), "vertex in no segment at 5, 5");  // requested points
  EXPECT_EQ(segmentsOf(domain, FeatureUse::Weir), 1);
  EXPECT_EQ(segmentsOf(domain, FeatureUse::Constraint), 2);
  EXPECT_EQ(segmentsOf(domain, FeatureUse::Region), 2);
  ASSERT_EQ(domain.lines.size(), 3u);
  EXPECT_EQ(domain.lines[0].name, "wall");
  EXPECT_EQ(domain.lines[1].name, "");
  EXPECT_EQ(domain.lines[2].name, "3");  // the region's number, as it has no name
  EXPECT_EQ(std::ranges::count(domain.pslg.points, Point{5, 5}), 1);
  EXPECT_EQ(std::ranges::count(domain.pslg.points, Point{50, 50}), 0);
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::OutsideWater)], 1u);
  EXPECT_DOUBLE_EQ(labelledArea(domain.pslg, 0), 100);
}

// The texts on open lines, of a lake of 100 by 100 with these lines, in a plane.
CleanReport reportOn(const std::vector<std::vector<Point>>& lines) {
  std::vector<Feature> features{polygonFeature(0, square(0, 0, 100))};
  for (const auto& line : lines) features.push_back(lineFeature(static_cast<std::int64_t>(features.size()), line));
  const Coastline coastline = coastlineOf(features);
  CleanReport report;
  cleanFeatures(coastline, allMembers(coastline), Projection::plane(), {0.0}, report);
  return report;
}

TEST(OpenLines, AnIslandWithAGapIsNamed) {
  const CleanReport report = reportOn({{{40, 40}, {60, 40}, {60, 60}, {40, 60}, {40, 40.5}}});
  EXPECT_THAT(report.warnings,
              ElementsAre(AllOf(HasSubstr("feature 1: a line almost closes, between 40, 40 and 40, 40.5, "
                                          "0.5 apart"),
                                HasSubstr("--snap 0.55"))));
  EXPECT_THAT(report.notes, ElementsAre(HasSubstr("1 line of the input closes no ring")));
}

TEST(OpenLines, AnIslandInTwoLinesWithTwoGapsIsNamedOnce) {
  const CleanReport report =
      reportOn({{{40, 40}, {60, 40}, {60, 60}}, {{40, 60}, {40, 40.2}}, {{60, 60.1}, {40.3, 60}}});
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_THAT(report.warnings[0], AllOf(HasSubstr("feature 1 and "), HasSubstr("feature 2: lines almost meet"),
                                        HasSubstr("2 more such gaps"), HasSubstr("--snap 0.33")));
  EXPECT_THAT(report.notes, ElementsAre(HasSubstr("3 lines of the input close no ring")));
}

TEST(OpenLines, WharvesAndDamsAreNotedOnly) {
  // From the shore, from shore to shore, free at both ends, the moles of a harbour, and one that ends beside the shore.
  const CleanReport report = reportOn({{{50, 0}, {50, 30}},
                                       {{0, 80}, {100, 80}},
                                       {{20, 20}, {30, 20}},
                                       {{60, 0}, {60, 20}, {69, 20}},
                                       {{80, 0}, {80, 20}, {71, 20}},
                                       {{0.01, 90}, {20, 90}}});
  EXPECT_THAT(report.warnings, IsEmpty());
  EXPECT_THAT(report.notes, ElementsAre(HasSubstr("6 lines of the input close no ring")));
}

TEST(OpenLines, ALakeWithAGapBesideAnotherIsNamed) {
  const CleanReport report = reportOn({{{100, 40}, {160, 40}, {160, 60}, {100, 60}}, {{200, 0}, {300, 0}, {200, 1}}});
  EXPECT_THAT(report.warnings, ElementsAre(HasSubstr("feature 2: a line almost closes, between 200, 0 and 200, 1")));
  EXPECT_THAT(report.notes, ElementsAre(AllOf(HasSubstr("2 lines of the input close no ring, and are left out"),
                                              HasSubstr("feature 1 at 100, 40"))));
}

TEST(OpenLines, LinesAlongTheShoreAndThoseGivenAsConstraintsAreNotNoted) {
  Feature wall = lineFeature(2, {{40, 40}, {60, 40}, {60, 60}, {40, 60}, {40, 40.5}});
  wall.use = FeatureUse::Constraint;
  const Coastline coastline =
      coastlineOf({polygonFeature(0, square(0, 0, 100)), lineFeature(1, {{100, 0}, {100, 100}, {0, 100}}), wall});
  CleanReport report;
  cleanFeatures(coastline, allMembers(coastline), Projection::plane(), {0.0}, report);
  EXPECT_THAT(report.warnings, IsEmpty());
  EXPECT_THAT(report.notes, IsEmpty());
}

}  // namespace
}  // namespace coastmesh
