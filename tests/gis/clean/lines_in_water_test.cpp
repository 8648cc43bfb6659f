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

}  // namespace
}  // namespace coastmesh
