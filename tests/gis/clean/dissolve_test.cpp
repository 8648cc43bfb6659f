#include <gtest/gtest.h>

#include <algorithm>

#include "gis/clean/clean.hpp"
#include "tests/support/gis_shapes.hpp"
#include "tests/support/pslg_check.hpp"

namespace coastmesh {
namespace {

// A lake in three pieces: the cuts disappear, and so do the vertices that they left in the shore.
TEST(Dissolve, LeavesNoTraceOfACut) {
  const Coastline coastline = coastlineOf({polygonFeature(4, {{0, 0}, {5, 0}, {5, 5}, {0, 5}}),
                                           polygonFeature(2, {{5, 0}, {9, 0}, {9, 5}, {5, 5}}),
                                           polygonFeature(3, {{9, 0}, {12, 1}, {12, 5}, {9, 5}})});
  CleanOptions options;
  options.dissolve = true;
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, allMembers(coastline), Projection::plane(), options, report);
  EXPECT_EQ(defectOfLabelled(domain.pslg), "");
  // The corners, and the vertex at (9, 0), where the shore turns.
  EXPECT_EQ(domain.pslg.points.size(), 5u);
  EXPECT_DOUBLE_EQ(labelledArea(domain.pslg, 0), 60 - 1.5);
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::DissolvedEdge)], 2u + 3u);
}

// If a feature holds the rest, as on a whole globe, shores separate the lakes from that as well: only the cut
// disappears.
TEST(Dissolve, LeavesTheShoreTowardsTheRest) {
  Coastline coastline = coastlineOf({polygonFeature(1, {{0, 0}, {5, 0}, {5, 5}, {0, 5}}), Feature{},
                                     polygonFeature(2, {{5, 0}, {9, 0}, {9, 4}, {5, 5}}),
                                     polygonFeature(3, {{20, 1}, {24, 1}, {22, 3}})});
  coastline.rest = 1;
  CleanOptions options;
  options.dissolve = true;
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, allMembers(coastline), Projection::plane(), options, report);
  // The cut and its end at (5, 0); at (5, 5) the shore turns.
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::DissolvedEdge)], 1u + 1u);
  EXPECT_EQ(domain.pslg.segments.size(), 5u + 3u);
  EXPECT_EQ(domain.rest, 1);
  for (const Segment& s : domain.pslg.segments) {
    const RegionId lake = domain.pslg.points[s.a].x < 15.0 ? 0 : 3;
    EXPECT_EQ(std::minmax(s.left, s.right), std::minmax(RegionId{1}, lake));
  }
}

// A bend no larger than the decimals of the input is a trace of the cut. A bend is real if it has more digits, even if
// it is smaller, or if the lake itself is as small as the decimals.
TEST(Dissolve, TakesABendForATraceOnlyWithinTheDecimals) {
  const auto vertices = [](double unit, double x, double bend) {
    const Coastline coastline =
        coastlineOf({polygonFeature(1, {{0, 0}, {x, bend}, {x, 3 * unit}, {0, 3 * unit}}),
                     polygonFeature(2, {{x, bend}, {7 * unit, 0}, {7 * unit, 3 * unit}, {x, 3 * unit}})});
    CleanOptions options;
    options.dissolve = true;
    CleanReport report;
    const Domain domain = cleanFeatures(coastline, allMembers(coastline), Projection::plane(), options, report);
    EXPECT_NEAR(labelledArea(domain.pslg, 0), 21 * unit * unit - 3.5 * unit * bend * (domain.pslg.points.size() == 5),
                1e-12 * unit * unit);
    return domain.pslg.points.size();
  };
  EXPECT_EQ(vertices(100, 312.34, 0.01), 4u);
  EXPECT_EQ(vertices(1000, 4000, 0), 4u);
  EXPECT_EQ(vertices(100, 312.3456789, 0.0000001), 4u);
  EXPECT_EQ(vertices(100, 312.3456789, 0.00001), 5u);
  EXPECT_EQ(vertices(100, 300 + 1 / 7.0, 0.01), 5u);
  EXPECT_EQ(vertices(0.01, 0.03, 0.01), 5u);
}

}  // namespace
}  // namespace coastmesh
